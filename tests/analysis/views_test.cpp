#include "analysis/views.h"

#include "analysis/dof.h"
#include "analysis/fov.h"
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

// On axis the array's rectangle in the plane z is (D / (D - z)) times as large as in the frame through the target at z = 0.
TEST(Views, ScreenIsWhereTheArrayIsSeen) {
    Display d = display(40, 200);
    const Geometry g = resolve(d);
    const Display seen = seen_from(d, 0, 0);
    const double per_mm = double(d.camera.resolution[0]) / g.frame_width_mm * 2000 / (2000 - g.vertex_plane_mm);
    EXPECT_NEAR(double(screen_region(seen, g).pixels()), g.array_width_mm * g.array_height_mm * per_mm * per_mm,
                2 * (g.array_width_mm + g.array_height_mm) * per_mm * 0.51);
    const Rect box = screen_region(seen_from(d, 60, 0), g).bounds();
    EXPECT_LT(box.x1 - box.x0, 0.6 * g.array_width_mm * per_mm);  // the cosine of 60 degrees, and perspective
    Display behind = seen;
    behind.camera.position_mm = {0, 0, -500};
    EXPECT_EQ(screen_region(behind, g).pixels(), 0);
}

class Fields : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Degrees, Fields, testing::Values(24., 40., 60.),
                         [](const auto& fov) { return std::to_string(int(fov.param)); });

// An ideal lens: the edges stand where theory says, within a degree each, with a diffuser that closes the gaps between lenses.
TEST_P(Fields, EdgesStandWhereTheoryHasThem) {
    Display d = display(GetParam(), 150);
    Subject s(d, Scene(built_in_model(), d, resolve(d)), {});
    ASSERT_NEAR(s.theory().fov_deg, GetParam(), 1e-6);
    Job job;
    const Result r = measure_fov(s, job);
    for (const char* axis : {"horizontal", "vertical"})
        for (const std::size_t side : {0u, 1u}) {
            const Json& limit = r.figures.at(axis).at("gradient_edge_deg").at(side);
            ASSERT_TRUE(limit.is_number()) << axis;
            EXPECT_NEAR(limit.get<double>(), (side ? 0.5 : -0.5) * GetParam(), 1) << axis;
        }
}

TEST(Views, DepthsOfTheDepthOfField) {
    Display d = display(40, 200);
    Subject s(d, std::nullopt, {});
    const std::vector<double> depths = dof_depths_mm(s);
    ASSERT_EQ(depths.size(), 31u);
    EXPECT_NEAR(depths.front(), 50, 1e-9);  // an ideal lens is its own vertex and principal plane
    EXPECT_NEAR(depths.back(), 350, 1e-9);
    Display near = display(40, 60);
    EXPECT_NEAR(dof_depths_mm(Subject(near, std::nullopt, {})).front(), 10, 1e-9);
    Display behind = display(40, -200);
    EXPECT_NEAR(dof_depths_mm(Subject(behind, std::nullopt, {})).back(), -50, 1e-9);
}

TEST(Views, AStoppedMeasureStops) {
    struct Stop : Job {
        bool cancelled() const override { return true; }
    } stop;
    Display d = display(40, 150);
    Subject s(d, Scene(built_in_model(), d, resolve(d)), {});
    EXPECT_THROW(measure_fov(s, stop), Stopped);
    EXPECT_THROW(measure_dof(s, stop), Stopped);
}

TEST(Views, DepthsInsideTheLensesAreRefused) {
    Display d = display(40, 150);
    AnalysisOptions options;
    options.depths_mm = {-1, 0, 1};
    Subject s(d, Scene(built_in_model(), d, resolve(d)), options);
    Job job;
    EXPECT_THROW(measure_dof(s, job), InputError);
}

}  // namespace
}  // namespace lfdsim
