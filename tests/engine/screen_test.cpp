#include "engine/screen.h"

#include <gtest/gtest.h>
#include <cmath>

#include "../optics/example.h"
#include "engine/scene.h"
#include "optics/camera.h"

namespace lfdsim {
namespace {

Display oblique(double rotation_deg) {
    Display d = example();
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
        const auto corners = screen_corners(d, g);
        ASSERT_TRUE(corners);
        optics::View view = make_view(d, g);
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
    EXPECT_FALSE(screen_corners(d, resolve(d)));
}

}  // namespace
}  // namespace lfdsim
