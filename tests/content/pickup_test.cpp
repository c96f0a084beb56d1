// The nodal pick-up against its closed forms.
#include "content/pickup/pickup.h"
#include "base/constants.h"
#include "small_world.h"

#include <map>
#include <random>

namespace {

using namespace small_world;

struct Case {
    double viewing_distance_mm, rotation_deg, offset_x, offset_y, height_of_cell = 1;
    LatticeKind lattice = LatticeKind::rectangle;
};

class PickupTest : public testing::TestWithParam<Case> {
  protected:
    Display make() const {
        Display d = display();
        d.content.viewing_distance_mm = GetParam().viewing_distance_mm;
        d.array.rotation_deg = GetParam().rotation_deg;
        d.array.lattice = GetParam().lattice;
        d.array.pitch_mm[1] *= GetParam().height_of_cell;
        *d.lens.as<IdealLens>().aperture_radius_mm *= std::min(1., GetParam().height_of_cell);
        d.array.offset_mm = {GetParam().offset_x, GetParam().offset_y};
        return d;
    }
    // Axis of lens (i, j), from the definition: the lattice, turned, then moved.
    static std::array<double, 2> axis(const Display& d, int i, int j) {
        const double px = d.array.pitch_mm[0],
                     py = d.array.lattice == LatticeKind::hexagon ? px * std::sqrt(3) / 2 : d.array.pitch_mm[1];
        const double aside = d.array.lattice == LatticeKind::rectangle ? 0 : (j & 1) != 0 ? px / 4 : -px / 4;
        const double u = (i + 0.5 - 0.5 * double(d.array.count->at(0))) * px + aside,
                     v = (j + 0.5 - 0.5 * double(d.array.count->at(1))) * py;
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
    for (int i = 0; i < d.array.count->at(0); ++i) {
        for (int j = 0; j < d.array.count->at(1); ++j) {
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
            const Pickup::ElementalPosition place = pickup.place(x * law, y * law);
            EXPECT_NEAR(place.u, 0, 1e-9);
            EXPECT_NEAR(place.v, 0, 1e-9);
        }
    }
}

// The owner is the lens with the nearest centre, of bricks the one whose cell holds the point, found here by looking at all of
// them; beyond the array there is none.
TEST_P(PickupTest, OwnerIsTheLensOfTheCell) {
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
        for (int i = -6; i < d.array.count->at(0) + 6; ++i) {
            for (int j = -6; j < d.array.count->at(1) + 6; ++j) {
                const auto [cx, cy] = axis(d, i, j);
                const double dx = x - cx * pickup.scale, dy = y - cy * pickup.scale, a = d.array.rotation_deg * degree;
                const double distance = d.array.lattice != LatticeKind::brick
                                            ? std::hypot(dx, dy)
                                            : std::max(std::abs(std::cos(a) * dx + std::sin(a) * dy) / d.array.pitch_mm[0],
                                                       std::abs(std::cos(a) * dy - std::sin(a) * dx) / d.array.pitch_mm[1]);
                if (distance >= best) continue;
                best = distance, best_x = cx, best_y = cy;
                inside = i >= 0 && i < d.array.count->at(0) && j >= 0 && j < d.array.count->at(1);
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
                                         Case{500, 21, 0.5, -0.3, 1, LatticeKind::hexagon},
                                         Case{700, -8, 0.4, 0.9, 1.4, LatticeKind::brick},
                                         Case{std::numeric_limits<double>::infinity(), -45, 2, 1}));

// Strips that image the panel onto the eye's distance: whatever point of the sheet a ray from an eye on the line y = 0, z = D aims
// at, or x = 0 where the strips lie flat, the panel point that it reaches was made for just that eye.
TEST(Pickup, StripsShowEachEyeOnTheLineItsOwnView) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> even(-1, 1);
    int own = 0, all = 0;
    for (const double slant : {-35., 0., 9.46, 18.43, 60., -75., 75.1, -85., 90., -270.}) {
        for (const double D : {400., 900.}) {
            Display d = display();
            d.array.lattice = LatticeKind::strips;
            d.array.count.reset();
            d.array.rotation_deg = -slant;
            d.array.pitch_mm = 3;
            d.array.offset_mm = {0.4, -1.7};
            d.content.viewing_distance_mm = D;
            d.lens.kind = IdealLens{1.5, 1 / (1 / 10. + 1 / (D - 10))};
            const Pickup pickup(d, resolve(d));
            const double c = std::cos(slant * degree), s = std::sin(slant * degree);  // across the strips: (c, -s)
            const bool flat = std::abs(slant) > 75;
            for (int n = 0; n < 400; ++n) {
                const double eye = 25 * even(random), x = 18 * even(random), y = 14 * even(random);  // at the lenses, z = 10
                const double across = c * (x - 0.4) - s * (y + 1.7);
                // An even number of strips covers the panel or an odd one: axes at multiples of the pitch, or half-way.
                const double half = std::fmod(double(pickup.lattice().count[0]), 2) == 0 ? 0.5 : 0;
                const double axis = 3 * (std::round(across / 3 - half) + half),
                             bend = (across - axis) / d.lens.as<IdealLens>().focal_length_mm;
                const double mx = (x - (flat ? 0 : eye)) / (10 - D) + c * bend,  // slopes below the lens
                    my = (y - (flat ? eye : 0)) / (10 - D) - s * bend;
                const NodalLine line = pickup.line(x - 10 * mx, y - 10 * my);
                ++all;
                if (!line.owned || std::abs(c * (line.x - 0.4) - s * (line.y + 1.7) - axis) > 1e-9) continue;  // a neighbour's view
                ++own;
                EXPECT_NEAR(line.x + line.mx * (D - 10), flat ? 0 : eye, 1e-8) << slant;
                EXPECT_NEAR(line.y + line.my * (D - 10), flat ? eye : 0, 1e-8) << slant;
            }
        }
    }
    EXPECT_GT(own, all / 2);
}

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
