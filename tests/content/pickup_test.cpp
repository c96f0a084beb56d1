// The nodal pick-up against its closed forms.
#include "content/pickup.h"
#include "small_world.h"

#include <map>
#include <random>

namespace {

using namespace small_world;

struct Case {
    double viewing_distance_mm, rotation_deg, offset_x, offset_y, height_of_cell = 1;
};

class PickupTest : public testing::TestWithParam<Case> {
  protected:
    Display make() const {
        Display d = display();
        d.content.viewing_distance_mm = GetParam().viewing_distance_mm;
        d.array.rotation_deg = GetParam().rotation_deg;
        d.array.lattice = LatticeKind::rectangle;
        d.array.pitch_mm[1] *= GetParam().height_of_cell;
        *d.lens.as<IdealLens>().aperture_radius_mm *= std::min(1., GetParam().height_of_cell);
        d.array.offset_mm = {GetParam().offset_x, GetParam().offset_y};
        return d;
    }
    // Axis of lens (i, j), from the definition: the lattice, turned, then moved.
    static std::array<double, 2> axis(const Display& d, int i, int j) {
        const double u = (i + 0.5 - 0.5 * double(d.array.count[0])) * d.array.pitch_mm[0],
                     v = (j + 0.5 - 0.5 * double(d.array.count[1])) * d.array.pitch_mm[1];
        const double a = d.array.rotation_deg * 3.14159265358979323846 / 180;
        return {u * std::cos(a) - v * std::sin(a) + d.array.offset_mm[0], u * std::sin(a) + v * std::cos(a) + d.array.offset_mm[1]};
    }
};

// Elemental images have pitch p (1 + g / (D - z_rear)); the line of each one's centre passes the viewer (0, 0, D), or runs
// along the axis when D is infinite.
TEST_P(PickupTest, CentresFollowThePitchLawAndLookAtTheViewer) {
    const Display d = make();
    const Geometry g = resolve(d);
    const Pickup pickup(d, g);
    const double distance = d.content.viewing_distance_mm;
    const double law = std::isinf(distance) ? 1 : 1 + g.gap_mm / (distance - g.rear_principal_mm);
    for (int i = 0; i < d.array.count[0]; ++i) {
        for (int j = 0; j < d.array.count[1]; ++j) {
            const auto [x, y] = axis(d, i, j);
            const NodalLine line = pickup.line(x * law, y * law);
            ASSERT_TRUE(line.owned);
            EXPECT_NEAR(line.x, x, 1e-9);
            EXPECT_NEAR(line.y, y, 1e-9);
            if (std::isinf(distance)) {
                EXPECT_NEAR(line.mx, 0, 1e-9);
            } else {
                EXPECT_NEAR(line.x + line.mx * (distance - g.rear_principal_mm), 0, 1e-6);
                EXPECT_NEAR(line.y + line.my * (distance - g.rear_principal_mm), 0, 1e-6);
            }
            const Pickup::Place place = pickup.place(x * law, y * law);
            EXPECT_NEAR(place.u, 0, 1e-9);
            EXPECT_NEAR(place.v, 0, 1e-9);
        }
    }
}

// The owner is the lens with the nearest centre, found here by looking at all of them; beyond the array there is none.
TEST_P(PickupTest, OwnerIsTheNearestCentre) {
    const Display d = make();
    const Geometry g = resolve(d);
    const Pickup pickup(d, g);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> x_mm(-30, 30), y_mm(-22, 22);
    int owned = 0;
    for (int n = 0; n < 2000; ++n) {
        const double x = x_mm(random), y = y_mm(random);
        double best = 1e9, best_x = 0, best_y = 0;
        bool inside = false;
        for (int i = -6; i < d.array.count[0] + 6; ++i) {
            for (int j = -6; j < d.array.count[1] + 6; ++j) {
                const auto [cx, cy] = axis(d, i, j);
                const double distance = std::hypot(x - cx * pickup.scale, y - cy * pickup.scale);
                if (distance >= best) continue;
                best = distance, best_x = cx, best_y = cy;
                inside = i >= 0 && i < d.array.count[0] && j >= 0 && j < d.array.count[1];
            }
        }
        const NodalLine line = pickup.line(x, y);
        ASSERT_EQ(line.owned, inside) << x << ", " << y;
        if (!inside) continue;
        ++owned;
        EXPECT_NEAR(line.x, best_x, 1e-9);
        EXPECT_NEAR(line.y, best_y, 1e-9);
    }
    EXPECT_GT(owned, 500);
    EXPECT_LT(owned, 2000);
}

// A point (X, Y) at height z above the rear nodal point shows through the lens at C on the panel at C - g (X - C) / z.
TEST_P(PickupTest, APointIsImagedWhereTheNodalRayMeetsThePanel) {
    const Display d = make();
    const Geometry g = resolve(d);
    const Pickup pickup(d, g);
    const auto [cx, cy] = axis(d, 5, 3);
    for (const double z : {-40., 30., 300.}) {
        const double target_x = cx + 0.05 * z, target_y = cy - 0.07 * z;
        const NodalLine line = pickup.line(cx - g.gap_mm * (target_x - cx) / z, cy - g.gap_mm * (target_y - cy) / z);
        ASSERT_TRUE(line.owned);
        EXPECT_NEAR(line.x + line.mx * z, target_x, 1e-9);
        EXPECT_NEAR(line.y + line.my * z, target_y, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Displays, PickupTest,
                         testing::Values(Case{std::numeric_limits<double>::infinity(), 0, 0, 0}, Case{600, 0, 0, 0},
                                         Case{600, 0, 0.7, -1.3}, Case{300, 12.5, 0.7, -1.3}, Case{450, -31, 0.2, 0.4, 0.7},
                                         Case{std::numeric_limits<double>::infinity(), -45, 2, 1}));

// With elemental images of exactly 20 x 20 pixels each lens owns just those.
TEST(Pickup, WholePixelsAreShared) {
    const Display d = display();
    const Pickup pickup(d, resolve(d));
    std::map<std::pair<double, double>, int> pixels;
    for (int row = 0; row < d.panel.pixels[1]; ++row) {
        for (int column = 0; column < d.panel.pixels[0]; ++column) {
            const NodalLine line = pickup.line(pickup.x_mm(column), pickup.y_mm(row));
            ASSERT_TRUE(line.owned);
            ++pixels[{line.x, line.y}];
        }
    }
    EXPECT_EQ(pixels.size(), 96u);
    for (const auto& [lens, count] : pixels) EXPECT_EQ(count, 400);
}

// A plano-convex lens has two nodal points: the gap is measured to the front one, the line leaves from the rear one (the apex).
TEST(Pickup, ThickLensUsesBothNodalPoints) {
    Display d = display();
    d.lens.kind = PlanoConvex{5, 2, 1, 1.5, Facing::viewer};
    const Geometry g = resolve(d);
    EXPECT_DOUBLE_EQ(g.front_principal_mm, 10);
    // Thickness T = h + R - sqrt(R^2 - r^2); the front point lies T/n above the base, the rear one at T.
    const double thickness = 1 + 5 - std::sqrt(21.);
    EXPECT_NEAR(g.rear_principal_mm - g.front_principal_mm, thickness * (1 - 1 / 1.5), 1e-12);
    const Pickup pickup(d, g);
    EXPECT_EQ(pickup.z_rear, g.rear_principal_mm);
    const NodalLine line = pickup.line(2.5, 2);  // half a millimetre beside the axis of the lens at (2, 2)
    EXPECT_NEAR(line.mx, -0.05, 1e-12);
    EXPECT_NEAR(line.my, 0, 1e-12);
}

}  // namespace
