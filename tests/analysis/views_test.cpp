#include "analysis/pictures/views.h"

#include "analysis/fov/elemental_fov.h"
#include "analysis/fov/fov.h"
#include "analysis/resolution/dof.h"
#include "analysis/resolution/dof_depths.h"
#include "base/constants.h"
#include "example.h"

#include <gtest/gtest.h>
#include <cmath>

namespace lfdsim {
namespace {

using analysis_example::display;

TEST(Views, CameraGoesRoundThePanelsCentre) {
    Display d = display(40, 200);
    d.camera.position_mm = {300, 0, 400};
    const Camera c = seen_from(d, 30, -20).camera;
    EXPECT_NEAR(std::hypot(c.position_mm[0], c.position_mm[1], c.position_mm[2]), 500, 1e-9);
    EXPECT_NEAR(std::atan2(c.position_mm[0], c.position_mm[2]) * 180 / M_PI, 30, 1e-9);
    EXPECT_NEAR(std::asin(c.position_mm[1] / 500) * 180 / M_PI, -20, 1e-9);
}

// On axis the array's rectangle in the plane z is (D / (D - z)) times as large as in the frame through the target at z = 0; where
// it is as large as the panel, that ends the screen, in the plane z = 0.
TEST(Views, ScreenIsWhereTheArrayIsSeen) {
    Display d = display(40, 200);
    const auto behind_panel = resolve(d);
    const double per_mm_of_panel = double(d.camera.resolution[0]) / behind_panel.frame_width_mm;
    EXPECT_NEAR(double(seen_screen(seen_from(d, 0, 0), behind_panel).pixels()), 240 * 144 * per_mm_of_panel * per_mm_of_panel,
                2 * (240 + 144) * per_mm_of_panel * 0.51);
    d.panel.pixels = {1240, 760};
    const Geometry g = resolve(d);
    const Display seen = seen_from(d, 0, 0);
    const double per_mm = double(d.camera.resolution[0]) / g.frame_width_mm * 2000 / (2000 - g.vertex_plane_mm);
    EXPECT_NEAR(double(seen_screen(seen, g).pixels()), g.array_width_mm * g.array_height_mm * per_mm * per_mm,
                2 * (g.array_width_mm + g.array_height_mm) * per_mm * 0.51);
    const Rect box = seen_screen(seen_from(d, 60, 0), g).bounds();
    EXPECT_LT(box.x1 - box.x0, 0.6 * g.array_width_mm * per_mm);  // the cosine of 60 degrees, and perspective
    Display behind = seen;
    behind.camera.position_mm = {0, 0, -500};
    EXPECT_EQ(seen_screen(behind, g).pixels(), 0);
}

// Elemental images stay where they are made: the field of view of an array that is shifted by 1.5 mm is not symmetric.
TEST(FieldOfView, MovesWithAShiftedArray) {
    Display d = display(40, 150);
    const auto edges = [&] {
        const OwnLens lens(d, false);
        const auto choices = even_choices(2048);
        const auto share = [&](double deg) {
            return lens.share({600 * std::sin(deg * degree), 0, 600 * std::cos(deg * degree)}, choices);
        };
        return std::array{share(-15), share(15)};
    };
    const auto straight = edges();
    EXPECT_GT(straight[0], 0.8);
    EXPECT_GT(straight[1], 0.8);
    d.errors.shift_mm = {0.37 * d.array.pitch_mm[0], 0};
    const auto shifted = edges();
    EXPECT_LT(shifted[0], 0.2);
    EXPECT_GT(shifted[1], 0.8);
}

class Fields : public testing::TestWithParam<double> {};
const auto degrees_of = [](const auto& fov) { return std::to_string(int(fov.param)); };
INSTANTIATE_TEST_SUITE_P(Degrees, Fields, testing::Values(40.), degrees_of);
INSTANTIATE_TEST_SUITE_P(AtLength, Fields, testing::Values(24., 60.), degrees_of);

// An ideal lens: the edges stand where theory says, within a degree each, with a diffuser that closes the gaps between lenses.
TEST_P(Fields, EdgesStandWhereTheoryHasThem) {
    Display d = display(GetParam(), 150);
    Subject s(d, ContentScene(built_in_model(), d, resolve(d)), {});
    ASSERT_NEAR(s.theory().along[0].fov_deg, GetParam(), 1e-6);
    Job job;
    const Result r = measure_fov(s, job);
    for (const char* axis : {"horizontal", "vertical"})
        for (const std::size_t side : {0u, 1u}) {
            const Json& of = r.figures.at(axis);
            const double theory = (side ? 1 : -1) * r.figures.at("theory_edge_deg").get<double>();
            const auto figure = [&](const char* name) { return of.at(name).at(side).get<double>(); };
            EXPECT_NEAR(figure("own_lens_deg"), theory, figure("own_lens_deg_error") + 0.01) << axis;
            EXPECT_LE(figure("own_lens_deg_error"), 0.05) << axis;
            EXPECT_EQ(of.at("own_lens_deg").at(0).get<double>(), -of.at("own_lens_deg").at(1).get<double>());
            EXPECT_NEAR(figure("gradient_edge_deg"), theory, figure("gradient_edge_deg_error")) << axis;
            EXPECT_LT(figure("gradient_edge_deg_error"), 2.5) << axis;
            // The content's likeness leads; a black background raises the whole screen's, which stands beside it.
            EXPECT_EQ(of.at("ssim_rule_deg"), of.at("content").at("ssim_rule_deg"));
            EXPECT_LT(of.at("middle_ssim").get<double>(), of.at("screen").at("middle_ssim").get<double>() - 0.005);
        }
}

// Ideal hexagons, focused so far away that an eye sees a point under each: their images are 2 / sqrt(3) as high as they are wide.
// Strips are told to be what they are.
TEST(Views, EyeboxOfHexagonsAndFieldOfStrips) {
    Display d = display(40, 1500);
    d.diffuser.reset();
    d.camera.resolution = {120, 72};
    d.array.lattice = LatticeKind::hexagon;
    AnalysisOptions options;
    options.angles_deg = {-1, 0, 1};
    Job job;
    Subject hexagons(d, ContentScene(built_in_model(), d, resolve(d)), options);
    const Json box = measure_fov(hexagons, job).figures;
    const Json &theory = box.at("theory_eyebox_mm"), &measured = box.at("eyebox_mm");
    EXPECT_NEAR(theory[1].get<double>(), theory[0].get<double>() * 2 / std::sqrt(3), 1e-6);
    for (const std::size_t k : {0u, 1u}) EXPECT_NEAR(measured[k].get<double>() / theory[k].get<double>(), 1, 0.015) << k;
    d.array.lattice = LatticeKind::strips;
    d.array.count.reset();
    Subject strips(d, ContentScene(built_in_model(), d, resolve(d)), options);
    bool named = false;
    for (const Finding& f : measure_fov(strips, job).findings) {
        EXPECT_EQ(f.what.find("horizontal"), std::string::npos) << f.what;
        named = named || f.what == "Field of view, across the strips";
    }
    EXPECT_TRUE(named);
}

// By the lens theory calls 0 to 2 L sharp, by the pixel less: a quarter more, through the lenses, which are one of the depths.
TEST(Views, DepthsOfTheDepthOfField) {
    for (const double L : {60., -60.}) {
        const Display d = display(40, L);
        const std::vector<double> depths = dof_depths(Subject(d, std::nullopt, {})).depths_mm;
        ASSERT_GE(depths.size(), 30u);
        EXPECT_TRUE(std::ranges::is_sorted(depths));
        EXPECT_NE(std::ranges::find(depths, 0.), depths.end());
        EXPECT_NEAR(L > 0 ? depths.back() : depths.front(), 1.25 * 2 * L, 1e-6);
        EXPECT_LT(depths.front(), 0);
    }
}

// Collimated, all depths are sharp by the lens and from some distance on by the pixel: as far as makes sense on either side.
TEST(Views, DepthsThroughInfinityAreCut) {
    Display d = display(40, 200);
    d.lens.as<IdealLens>().focal_length_mm = *d.array.gap_mm;
    d.diffuser.reset();
    const DepthRun run = dof_depths(Subject(d, std::nullopt, {}));
    ASSERT_GT(run.depths_mm.size(), 25u);
    EXPECT_LT(run.depths_mm.front(), 0);
    EXPECT_GT(run.depths_mm.back(), 100);
    EXPECT_LT(run.depths_mm.back(), 2000 - *d.array.gap_mm);
}

TEST(Views, AStoppedMeasureStops) {
    struct Stop : Job {
        bool cancelled() const override { return true; }
    } stop;
    Display d = display(40, 150);
    Subject s(d, ContentScene(built_in_model(), d, resolve(d)), {});
    EXPECT_THROW(measure_fov(s, stop), Stopped);
    EXPECT_THROW(measure_dof(s, stop), Stopped);
}

TEST(Views, DepthsInsideTheLensesAreRefused) {
    Display d = display(40, 150);
    AnalysisOptions options;
    d.lens.kind = PlanoConvex{8, 3, 1, 1.5, Facing::viewer};
    d.array.aperture = Aperture::circle;
    options.depths_mm = {-3, -0.5, 1};
    Subject s(d, ContentScene(built_in_model(), d, resolve(d)), options);
    Job job;
    EXPECT_THROW(measure_dof(s, job), InputError);
}

}  // namespace
}  // namespace lfdsim
