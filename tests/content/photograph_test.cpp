// The reference photograph of things whose pictures are known.
#include <atomic>

#include "small_world.h"

namespace {

using namespace small_world;

Picture photo_of(const Display& d, const fs::path& model, std::optional<Rect> crop = {}, int threads = 0) {
    Job job;
    const Geometry g = resolve(d);
    return reference_photograph(d, g, ContentScene(load_model(model), d, g), threads, crop, job);
}

// A patch through the target: the frame is 48 mm over 240 pixels there, so 16 x 20 mm are 80 x 100 pixels about the centre.
TEST(Photograph, PatchInTheTargetPlane) {
    Folder folder;
    Display d = display();
    d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
    const Picture p = photo_of(d, write_patches(folder, {{-8, 8, -10, 10, 0, "white"}}));
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
    const Picture p = photo_of(d, write_patches(folder, {{-8, 8, -10, 10, 0, "white"}}));
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
    const Picture full = photo_of(d, model);
    const Rect crop{77, 31, 170, 102};
    for (const int threads : {1, 3}) {
        const Picture part = photo_of(d, model, crop, threads);
        ASSERT_EQ(part.image.width, 93);
        ASSERT_EQ(part.image.height, 71);
        EXPECT_EQ(part.rays, 93 * 71);
        for (int row = 0; row < 71; ++row) {
            for (int column = 0; column < 93; ++column) {
                for (int c = 0; c < 3; ++c) ASSERT_EQ(part.image.at(column, row)[c], full.image.at(77 + column, 31 + row)[c]);
            }
        }
    }
    EXPECT_THROW(photo_of(d, model, Rect{0, 0, 241, 10}), InputError);
    EXPECT_THROW(photo_of(d, model, Rect{10, 10, 10, 20}), InputError);
}

// What stands behind the camera is not seen.
TEST(Photograph, CameraInsideTheScene) {
    Folder folder;
    Display d = display();
    const double z = resolve(d).vertex_plane_mm;
    d.camera.position_mm = {0, 0, z + 20};
    const Picture p = photo_of(d, write_patches(folder, {{-10, 10, -10, 10, -30, "green"}, {-10, 10, -10, 10, 30, "red"}}));
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
    const Picture photo = photo_of(d, model);
    const Geometry g = resolve(d);
    Job job;
    const Picture eia = elemental_images(d, g, ContentScene(load_model(model), d, g), 0, job);
    int lit = 0;
    for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 12; ++i) {
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(photo.image.at(i, j)[c], eia.image.at(21 * i + 10, 21 * j + 10)[c], 1e-5);
            lit += photo.image.at(i, j)[0] > 0;
        }
    }
    EXPECT_GT(lit, 10);
}

/// The moments of a picture's light about the frame's middle: all of it, the mean squared distance and the greatest, in pixels.
struct Moments {
    double light = 0, squared = 0, furthest = 0;
    explicit Moments(const Image& image) {
        for (int j = 0; j < image.height; ++j) {
            for (int i = 0; i < image.width; ++i) {
                const double x = i + 0.5 - 0.5 * image.width, y = j + 0.5 - 0.5 * image.height, r2 = x * x + y * y;
                const double here = image.at(i, j)[1];
                light += here, squared += here * r2;
                if (here > 0) furthest = std::max(furthest, std::sqrt(r2));
            }
        }
        squared /= light;
    }
};

// A thin lens of diameter A, focused at F, shows a point at depth z as a disk: in the frame, at the target's distance T, it is
// A T |1/F - 1/z| wide and evenly bright.
TEST(Photograph, PupilBlursAPointToADisk) {
    Folder folder;
    Display d = display();
    const fs::path model = write_patches(folder, {{-0.5, 0.5, -0.5, 0.5, 0, "white"}});
    d.content.height_mm = 1;
    d.camera.pupil_diameter_mm = 20;
    d.render.samples = 1024;
    const double T = 500, a = 0.2, vertex = resolve(d).vertex_plane_mm;
    for (const auto& [depth_mm, focus_mm] : {std::pair(60., 500.), {60., 380.}, {-150., 400.}}) {
        d.content.depth_mm = depth_mm;
        d.camera.focus_distance_mm = focus_mm;
        const double z = T - vertex - depth_mm, radius = 20 * T * std::abs(1 / focus_mm - 1 / z) / 2 / a, side = T / z / a;
        const Moments found(photo_of(d, model).image);
        EXPECT_NEAR(found.light, facing_light * side * side, 0.01 * found.light);
        EXPECT_NEAR(found.squared, radius * radius / 2 + side * side / 6, 0.01 * found.squared);
        EXPECT_LT(found.furthest, radius + side * std::sqrt(0.5) + 1);
        EXPECT_GT(found.furthest, radius);
    }
}

// What stands in the plane of focus has the pinhole's picture.
TEST(Photograph, PupilLeavesThePlaneOfFocusSharp) {
    Folder folder;
    Display d = display();
    const fs::path model = write_patches(folder, {{-8.02, 8.02, -10, 10, 0, "white"}});
    const Image pinhole = photo_of(d, model).image;
    d.camera.pupil_diameter_mm = 20;
    d.camera.focus_distance_mm = 500 - resolve(d).vertex_plane_mm;
    d.render.samples = 16;
    const Image image = photo_of(d, model).image;
    for (std::size_t k = 0; k < image.rgb.size(); ++k) ASSERT_NEAR(image.rgb[k], pinhole.rgb[k], 1e-6) << k;
}

// A pixel of the box filter is lit by the share of it that the patch covers.
TEST(Photograph, PixelFilterCountsTheShareOfAPixel) {
    Folder folder;
    Display d = display();
    d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
    d.content.height_mm = 20.1;
    d.camera.pixel_filter = PixelFilter::box;
    d.render.samples = 256;
    const Image image = photo_of(d, write_patches(folder, {{-8.05, 8.05, -10.05, 10.05, 0, "white"}})).image;
    const auto share = [&](int column, int row) { return image.at(column, row)[1] / facing_light; };
    EXPECT_NEAR(share(120, 80), 1, 1e-6);
    EXPECT_NEAR(share(79, 80), 0.25, 0.01);
    EXPECT_NEAR(share(160, 80), 0.25, 0.01);
    EXPECT_NEAR(share(120, 29), 0.25, 0.01);
    EXPECT_NEAR(share(79, 29), 0.0625, 0.01);
    EXPECT_EQ(share(78, 80), 0);
}

// Sampled photographs, too, are the same on any number of threads and in any crop, and go by their seed.
TEST(Photograph, SampledPixelsAreReproducible) {
    Folder folder;
    Display d = display();
    d.content.yaw_deg = 25;
    d.camera.pupil_diameter_mm = 30;
    d.camera.pixel_filter = PixelFilter::box;
    d.render.samples = 7;
    const fs::path model = write_patches(folder, {{-8, 8, -10, 10, 0, "white"}, {-3, 9, -4, 4, 6, "red"}});
    const Picture full = photo_of(d, model);
    EXPECT_EQ(full.rays, 7 * 240 * 160);
    const Rect crop{77, 31, 170, 102};
    for (const int threads : {1, 3}) {
        const Picture part = photo_of(d, model, crop, threads);
        for (int row = 0; row < 71; ++row)
            for (int column = 0; column < 93; ++column)
                for (int c = 0; c < 3; ++c) ASSERT_EQ(part.image.at(column, row)[c], full.image.at(77 + column, 31 + row)[c]);
    }
    d.render.seed = 1;
    EXPECT_NE(photo_of(d, model).image.rgb, full.image.rgb);
    d.render.sampling = Sampling::random;
    EXPECT_NE(photo_of(d, model).image.rgb, full.image.rgb);
}

// Whatever the number of samples, cancelling takes effect within a pixel.
TEST(Photograph, StopsWithinAPixel) {
    struct Cancelled : Job {
        bool cancelled() const override { return ++asked > 2; }
        mutable std::atomic<int> asked{0};
    } job;
    Folder folder;
    Display d = display();
    d.camera.pupil_diameter_mm = 30;
    d.render.samples = 1 << 24;
    const Geometry g = resolve(d);
    const ContentScene scene(load_model(write_patches(folder, {{-8, 8, -10, 10, 0, "white"}})), d, g);
    const Picture stopped = reference_photograph(d, g, scene, 1, Rect{120, 80, 121, 81}, job);
    EXPECT_FALSE(stopped.complete);
    EXPECT_EQ(stopped.image.rgb, std::vector<float>(3, 0));
}

}  // namespace
