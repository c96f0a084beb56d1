// The reference photograph of things whose pictures are known.
#include "small_world.h"

namespace {

using namespace small_world;

Picture shoot(const Display& d, const fs::path& model, std::optional<Rect> crop = {}, int threads = 0) {
    Job job;
    const Geometry g = resolve(d);
    return reference_photograph(d, g, Scene(load_model(model), d, g), threads, crop, job);
}

// A patch through the target: the frame is 48 mm over 240 pixels there, so 16 x 20 mm are 80 x 100 pixels about the centre.
TEST(Photograph, PatchInTheTargetPlane) {
    Folder folder;
    Display d = display();
    d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
    const Picture p = shoot(d, write_patches(folder, {{-8, 8, -10, 10, 0, "white"}}));
    EXPECT_EQ(p.rays, 240 * 160);
    for (int row = 0; row < 160; ++row) {
        for (int column = 0; column < 240; ++column) {
            const bool inside = column >= 80 && column < 160 && row >= 30 && row < 130;
            ASSERT_NEAR(p.image.at(column, row)[1], inside ? facing_light : 0, 1e-6) << column << ", " << row;
        }
    }
}

// From a camera aside, rolled by its up vector, every pixel against the plane's own geometry in double.
TEST(Photograph, ObliqueCamera) {
    Folder folder;
    Display d = display();
    const double z = resolve(d).vertex_plane_mm;
    d.camera.position_mm = {120, -80, 300};
    d.camera.target_mm = {2, 1, 0};
    d.camera.up = {0.3, 1, 0.1};
    const Picture p = shoot(d, write_patches(folder, {{-8, 8, -10, 10, 0, "white"}}));
    // The frame: w towards the target, u to the right, v up.
    const Vec3d w{2 - 120., 1 + 80., -300}, up = d.camera.up;
    const double length = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    Vec3d u{w[1] * up[2] - w[2] * up[1], w[2] * up[0] - w[0] * up[2], w[0] * up[1] - w[1] * up[0]};
    const double u_length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (double& x : u) x /= u_length;
    const Vec3d v{(u[1] * w[2] - u[2] * w[1]) / length, (u[2] * w[0] - u[0] * w[2]) / length, (u[0] * w[1] - u[1] * w[0]) / length};
    int inside_count = 0;
    for (int row = 0; row < 160; ++row) {
        for (int column = 0; column < 240; ++column) {
            const double a = (column + 0.5 - 120) * 0.2, b = (80 - row - 0.5) * 0.2;
            const double dz = w[2] + a * u[2] + b * v[2], t = (z - 300) / dz;
            const double x = std::abs(120 + t * (w[0] + a * u[0] + b * v[0])) - 8,
                         y = std::abs(-80 + t * (w[1] + a * u[1] + b * v[1])) - 10;
            if (std::abs(x) < 1e-3 || std::abs(y) < 1e-3) continue;
            inside_count += x < 0 && y < 0;
            ASSERT_NEAR(p.image.at(column, row)[0], x < 0 && y < 0 ? facing_light : 0, 1e-6) << column << ", " << row;
        }
    }
    EXPECT_GT(inside_count, 3000);
}

TEST(Photograph, CropHasTheFullFramesPixels) {
    Folder folder;
    Display d = display();
    d.content.yaw_deg = 25;
    const fs::path model =
        write_patches(folder, {{-8, 8, -10, 10, 0, "white"}, {-3, 9, -4, 4, 6, "red"}, {-3, 9, -4, 4, 6, "green"}});
    const Picture full = shoot(d, model);
    const Rect crop{77, 31, 170, 102};
    for (const int threads : {1, 3}) {
        const Picture part = shoot(d, model, crop, threads);
        ASSERT_EQ(part.image.width, 93);
        ASSERT_EQ(part.image.height, 71);
        EXPECT_EQ(part.rays, 93 * 71);
        for (int row = 0; row < 71; ++row) {
            for (int column = 0; column < 93; ++column) {
                for (int c = 0; c < 3; ++c) ASSERT_EQ(part.image.at(column, row)[c], full.image.at(77 + column, 31 + row)[c]);
            }
        }
    }
    EXPECT_THROW(shoot(d, model, Rect{0, 0, 241, 10}), InputError);
    EXPECT_THROW(shoot(d, model, Rect{10, 10, 10, 20}), InputError);
}

// What stands behind the camera is not seen.
TEST(Photograph, CameraInsideTheScene) {
    Folder folder;
    Display d = display();
    const double z = resolve(d).vertex_plane_mm;
    d.camera.position_mm = {0, 0, z + 20};
    const Picture p = shoot(d, write_patches(folder, {{-10, 10, -10, 10, -30, "green"}, {-10, 10, -10, 10, 30, "red"}}));
    EXPECT_FLOAT_EQ(p.image.at(120, 80)[0], 0);
    EXPECT_NEAR(p.image.at(120, 80)[1], facing_light, 1e-6);
}

// The same surface point has the same colour in both pictures: with an infinite viewing distance and a camera far away the
// centre pixels of all elemental images and the photograph look along the same lines.
TEST(Photograph, AgreesWithTheElementalImages) {
    Folder folder;
    Display d = display();
    d.panel.pixels = {252, 168};  // 21 x 21 pixels a lens: one of them on the axis
    d.array.pitch_mm = 4.2;
    d.content.yaw_deg = 30;
    d.content.tilt_deg = -15;
    d.camera.position_mm = {0, 0, 1e6};
    d.camera.frame_width_mm = 12 * 4.2;
    d.camera.resolution = {12, 8};  // a pixel a lens
    const fs::path model = write_patches(folder, {{-8, 8, -10, 10, 0, "white"}, {-3, 9, -4, 4, 6, "red"}});
    const Picture photo = shoot(d, model);
    const Geometry g = resolve(d);
    Job job;
    const Picture eia = elemental_images(d, g, Scene(load_model(model), d, g), 0, job);
    int lit = 0;
    for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 12; ++i) {
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(photo.image.at(i, j)[c], eia.image.at(21 * i + 10, 21 * j + 10)[c], 1e-5);
            lit += photo.image.at(i, j)[0] > 0;
        }
    }
    EXPECT_GT(lit, 10);
}

}  // namespace
