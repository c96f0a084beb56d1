// Every rule of validate(): one fault at a time, found once, at its key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "base/constants.h"
#include "display/keys.h"
#include "example.h"
#include "geometry/geometry.h"
#include "panels.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;
constexpr double inf = infinity;
constexpr std::int64_t big = 1 << 20;

TEST(Validate, Examples) {
    for (const Display& d : {example(), example_surfaces(), example_ideal()}) EXPECT_TRUE(validate(d).empty());
    Display d = example_ideal();  // limits that are allowed
    d.content.viewing_distance_mm = inf;
    d.render.samples = 1 << 24;
    d.render.seed = INT64_MAX;
    d.array.count = {46340, 46341};
    d.diffuser = Diffuser{1e-3, {0, 179.999}, Profile::gaussian};
    EXPECT_TRUE(validate(d).empty());
}

Glass glass(const char* name) { return shipped_glass(name)->glass; }
void set_glass(Display& d, Glass glass) {
    d.lens.as<PlanoConvex>().index.reset();
    d.lens.as<PlanoConvex>().glass = std::move(glass);
}

SceneObject a_model() {
    SceneObject object;
    object.model = "a.obj";
    object.height_mm = 5;
    return object;
}
SceneObject an_image() {
    SceneObject object = a_model();
    object.image = std::exchange(object.model, "");
    return object;
}

/// A table of errors with one lens in it.
std::shared_ptr<const std::vector<GivenLensError>> one_lens(LensError error) {
    return std::make_shared<std::vector<GivenLensError>>(std::vector<GivenLensError>{{3, 2, error}});
}
Display example_glued() {
    Display d = example();
    d.panel.layers = {{17, 1.5, {}}};
    d.array.gap_mm.reset();
    d.array.base_z_mm = 17;
    return d;
}
Display example_plate() {
    Display d = example();
    d.array.surround = Surround::plate;
    return d;
}
Display example_clear() {
    Display d = example();
    d.array.surround = Surround::clear;
    return d;
}
Display example_pinhole() {
    Display d = example();
    d.lens.kind = Pinhole{1};
    return d;
}

struct Case {
    const char* key;
    const char* says;
    std::function<void(Display&)> spoil;
    std::function<Display()> from = example;
};

class Fault : public testing::TestWithParam<Case> {};

TEST_P(Fault, IsFoundOnceAtItsKey) {
    Display d = GetParam().from();
    GetParam().spoil(d);
    const std::vector<Problem> problems = validate(d);
    ASSERT_EQ(problems.size(), 1u) << (problems.empty() ? "" : InputError(problems).what());
    EXPECT_EQ(problems[0].where, GetParam().key);
    EXPECT_THAT(problems[0].what, HasSubstr(GetParam().says));
    EXPECT_THROW(resolve(d), InputError);
}

// clang-format off
INSTANTIATE_TEST_SUITE_P(Ranges, Fault, testing::Values(
    Case{"panel.pixels[0]", "is 0, allowed is 1 to below 2^31", [](Display& d) { d.panel.pixels[0] = 0; }},
    Case{"panel.pixels", "1048576 x 1048576 = 1099511627776", [](Display& d) { d.panel.pixels = {big, big}; d.panel.pixel_pitch_mm = 1e-4; }},
    Case{"panel.pixels", "allowed is 1000000 mm", [](Display& d) { d.panel.pixels = {big, 1}; d.panel.pixel_pitch_mm = 1; }},
    Case{"panel.pixel_pitch_mm", "is nan", [](Display& d) { d.panel.pixel_pitch_mm = -nan; }},
    Case{"panel.pixel_pitch_mm", "is -1", [](Display& d) { d.panel.pixel_pitch_mm = -1; }},
    Case{"panel.emission_exponent", "is 101", [](Display& d) { d.panel.emission_exponent = 101; }},
    Case{"panel.aperture_ratio", "is 0, allowed is 0.0001 to 1", [](Display& d) { d.panel.aperture_ratio = 0; }},
    Case{"panel.aperture_ratio", "is 1.01", [](Display& d) { d.panel.aperture_ratio = 1.01; }},
    Case{"panel.subpixel_cell", "but panel.subpixels is \"rgb_stripe\"", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.subpixels = SubpixelLayout::rgb_stripe; d.panel.custom.clear(); }},
    Case{"panel.subpixel", "but panel.subpixels is \"none\"", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.subpixels = SubpixelLayout::none; d.panel.subpixel_cell.reset(); }},
    Case{"panel.subpixel_cell", "is missing", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.subpixel_cell.reset(); }},
    Case{"panel.subpixel", "is missing", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom.clear(); }},
    Case{"panel.subpixel", "no rectangle emits \"g\"", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom.erase(d.panel.custom.begin() + 1); }},
    Case{"panel.subpixel.1.rect", "has no area", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom[1].rect[2] = 0.7; }},
    Case{"panel.subpixel.1.pixel", "outside of the cell of 3 x 2", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom[1].pixel = {3, 0}; }},
    Case{"panel.subpixel.1.rect", "overlaps panel.subpixel.0", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom[1].rect[0] = 0.4; }},
    Case{"panel.subpixel.1.rect", "overlaps itself", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom.erase(d.panel.custom.begin() + 4); d.panel.custom[1].rect = {0.7, 1.2, 1.4, 3.5}; }},
    Case{"panel.subpixel.3.rect[1]", "is nan", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom[3].rect[1] = nan; }},
    Case{"panel.subpixel", "has 33, allowed are 32", [](Display& d) { d.panel = with_subpixels(d.panel, SubpixelLayout::custom); d.panel.custom.resize(33, d.panel.custom[0]); }},
    Case{"panel.pixels", "allowed is a product below 2^29", [](Display& d) { d.panel.subpixels = SubpixelLayout::delta; d.panel.pixels = {32768, 16384}; d.panel.pixel_pitch_mm = 0.01; d.array.count.reset(); }},
    Case{"lens.index", "is 0.9, allowed is 1 to 4", [](Display& d) { d.lens.as<PlanoConvex>().index = 0.9; }},
    Case{"lens.index", "is inf", [](Display& d) { d.lens.as<PlanoConvex>().index = inf; }},
    Case{"lens.cylinder_height_mm", "is -0.5", [](Display& d) { d.lens.as<PlanoConvex>().cylinder_height_mm = -0.5; }},
    Case{"lens.stop_radius_mm", "is 0", [](Display& d) { d.lens.stop_radius_mm = 0; }},
    Case{"lens.focal_length_mm", "is -15", [](Display& d) { d.lens.as<IdealLens>().focal_length_mm = -15; }, example_ideal},
    Case{"lens.surface.1.conic", "is nan", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[1].conic = nan; }, example_surfaces},
    Case{"lens.surface.1.even_asphere[1]", "is inf", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[1].even_asphere[1] = inf; }, example_surfaces},
    Case{"lens.surface.1.even_asphere", "has 9 coefficients", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[1].even_asphere.resize(9); }, example_surfaces},
    Case{"lens.surface", "more than the 16", [](Display& d) { d.lens.as<SurfaceLens>().surfaces.resize(17, d.lens.as<SurfaceLens>().surfaces[0]); }, example_surfaces},
    Case{"lens.surface", "at least one", [](Display& d) { d.lens.as<SurfaceLens>().surfaces.clear(); }, example_surfaces},
    Case{"array.count[1]", "is -3", [](Display& d) { d.array.count->at(1) = -3; }},
    Case{"array.count", "= 2147483648, allowed is a product below 2^31", [](Display& d) { d.array.count = {65536, 32768}; }},
    Case{"array.count", "allowed is 1000000 mm", [](Display& d) { d.array.count = {1, big}; }},
    Case{"array.pitch_mm", "is [12, 9], but array.lattice is \"square\"; take \"rectangle\"", [](Display& d) { d.array.pitch_mm = {12, 9}; }},
    Case{"array.pitch_mm[1]", "is -9", [](Display& d) { d.array.lattice = LatticeKind::rectangle; d.array.pitch_mm = {12, -9}; }},
    Case{"lens.aperture_radius_mm", "wider than array.pitch_mm = 9 mm; give at most 4.5", [](Display& d) { d.array.lattice = LatticeKind::rectangle; d.array.pitch_mm = {12, 9}; }},
    Case{"array.pitch_mm", "is [12, 9], but array.lattice is \"hexagon\"; take \"brick\"", [](Display& d) { d.array.lattice = LatticeKind::hexagon; d.array.pitch_mm = {12, 9}; }},
    Case{"array.pitch_mm", "is [12, 9], but array.lattice is \"strips\"", [](Display& d) { d.array.lattice = LatticeKind::strips; d.array.count.reset(); d.array.pitch_mm = {12, 9}; }},
    Case{"array.count", "is [43, 24], but strips are one row; give [43, 1]", [](Display& d) { d.array.lattice = LatticeKind::strips; }},
    Case{"array.count", "5000000000 x 9000000000 = 45", [](Display& d) { d.array.count.reset(); d.array.pitch_mm = 1e-6; d.panel.pixels = {500, 900}; d.panel.pixel_pitch_mm = 10; d.lens.kind = IdealLens{{}, 15.7}; d.array.aperture = Aperture::cell; }},
    Case{"array.slant_deg", "is 90, allowed is more than -90 to below 90", [](Display& d) { d.array.lattice = LatticeKind::strips; d.array.count.reset(); d.array.slant_deg = 90; }},
    Case{"array.slant_deg", "rotate that lattice by array.rotation_deg", [](Display& d) { d.array.slant_deg = 9; }},
    Case{"array.slant_deg", "both array.slant_deg and array.rotation_deg", [](Display& d) { d.array.lattice = LatticeKind::strips; d.array.count.reset(); d.array.slant_deg = 9; d.array.rotation_deg = -9; }},
    Case{"panel.layer.0.index", "is 0.9, allowed is 1 to 4", [](Display& d) { d.panel.layers = {{1, 0.9}}; }},
    Case{"panel.layer.1.thickness_mm", "is 0", [](Display& d) { d.panel.layers = {{1, 1.5}, {0, 1.5}}; }},
    Case{"panel.layer", "more than the 8", [](Display& d) { d.panel.layers.resize(9, {0.1, 1.5}); }},
    Case{"array.offset_mm[1]", "is nan", [](Display& d) { d.array.offset_mm[1] = nan; }},
    Case{"array.rotation_deg", "is 361", [](Display& d) { d.array.rotation_deg = 361; }},
    Case{"array.gap_mm", "is missing", [](Display& d) { d.array.gap_mm.reset(); }},
    Case{"array.base_z_mm", "both", [](Display& d) { d.array.base_z_mm = 12; }},
    Case{"diffuser.angle_deg[0]", "is 180, allowed is 0 to below 180", [](Display& d) { d.diffuser = Diffuser{100, {180, 2}}; }},
    Case{"diffuser.distance_mm", "is 0", [](Display& d) { d.diffuser = Diffuser{0, {2, 2}}; }},
    Case{"content.viewing_distance_mm", "is nan", [](Display& d) { d.content.viewing_distance_mm = nan; }},
    Case{"content.depth_mm", "is inf", [](Display& d) { d.content.depth_mm = inf; }},
    Case{"content.height_mm", "is 0", [](Display& d) { d.content.height_mm = 0; }},
    Case{"content.yaw_deg", "is nan", [](Display& d) { d.content.yaw_deg = nan; }},
    Case{"content.light.direction", "leave it out, or take [0, 0, 1]", [](Display& d) { d.content.light.direction = {0, 0, 0}; }},
    Case{"content.light.direction[1]", "is nan", [](Display& d) { d.content.light.direction[1] = nan; }},
    Case{"content.light.ambient", "is -0.1", [](Display& d) { d.content.light.ambient = -0.1; }},
    Case{"content.object.0.position_mm[2]", "is inf", [](Display& d) { d.content.objects = {a_model()}, d.content.objects[0].position_mm[2] = inf; }},
    Case{"content.object.0.colour[0]", "is 1.5", [](Display& d) { d.content.objects = {a_model()}, d.content.objects[0].colour = Vec3d{1.5, 0, 0}; }},
    Case{"content.object.0.model", "is missing; give content.object.0.model", [](Display& d) { d.content.objects = {a_model()}, d.content.objects[0].model = ""; }},
    Case{"content.object.1.image", "leave one out, or make two objects", [](Display& d) { d.content.objects = {a_model(), a_model()}, d.content.objects[1].image = "b.png"; }},
    Case{"content.object.0.height_mm", "is missing; give", [](Display& d) { d.content.objects = {a_model()}, d.content.objects[0].height_mm.reset(); }},
    Case{"content.object.0.width_mm", "is not the only size", [](Display& d) { d.content.objects = {a_model()}, d.content.objects[0].width_mm = 3; }},
    Case{"content.object.0.unit_mm", "is not the only size", [](Display& d) { d.content.objects = {a_model()}, d.content.objects[0].unit_mm = 3; }},
    Case{"content.object.0.unit_mm", "give an image content.object.0.height_mm", [](Display& d) { d.content.objects = {an_image()}, d.content.objects[0].height_mm.reset(), d.content.objects[0].unit_mm = 3; }},
    Case{"content.object.0.colour", "the colours of an image are those of its file", [](Display& d) { d.content.objects = {an_image()}, d.content.objects[0].colour = Vec3d{}; }},
    Case{"content.object.0.shading", "an image is not lit", [](Display& d) { d.content.objects = {an_image()}, d.content.objects[0].shading = Shading::flat; }},
    Case{"content.object", "has more than the 64 objects", [](Display& d) { d.content.objects.assign(65, a_model()); }},
    Case{"content.model", "make the model an object", [](Display& d) { d.content.model = "a.obj", d.content.objects = {a_model()}; }},
    Case{"render.samples", "is 16777217, allowed is 1 to 16777216", [](Display& d) { d.render.samples = (1 << 24) + 1; }},
    Case{"render.samples", "is 0", [](Display& d) { d.render.samples = 0; }},
    Case{"render.seed", "is -1, allowed is 0 to 2^63 - 1", [](Display& d) { d.render.seed = -1; }}));

INSTANTIATE_TEST_SUITE_P(Lens, Fault, testing::Values(
    Case{"lens.aperture_radius_mm", "is missing", [](Display& d) { d.lens.as<PlanoConvex>().aperture_radius_mm.reset(); }},
    Case{"lens.aperture_radius_mm", "wider than array.pitch_mm = 12", [](Display& d) { d.lens.as<PlanoConvex>().aperture_radius_mm = 6.01; }},
    Case{"lens.aperture_radius_mm", "wider than array.pitch_mm = 12", [](Display& d) { d.lens.as<IdealLens>().aperture_radius_mm = 6.01; }, example_ideal},
    Case{"lens.sphere_radius_mm", "R = 5 mm is smaller than the aperture radius r = 6", [](Display& d) { d.lens.as<PlanoConvex>().sphere_radius_mm = 5; }},
    Case{"lens.sphere_radius_mm", "the cell's circumradius = 8.48", [](Display& d) { d.array.aperture = Aperture::cell; }},
    Case{"lens.cylinder_height_mm", "2 sqrt(R^2 - r^2) = 8.24", [](Display& d) { d.lens.as<PlanoConvex>().cylinder_height_mm = 8.3; }},
    Case{"lens.stop_radius_mm", "holes of neighbours overlap", [](Display& d) { d.lens.stop_radius_mm = 6.5; }},
    Case{"lens.stop_radius_mm", "holes of neighbours overlap", [](Display& d) { d.lens.stop_radius_mm = 7; }, example_surfaces},
    Case{"array.surround", "make them equal", [](Display& d) { d.array.surround = Surround::clear; d.lens.as<SurfaceLens>().surfaces[0].semi_aperture_mm = 5; }, example_surfaces},
    Case{"lens.surface.0.semi_aperture_mm", "wider than array.pitch_mm", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[0].semi_aperture_mm = 6.5; }, example_surfaces},
    Case{"lens.aperture_radius_mm", "wider than array.pitch_mm = 12 mm; give at most 6", [](Display& d) { d.lens.kind = Pinhole{6.1}; d.array.lattice = LatticeKind::strips; d.array.count.reset(); }},
    Case{"array.aperture", "a hole in a black sheet", [](Display& d) { d.lens.kind = Pinhole{1}; d.array.aperture = Aperture::cell; }},
    Case{"lens.stop_radius_mm", "is a stop; leave it out", [](Display& d) { d.lens = {Pinhole{1}, 0.5}; }},
    Case{"array.surround", "a lens of type \"pinhole\" has no glass", [](Display& d) { d.lens.kind = Pinhole{1}; d.array.surround = Surround::clear; }},
    // conic edge: 1/(c sqrt(1 + k)) = 1/(0.25 * 1) = 4 mm
    Case{"lens.surface.1.semi_aperture_mm", "ends 4 mm from the axis", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[1] = {-0.25, 0, {}, 6, 0, 1}; }, example_surfaces},
    Case{"lens.surface.1.semi_aperture_mm", "sag reaches", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[1].even_asphere = {1e4}; }, example_surfaces},
    Case{"lens.surface.0.distance_mm", "cross within the aperture; give at least 2.48997", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[0].distance_mm = 1; }, example_surfaces},
    Case{"array.surround", "a lens of type \"ideal\" has no glass", [](Display& d) { d.array.surround = Surround::plate; }, example_ideal},
    Case{"array.surround", "the lens has 3", [](Display& d) { d.array.surround = Surround::clear; d.lens.as<SurfaceLens>().surfaces.insert(d.lens.as<SurfaceLens>().surfaces.begin(), {0, 0, {}, 6, 1, 1.6}); }, example_surfaces}));

INSTANTIATE_TEST_SUITE_P(Layout, Fault, testing::Values(
    Case{"array.gap_mm", "into the panel; give at least 2.786", [](Display& d) { d.array.gap_mm = 1; }},
    Case{"array.gap_mm", "into the panel's layers; give at least 19.7866", [](Display& d) { d.panel.layers = {{17, 1}}; }},
    Case{"array.base_z_mm", "4 mm puts the lens's lowest point 1 mm into the panel's layers; give at least 5 mm", [](Display& d) {
        d.panel.layers = {{3, 1.5}, {2, 1.6}}; d.array.gap_mm.reset(); d.array.base_z_mm = 4; }},
    // a meniscus whose principal planes lie far below it
    Case{"array.base_z_mm", "in front of the panel", [](Display& d) {
        d.lens.as<SurfaceLens>().surfaces = {{-0.08, 0, {}, 3, 5, 1.7}, {-0.1, 0, {}, 3, 0, 1}};
        d.array.gap_mm.reset();
        d.array.base_z_mm = 0;
        d.lens.as<SurfaceLens>().surfaces[0].curvature_per_mm = 0.12, d.lens.as<SurfaceLens>().surfaces[1].curvature_per_mm = 0.14;
    }, example_surfaces},
    // the vertex plane is in the middle of a concave cup whose rim stands 10 - 8 = 2 mm higher
    Case{"diffuser.distance_mm", "extend 2 mm above the vertex plane", [](Display& d) {
        d.lens.as<SurfaceLens>().surfaces[1] = {0.1, 0, {}, 6, 0, 1};
        d.diffuser = Diffuser{1.5, {2, 2}};
    }, example_surfaces},
    Case{"camera.position_mm", "on the panel", [](Display& d) { d.camera.position_mm = {1, 1, 0}; }},
    Case{"camera.position_mm", "behind the panel", [](Display& d) { d.camera.position_mm = {1, 1, -5}; }},
    Case{"camera.position_mm", "lenses end 17.85", [](Display& d) { d.camera.position_mm[2] = 16; }},
    Case{"camera.position_mm", "diffuser stands 162.85", [](Display& d) { d.camera.position_mm[2] = 150; d.diffuser = Diffuser{145, {4, 4}}; }},
    Case{"camera.pupil_diameter_mm", "pupil's rim to z = 0", [](Display& d) {
        d.camera.position_mm = {1000, 0, 25}; d.camera.target_mm = {0, 0, 25}; d.camera.pupil_diameter_mm = 50; }},
    Case{"camera.up", "along the line of sight", [](Display& d) { d.camera.up = {0, 0, -3}; }},
    Case{"camera.up", "no direction", [](Display& d) { d.camera.up = {0, 0, 0}; }},
    Case{"camera.up[1]", "is nan", [](Display& d) { d.camera.up[1] = nan; }},
    Case{"camera.target_mm", "is the position of the camera", [](Display& d) { d.camera.target_mm = d.camera.position_mm; }},
    Case{"camera.fov_deg", "both", [](Display& d) { d.camera.fov_deg = 20; d.camera.frame_width_mm = 500; }},
    Case{"camera.fov_deg", "is 180", [](Display& d) { d.camera.fov_deg = 180; }},
    Case{"camera.fov_deg", "allowed is 1e-6 to 1e6", [](Display& d) { d.camera.fov_deg = 179.999; }},
    Case{"camera.resolution", "100000 x 30000 = 3000000000", [](Display& d) { d.camera.resolution = {100000, 30000}; }},
    Case{"camera.focus_distance_mm", "a pinhole has no focus", [](Display& d) { d.camera.focus_distance_mm = 500; }},
    Case{"camera.pupil_diameter_mm", "is -4", [](Display& d) { d.camera.pupil_diameter_mm = -4; }},
    Case{"content.viewing_distance_mm", "inside the display", [](Display& d) { d.content.viewing_distance_mm = 17; }}));

INSTANTIATE_TEST_SUITE_P(Errors, Fault, testing::Values(
    Case{"errors.shift_mm", "surround = \"clear\"", [](Display& d) { d.errors.shift_mm = {0.1, 0}; }, example_clear},
    Case{"errors.rotation_deg", "surround = \"clear\"", [](Display& d) { d.errors.rotation_deg = 0.1; }, example_clear},
    Case{"errors.decenter_sd_mm", "surround = \"clear\"", [](Display& d) { d.errors.decenter_sd_mm = 0.01; }, example_clear},
    Case{"errors.table", "surround = \"clear\"", [](Display& d) { d.errors.given = one_lens({{0.01, 0}, 0, {}, 0}); }, example_clear},
    Case{"errors.tilt_sd_deg", "do not turn; leave it out", [](Display& d) { d.errors.tilt_sd_deg = 0.1; }, example_plate},
    Case{"errors.table", "gives tilts", [](Display& d) { d.errors.given = one_lens({{}, 0, {0, 0.1}, 0}); }, example_plate},
    Case{"errors.curvature_sd", "no curvature; leave it out", [](Display& d) { d.errors.curvature_sd = 0.01; }, example_pinhole},
    Case{"errors.table", "gives curvatures", [](Display& d) { d.errors.given = one_lens({{}, 0, {}, 0.01}); }, example_pinhole},
    Case{"errors.gap_mm", "glued", [](Display& d) { d.errors.gap_mm = 0.1; }, example_glued},
    Case{"errors.wedge_deg", "glued", [](Display& d) { d.errors.wedge_deg = {0, 0.1}; }, example_glued},
    Case{"errors.bow_mm", "glued", [](Display& d) { d.errors.bow_mm = 0.1; }, example_glued},
    Case{"errors.height_sd_mm", "glued", [](Display& d) { d.errors.height_sd_mm = 0.01; }, example_glued},
    Case{"errors.tilt_sd_deg", "glued", [](Display& d) { d.errors.tilt_sd_deg = 0.1; }, example_glued},
    Case{"errors.table", "glued", [](Display& d) { d.errors.given = one_lens({{}, 0.01, {}, 0}); }, example_glued},
    Case{"errors.gap_mm", "into the panel; give less", [](Display& d) { d.errors.gap_mm = -14; }},
    Case{"errors.bow_mm", "into the panel", [](Display& d) { d.errors.bow_mm = -14; }},
    Case{"errors.decenter_sd_mm", "at most 0.6 mm", [](Display& d) { d.errors.decenter_sd_mm = 0.201; }},
    Case{"errors.curvature_sd", "would not reach the rim", [](Display& d) { d.errors.curvature_sd = 0.08; }},
    Case{"content.made_for", "wedge of strips", [](Display& d) { d.array.lattice = LatticeKind::strips; d.array.count.reset(); d.errors.wedge_deg = {0, 0.1}; d.content.made_for = MadeFor::built; }}));
TEST(Validate, ErrorsThatCanBe) {
    Display glued = example_glued(), plate = example_plate();
    glued.errors.shift_mm = {0.3, -0.2};
    glued.errors.rotation_deg = 1;
    glued.errors.pitch_ppm = 100;
    glued.errors.decenter_sd_mm = glued.errors.curvature_sd = 0.01;
    EXPECT_TRUE(validate(glued).empty());
    plate.errors.gap_mm = plate.errors.bow_mm = 0.1;
    plate.errors.wedge_deg = {0.1, 0};
    plate.errors.decenter_sd_mm = plate.errors.height_sd_mm = 0.01;
    EXPECT_TRUE(validate(plate).empty());
}
INSTANTIATE_TEST_SUITE_P(Glass, Fault, testing::Values(
    Case{"lens.index", "is missing; give lens.index, or lens.glass", [](Display& d) { d.lens.as<PlanoConvex>().index.reset(); }},
    Case{"panel.layer.0.index", "is missing; give panel.layer.0.index, or panel.layer.0.glass", [](Display& d) { d.panel.layers = {{1, {}, {}}}; }},
    Case{"lens.glass", "both lens.index and lens.glass given", [](Display& d) { d.lens.as<PlanoConvex>().glass = glass("PC"); }},
    Case{"lens.surface.0.glass", "both lens.surface.0.index and lens.surface.0.glass", [](Display& d) { d.lens.as<SurfaceLens>().surfaces[0].glass = glass("PC"); }, example_surfaces},
    Case{"panel.layer.0.glass", "both panel.layer.0.index and", [](Display& d) { d.panel.layers = {{1, 1.5, glass("PC")}}; }},
    Case{"lens.glass", "\"BK8\" has not been looked up", [](Display& d) { set_glass(d, {"BK8"}); }},
    Case{"lens.glass", "has 3 coefficients", [](Display& d) { set_glass(d, {"", Formula::nd_vd, {1.5, 60, 1}}); }},
    Case{"lens.glass", "vd = 0; an Abbe number is more than 0", [](Display& d) { set_glass(d, {"", Formula::nd_vd, {1.5, 0}}); }},
    Case{"lens.glass", "has an index of 0.9", [](Display& d) { set_glass(d, {"", Formula::cauchy, {0.9, 0, 0}}); }},
    Case{"lens.glass", "at 464.2 nm, allowed is 1 to 4", [](Display& d) { set_glass(d, {"", Formula::cauchy, {1.5, 0.55, 0}}); }},
    Case{"lens.glass", "has an index of nan", [](Display& d) { set_glass(d, {"", Formula::cauchy, {nan, 0, 0}}); }},
    Case{"lens.glass", "\"PMMA\" is valid from 420 to 1620 nm, but is used at 405 nm; take another glass, or other panel.wavelengths_nm",
         [](Display& d) { set_glass(d, glass("PMMA")); d.panel.wavelengths_nm[2] = 405; }},
    Case{"lens.glass", "\"PMMA\" is valid from 420 to 1620 nm, but is used at 41", [](Display& d) { set_glass(d, glass("PMMA")); d.panel.primary_widths_nm = {25, 25, 25}; d.render.wavelength_samples = 10; }},
    Case{"panel.wavelengths_nm[1]", "is nan", [](Display& d) { set_glass(d, glass("PMMA")); d.panel.wavelengths_nm[1] = nan; }},
    Case{"panel.primary_widths_nm[0]", "is 0, allowed is more than 0", [](Display& d) { d.panel.primary_widths_nm = {0, 20, 20}; }},
    Case{"render.wavelength_samples", "is 3, but panel.primary_widths_nm is missing", [](Display& d) { d.render.wavelength_samples = 3; }},
    Case{"render.wavelength_samples", "is 33, allowed is 1 to 32", [](Display& d) { d.render.wavelength_samples = 33; d.panel.primary_widths_nm = {20, 20, 20}; }}));
// clang-format on

TEST(Validate, FindsIndependentFaultsTogether) {
    Display d = example();
    d.panel.pixel_pitch_mm = nan;
    d.lens.as<PlanoConvex>().index = 9;
    d.lens.as<PlanoConvex>().sphere_radius_mm = 5;
    d.diffuser = Diffuser{-1, {200, 2}};
    d.camera.up = {0, 0, 1};
    d.camera.position_mm[2] = -1;
    d.render.samples = 0;
    std::vector<std::string> keys;
    for (const Problem& p : validate(d)) keys.push_back(p.where);
    EXPECT_THAT(keys,
                testing::UnorderedElementsAre("panel.pixel_pitch_mm", "lens.index", "lens.sphere_radius_mm", "diffuser.distance_mm",
                                              "diffuser.angle_deg[0]", "camera.up", "camera.position_mm", "render.samples"));
}

// Whatever the numbers, a display is refused or resolves to finite lengths.
TEST(Validate, WhatPassesIsFinite) {
    EXPECT_TRUE(rc::check([] {
        Display d = *rc::gen::element(example(), example_surfaces(), example_ideal());
        const auto hostile = [] {
            return *rc::gen::element(0.0, -0.0, 1e-300, 1e-6, 0.3, 1.0, 1.5, 5.9, 6.0, 12.0, 16.485, 100.0, 1e5, 1e6, 1e300, -1.0,
                                     nan, inf, -inf);
        };
        std::vector<double*> numbers{&d.panel.pixel_pitch_mm,  &d.array.pitch_mm[0],   &*d.array.gap_mm,
                                     &d.camera.position_mm[2], &d.camera.target_mm[0], &d.content.viewing_distance_mm};
        visit_all(d, [&](const std::string& path, const KeyInfo&, ValueRef value) {
            if (!path.starts_with("lens.")) return;
            if (auto* number = std::get_if<double*>(&value)) numbers.push_back(*number);
            if (auto* list = std::get_if<std::vector<double>*>(&value))
                for (double& a : **list) numbers.push_back(&a);
        });
        for (int i = *rc::gen::inRange(1, 3); i > 0; --i) *numbers[*rc::gen::inRange<std::size_t>(0, numbers.size())] = hostile();
        d.array.aperture = *rc::gen::element(Aperture::circle, Aperture::cell);
        if (auto* ball = std::get_if<PlanoConvex>(&d.lens.kind)) ball->facing = *rc::gen::element(Facing::viewer, Facing::panel);
        const bool valid = validate(d).empty();
        RC_CLASSIFY(valid);
        if (!valid) return;
        const Geometry g = resolve(d);
        for (const double z :
             {g.base_z_mm, g.top_z_mm, g.vertex_plane_mm, g.front_principal_mm, g.rear_principal_mm, g.gap_mm, g.stop_z_mm,
              g.glass_radius_mm, g.clear_aperture_mm[0], g.frame_width_mm, g.focus_distance_mm, g.content_depth_mm})
            RC_ASSERT(std::isfinite(z));
        RC_ASSERT(g.base_z_mm > -1e-6 && g.top_z_mm >= g.base_z_mm && g.gap_mm > 0 && g.clear_aperture_mm[0] > 0);
        const Theory t = theory(d, g);
        for (const double x : {t.along[0].fov_deg, t.central_depth_mm, t.pixel_image_mm, t.depth_of_field_mm, t.depth_near_per_mm,
                               t.depth_far_per_mm, t.along[0].elemental_pitch_mm, t.along[0].fov_elemental_deg})
            RC_ASSERT(!std::isnan(x));
        RC_ASSERT(std::isnan(t.along[0].viewing_zone_deg) == !(camera_distance_mm(d) > g.rear_principal_mm));
    }));
}

}  // namespace
}  // namespace lfdsim
