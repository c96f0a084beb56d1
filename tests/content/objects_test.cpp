// Scenes of several objects and images: where they stand, what hides what, and their light, against closed forms.
#include "content/pictures/scene.h"
#include "geometry/vec.h"
#include "image/formats/encoding.h"
#include "image/formats/image_file.h"
#include "small_world.h"

#include <cmath>
#include <list>

namespace {

using namespace small_world;

class Objects : public testing::Test {
  protected:
    Objects() {
        d_.camera.target_mm = {0, 0, 10};  // the lenses' plane, from which depths count
        d_.camera.position_mm = {0, 0, 1e5};
        d_.content.depth_mm.reset();
        d_.content.height_mm.reset();
    }

    SceneObject& add_model(const std::string& file, const Vec3d& at, double height_mm) {
        SceneObject& o = d_.content.objects.emplace_back();
        o.model = file;
        o.position_mm = at;
        o.height_mm = height_mm;
        return o;
    }
    SceneObject& add_image(const std::string& file, const Vec3d& at, double height_mm) {
        SceneObject& o = add_model("", at, height_mm);
        o.image = file;
        return o;
    }
    /// A square patch of a colour, facing the viewer.
    SceneObject& add_patch(const std::string& colour, const Vec3d& at, double side_mm) {
        Folder& own = folders_.emplace_back();
        return add_model(write_patches(own, {{-1, 1, -1, 1, 0, colour}}), at, side_mm);
    }
    std::string write_picture(const std::string& name, const Image& image) {
        write_image(folder_.path() / name, image);
        return folder_.path() / name;
    }
    /// A picture of one texel, its codes and alpha as given, as a TGA file.
    std::string write_texel(const std::string& name, int r, int g, int b, int alpha) {
        std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28", 18);
        for (const int code : {b, g, r, alpha}) tga += char(code);
        return folder_.write(name, tga);
    }

    ContentScene scene(const Display& d) { return ContentScene(load_parts(content_files(d)), d, resolve(d)); }
    ContentScene scene() { return scene(d_); }
    Image photo(const Display& d) { return reference_photograph(d, resolve(d), scene(d), 0, {}, job_).image; }
    Image photo() { return photo(d_); }
    /// Seen from afar: 0.2 mm a pixel, the middle of 240 x 160 pixels between four of them.
    static std::array<float, 3> at(const Image& image, double x_mm, double y_mm) {
        const float* const c = image.at(int(std::floor(120 + x_mm / 0.2)), int(std::floor(80 - y_mm / 0.2)));
        return {c[0], c[1], c[2]};
    }
    static void expect_light(const std::array<float, 3>& got, double r, double g, double b) {
        EXPECT_NEAR(got[0], r, 1e-5);
        EXPECT_NEAR(got[1], g, 1e-5);
        EXPECT_NEAR(got[2], b, 1e-5);
    }

    Folder folder_;
    std::list<Folder> folders_;
    Display d_ = display();
    Job job_;
};

// Vertices of a tetrahedron without symmetry, turned by the matrices of model.md.
TEST_F(Objects, AreTurnedAboutZThenXThenYAndPlacedByTheirBoxes) {
    const std::vector<Vec3d> corners{{1, 2, 3}, {4, 2.5, 3.5}, {2, 6, 4}, {1.5, 3, 9}};
    std::ostringstream obj;
    for (const Vec3d& p : corners) obj << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
    obj << "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    add_patch("white", {0, 0, -30}, 1);  // so that the middle is not the object's
    SceneObject& o = add_model(folder_.write("t.obj", obj.str()), {5, -7, 11}, 1);
    o.height_mm.reset();
    o.unit_mm = 2;
    o.roll_deg = 25;
    o.tilt_deg = -40;
    o.yaw_deg = 70;

    const auto turned = [&](Vec3d p) {
        const double r = 25 * M_PI / 180, t = -40 * M_PI / 180, y = 70 * M_PI / 180;
        p = {std::cos(r) * p[0] - std::sin(r) * p[1], std::sin(r) * p[0] + std::cos(r) * p[1], p[2]};
        p = {p[0], std::cos(t) * p[1] + std::sin(t) * p[2], std::cos(t) * p[2] - std::sin(t) * p[1]};
        return Vec3d{std::cos(y) * p[0] + std::sin(y) * p[2], p[1], std::cos(y) * p[2] - std::sin(y) * p[0]};
    };
    Vec3d low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (const Vec3d& p : corners)
        for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], turned(p)[k]), high[k] = std::max(high[k], turned(p)[k]);
    const ContentScene made = scene();
    const std::vector<float>& positions = made.impl().positions_mm;
    EXPECT_DOUBLE_EQ(made.centre_mm()[2], 10 - 9.5);  // midway between 11 and -30, from the lenses at z = 10
    for (const Vec3d& p : corners) {
        double nearest = 1e9;
        for (std::size_t v = 0; 3 * v + 3 < positions.size(); ++v) {
            Vec3d off;
            for (std::size_t k = 0; k < 3; ++k)
                off[k] = double(positions[3 * v + k]) + (k == 2 ? -9.5 : 0) -
                         (2 * (turned(p)[k] - 0.5 * (low[k] + high[k])) + o.position_mm[k]);
            nearest = std::min(nearest, length(off));
        }
        EXPECT_LT(nearest, 1e-5);
    }
}

TEST_F(Objects, OneObjectHasTheBitsOfTheModelAlone) {
    const std::string file = write_patches(folder_, {{-3, 2, -1, 1, 0, "red"}, {-1, 1, -2, 3, 1, "green"}});
    Display alone = d_;
    alone.content.model = file;
    alone.content.depth_mm = 25;
    alone.content.height_mm = 13.7;
    add_model(file, {0, 0, 25}, 13.7);
    const ContentScene as_model = scene(alone), as_object = scene();
    EXPECT_EQ(photo(alone).rgb, photo().rgb);
    const auto eia = [&](const Display& d, const ContentScene& s) { return elemental_images(d, resolve(d), s, 2, job_).image.rgb; };
    EXPECT_EQ(eia(alone, as_model), eia(d_, as_object));
    EXPECT_EQ(as_model.centre_mm(), as_object.centre_mm());
}

// Red before, green behind and wider, blue crossing both: each is seen where it is nearest.
TEST_F(Objects, HideOneAnother) {
    add_patch("green", {0, 0, -20}, 20);
    add_patch("red", {3, 0, 10}, 8);
    add_patch("blue", {0, 0, -5}, 14).yaw_deg = 80;  // its left end is before the red patch, its right end behind the green one
    const Image image = photo();
    EXPECT_GT(at(image, 3.1, 3)[0], 0.5f);
    EXPECT_GT(at(image, -6.9, 3)[1], 0.5f);
    EXPECT_EQ(at(image, 11.1, 0)[1], 0);
    EXPECT_GT(at(image, -0.5, 6.1)[2], 0.05f);
    EXPECT_GT(at(image, 1.05, 3)[0], 0.5f);
}

TEST_F(Objects, TheLightIsAsDescribed) {
    add_patch("white", {-5, 0, 0}, 6);
    add_patch("red", {5, 0, 0}, 6).tilt_deg = -30;
    d_.content.light = {{0, 3, 4}, 1.5, 0.25};
    const Image image = photo();
    expect_light(at(image, -4.9, 0.1), 0.25 + 1.5 * 0.8, 0.25 + 1.5 * 0.8, 0.25 + 1.5 * 0.8);
    // Tilted back by 30 degrees, it faces down: n = (0, -sin 30, cos 30).
    expect_light(at(image, 4.9, 0.1), 0.25 + 1.5 * (-0.5 * 0.6 + std::sqrt(0.75) * 0.8), 0, 0);
    d_.content.light.direction = {0, 0, -1};
    expect_light(at(photo(), -4.9, 0.1), 0.25, 0.25, 0.25);
}

TEST_F(Objects, TheLightStaysWhereAModelTurns) {
    d_.content.model = write_patches(folder_, {{-1, 1, -1, 1, 0, "white"}});
    d_.content.height_mm = 10;
    d_.content.yaw_deg = 35;
    d_.content.light = {{1, 0, 1}, 0.7, 0.1};
    expect_light(at(photo(), 0.1, 0.1), 0.1 + 0.7 * std::cos(10 * M_PI / 180), 0.1 + 0.7 * std::cos(10 * M_PI / 180),
                 0.1 + 0.7 * std::cos(10 * M_PI / 180));
}

// A picture in its own light, upright, as large as it says; from behind it is mirrored.
TEST_F(Objects, ImagesAreUprightAndLitByThemselves) {
    Image four(2, 2);
    four.at(0, 0)[0] = four.at(1, 0)[1] = four.at(0, 1)[2] = 1;  // red, green; blue, black
    add_image(write_picture("four.png", four), {0, 0, 0}, 20);
    d_.content.light = {{0, 0, 1}, 5, 3};
    Image image = photo();
    expect_light(at(image, -9.7, 9.7), 1, 0, 0);
    expect_light(at(image, 9.7, 9.7), 0, 1, 0);
    expect_light(at(image, -9.7, -9.7), 0, 0, 1);
    expect_light(at(image, -10.3, 0), 0, 0, 0);
    d_.content.objects[0].yaw_deg = 180;
    image = photo();
    expect_light(at(image, 9.7, 9.7), 1, 0, 0);
    expect_light(at(image, -9.7, 9.7), 0, 1, 0);
    d_.content.objects[0] = {};
    d_.content.objects[0].image = write_picture("wide.png", Image(30, 10));
    d_.content.objects[0].width_mm = 24;
    EXPECT_NEAR(scene().half_size_mm()[0], 12, 1e-5);
    EXPECT_NEAR(scene().half_size_mm()[1], 4, 1e-5);
}

// Light of images of uniform alpha over one another and over a patch: sum of each one's, times what those before it let through.
TEST_F(Objects, AlphaLetsLightThrough) {
    add_image(write_texel("front.tga", 255, 0, 0, 102), {0, 0, 20}, 20);    // alpha 0.4
    add_image(write_texel("second.tga", 0, 188, 0, 51), {0, 0, 10}, 12);    // alpha 0.2
    add_image(write_texel("clear.tga", 255, 255, 255, 0), {0, 0, 15}, 20);  // nothing
    add_patch("blue", {0, 0, -10}, 6);
    const double green = srgb_to_linear(188 / 255.), lit = facing_light;
    const Image image = photo();
    expect_light(at(image, 0.1, 0.1), 0.4, 0.6 * 0.2 * green, 0.6 * 0.8 * lit);
    expect_light(at(image, 5.1, 0.1), 0.4, 0.6 * 0.2 * green, 0);
    expect_light(at(image, 8.1, 0.1), 0.4, 0, 0);
    // On the diagonal, where an image's two triangles meet, it is not seen twice.
    for (int k = -9; k < 9; ++k) EXPECT_NEAR(at(image, k + 0.1, k + 0.1)[0], 0.4, 1e-5) << k;
    const Picture eia = elemental_images(d_, resolve(d_), scene(), 0, job_);
    for (std::size_t i = 0; i < eia.image.rgb.size(); i += 3) ASSERT_LE(eia.image.rgb[i], 0.4 + 1e-5);
    EXPECT_NEAR(*std::max_element(eia.image.rgb.begin(), eia.image.rgb.end()), 0.48 * lit, 1e-5);  // the blue patch, behind all
}

// What is clear has no colour: between an opaque and a clear texel the picture fades, and does not darken or change colour.
TEST_F(Objects, AlphaIsFilteredWithItsColour) {
    std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28", 18);
    tga += std::string("\xff\xff\xff\xff\0\0\0\0", 8);  // white, then clear black
    add_image(folder_.write("half.tga", tga), {0, 0, 0}, 10);
    add_patch("white", {0, 0, -10}, 20);
    d_.content.light = {{0, 0, 1}, 0, 1};  // the patch is as white as the image: nothing is to be seen
    const Image image = photo();
    for (double x = -9.5; x < 9.5; x += 0.2) expect_light(at(image, x, 0.1), 1, 1, 1);
}

TEST_F(Objects, AColourReplacesThoseOfTheFile) {
    add_patch("red", {0, 0, 0}, 10).colour = Vec3d{0.2, 0.6, 1};
    expect_light(at(photo(), 0.1, 0.1), facing_light * srgb_to_linear(0.2), facing_light * srgb_to_linear(0.6), facing_light);
}

// A cube: smoothed, each corner's normal is the diagonal, whichever way its faces are cut; flat, faces have their own.
TEST_F(Objects, ShadingReplacesNormals) {
    std::ostringstream obj;
    for (int k = 0; k < 8; ++k) obj << "v " << (k & 1) << " " << (k >> 1 & 1) << " " << (k >> 2) << "\n";
    obj << "f 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\nf 3 7 8 4\nf 1 2 6 5\nf 5 6 8\nf 5 8 7\nf 1 3 4 2\n";
    SceneObject& cube = add_model(folder_.write("cube.obj", obj.str()), {0, 0, 0}, 20);
    d_.content.light = {{0, 0, 1}, 1, 0};
    cube.shading = Shading::flat;
    const float face = at(photo(), 4.1, 7.1)[0];  // the file's grey, fully lit
    EXPECT_EQ(at(photo(), -9.9, 9.9)[0], face);
    cube.shading = Shading::smooth;
    const Image image = photo();
    // Near a corner the cosine is 1/sqrt(3); in the middle of the face's diagonal it points along z, by symmetry.
    EXPECT_NEAR(at(image, 9.9, 9.9)[0], face / std::sqrt(3), 0.02);
    EXPECT_NEAR(at(image, -9.9, 9.9)[0], face / std::sqrt(3), 0.02);
}

TEST_F(Objects, MoveTogether) {
    add_patch("red", {-4, 0, 30}, 6);
    add_patch("green", {4, 1, -10}, 6);
    const ContentScene as_described = scene();
    EXPECT_DOUBLE_EQ(as_described.centre_mm()[2], 20);  // 10 from the lenses at 10
    Display there = d_;
    there.content.depth_mm = -25;
    const ContentScene moved = as_described.at_depth(-25), made = scene(there);
    EXPECT_EQ(&moved.impl(), &as_described.impl());
    const auto eia = [&](const ContentScene& s) { return elemental_images(there, resolve(there), s, 2, job_).image.rgb; };
    EXPECT_EQ(eia(moved), eia(made));
    Display shifted = d_;
    for (SceneObject& o : shifted.content.objects) o.position_mm[2] -= 35;
    EXPECT_EQ(eia(made), elemental_images(shifted, resolve(shifted), scene(shifted), 2, job_).image.rgb);
}

TEST_F(Objects, TurnAndGrowTogetherAboutTheirMiddle) {
    add_patch("red", {-10, 0, 30}, 6);
    add_patch("green", {10, 2, -10}, 6);
    d_.content.height_mm = 16;  // their box reaches from -3 to 5: twice as large
    d_.content.yaw_deg = 90;
    const Vec3d half = scene().half_size_mm();
    EXPECT_EQ(half_size_mm(load_parts(content_files(d_)), d_, resolve(d_)), half);
    // Turned by 90 degrees z becomes x: 20 to either side, twice as much.
    EXPECT_NEAR(half[0], 2 * 20, 1e-4);
    EXPECT_NEAR(half[1], 2 * 5, 1e-4);
    EXPECT_NEAR(half[2], 2 * 13, 1e-4);
}

TEST_F(Objects, HaveTheSameBitsOnAnyNumberOfThreads) {
    add_image(write_texel("veil.tga", 200, 10, 90, 120), {1, 0, 20}, 20).yaw_deg = 30;
    add_model(std::string(built_in_spheres), {0, 0, 0}, 20);
    const Geometry g = resolve(d_);
    const ContentScene made = scene();
    const auto one = elemental_images(d_, g, made, 1, job_).image.rgb;
    EXPECT_EQ(one, elemental_images(d_, g, made, 3, job_).image.rgb);
    EXPECT_EQ(one, elemental_images(d_, g, scene(), 2, job_).image.rgb);
}

TEST_F(Objects, ReadEachFileOnce) {
    const std::string file = write_patches(folder_, {{-1, 1, -1, 1, 0, "red"}});
    for (int k = 0; k < 5; ++k) add_model(file, {double(k), 0, 0}, 3);
    const ContentParts parts = load_parts(content_files(d_));
    ASSERT_EQ(parts.size(), 5u);
    for (const auto& part : parts) EXPECT_EQ(part, parts[0]);
}

TEST_F(Objects, LimitsHoldForAllFilesTogether) {
    if (!memory_is_limited) GTEST_SKIP() << "AddressSanitizer excludes limits of the address space";
    Image big(3000, 3000);  // 36 MB of texels
    for (const char* name : {"a.png", "b.png"}) add_image(write_picture(name, big), {0, 0, 0}, 10);
    LoadOptions options;
    options.bytes = std::int64_t(1) << 30;
    EXPECT_EQ(load_parts(content_files(d_), options).size(), 2u);
    options.bytes = 50 << 20;  // one fits into what may be sent
    EXPECT_THROW(load_parts(content_files(d_), options), InputError);
    options = {};
    options.seconds = 1e-4;
    EXPECT_THROW(load_parts(content_files(d_), options), InputError);
}

TEST_F(Objects, PicturesThatAreNoneAreErrors) {
    const std::string truncated = "\x89PNG\r\n\x1a\n";
    const std::string huge = truncated + std::string("\0\0\0\rIHDR\0\1\x86\xa0\0\1\x86\xa0\x08\2\0\0\0", 21);
    for (const std::string& file :
         {folder_.write("text.png", "not a picture").string(), folder_.write("cut.png", truncated).string(),
          folder_.write("huge.png", huge).string(), folder_.write("empty.png", "").string(), folder_.path().string(),
          (folder_.path() / "none.png").string(), std::string("/dev/zero")}) {
        try {
            load_picture(file);
            ADD_FAILURE() << file << " is read";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(file));
        }
    }
}

TEST_F(Objects, SizesThatCannotBeAreErrors) {
    const std::string flat = folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    add_model(flat, {0, 0, 0}, 5);
    try {
        scene();
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("content.object.0.height_mm"), testing::HasSubstr("unit_mm")));
    }
    d_.content.objects[0].height_mm.reset();
    d_.content.objects[0].unit_mm = 3;
    EXPECT_NEAR(scene().half_size_mm()[0], 1.5, 1e-6);
    d_.content.objects[0].unit_mm = 1e6;
    d_.content.objects[0].model = folder_.write("long.obj", "v 0 0 0\nv 9 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THROW(scene(), InputError);
}

}  // namespace
