#include "engine/views/screen.h"

#include <gtest/gtest.h>
#include <cmath>

#include "../optics/example.h"
#include "engine/scene/traced_display.h"
#include "optics/camera.h"

namespace lfdsim {
namespace {

Display oblique(double rotation_deg) {
    Display d = example();
    d.panel.pixels = {400, 280};
    d.array.count = {11, 6};
    d.array.rotation_deg = rotation_deg;
    d.array.offset_mm = {3, -2};
    d.camera.position_mm = {150, -80, 420};
    d.camera.target_mm = {5, 2, 1};
    d.camera.up = {0.1, 1, 0};
    return d;
}

// The other way round: the camera's ray through each corner of the picture must meet the corner of the array.
TEST(ScreenCorners, RaysThroughThemMeetTheArray) {
    for (const double rotation : {0.0, 20.0, 90.0, -110.0, 180.0}) {
        const Display d = oblique(rotation);
        const Geometry g = resolve(d);
        const auto corners = screen_corners(d, g).at;
        ASSERT_TRUE(corners);
        optics::RayOrigin view = make_ray_origin(d, g);
        view.start_z = g.vertex_plane_mm;
        for (const auto& [column, row] : *corners) {
            double direction[3], x, y;
            optics::follow_to_first_plane(view, column, row, direction, x, y);
            EXPECT_NEAR(std::abs(x), g.array_width_mm / 2, 1e-9);
            EXPECT_NEAR(std::abs(y), g.array_height_mm / 2, 1e-9);
        }
        EXPECT_NO_THROW(check_corners("", *corners));  // four different ones in order
        const auto& [a, b, c, e] = *corners;
        EXPECT_LT(a[0] + e[0], b[0] + c[0]);  // left is left
        EXPECT_LT(a[1] + b[1], c[1] + e[1]);  // top is up
    }
}

TEST(ScreenCorners, NoneBehindTheCamera) {
    Display d = oblique(0);
    d.array.count = {4000, 6};
    d.camera.position_mm = {0, 0, 50};
    d.camera.target_mm = {100, 0, 1};
    EXPECT_FALSE(screen_corners(d, resolve(d)).at);
}

// Slanted strips without a count cover the panel's bounding box. What is seen of them ends where the panel does.
TEST(ScreenCorners, AreThePanelsWhereTheArrayReachesOverIt) {
    for (const double slant : {18.43, -30., 71.6}) {
        Display d = example();
        d.array.lattice = LatticeKind::strips;
        d.array.slant_deg = slant;
        d.array.count.reset();
        d.camera.position_mm = {25, -10, 400};  // it looks straight down at the panel's plane, where its frame is 44 mm wide
        d.camera.target_mm = {25, -10, 0};
        const Geometry g = resolve(d);
        const auto corners = screen_corners(d, g).at;
        ASSERT_TRUE(corners) << slant;
        constexpr double right[] = {-1, 1, 1, -1}, up[] = {1, 1, -1, -1}, pixels = 160 / 44.;
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR((*corners)[k][0], 80 + pixels * (right[k] * g.panel_width_mm / 2 - 25), 1e-9) << slant << ", corner " << k;
            EXPECT_NEAR((*corners)[k][1], 56 - pixels * (up[k] * g.panel_height_mm / 2 + 10), 1e-9) << slant << ", corner " << k;
        }
    }
}

// Lenses that reach over the panel by less than half of one are lit to their rims.
TEST(ScreenCorners, OfAnArrayThatThePanelLights) {
    Display d = example();
    d.array.count = {10, 7};  // as wide and high as the panel
    d.camera.position_mm = {60, 0, 400};
    const Geometry g = resolve(d);
    const Corners corners = *screen_corners(d, g).at;
    d.panel.pixels = {400, 280};
    const Corners of_array = *screen_corners(d, resolve(d)).at;
    EXPECT_EQ(corners, of_array);
    d.array.count = {13, 9};
    d.array.rotation_deg = 30;
    d.panel.pixels = {160, 112};
    EXPECT_NE(screen_corners(d, resolve(d)).missing.find("corners"), std::string::npos);
}

}  // namespace
}  // namespace lfdsim
