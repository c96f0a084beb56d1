// Sag and first-order optics against closed forms.
#include "geometry/prescription.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "example.h"

namespace lfdsim {
namespace {

TEST(Sag, SphereParaboloidAndPlane) {
    for (const double s : {0.0, 1e-3, 2.5, 6.0}) {
        EXPECT_NEAR(sag_mm(1 / 7.28, 0, {}, s), 7.28 - std::sqrt(7.28 * 7.28 - s * s), 1e-14);
        EXPECT_NEAR(sag_mm(-0.1, -1, {}, s), -0.05 * s * s, 1e-15);
        EXPECT_EQ(sag_mm(0, 3, {}, s), 0);
        EXPECT_NEAR(sag_mm(0, 0, {1e-3, -2e-5}, s), 1e-3 * std::pow(s, 4) - 2e-5 * std::pow(s, 6), 1e-15);
    }
    EXPECT_TRUE(std::isnan(sag_mm(0.1, 0, {}, 10.1)));
}

// A paraboloid with a fourth-order term that turns it back: c s^2/2 + a s^4 has its extremum -c^2/(16 a) at s^2 = -c/(4 a).
TEST(Sag, ExtremumInsideTheAperture) {
    const double c = 0.2, a = -2e-3;
    const auto [low, high] = sag_range_mm({0, c, -1, {a}, 8, 1, 1.5});
    EXPECT_NEAR(high, -c * c / (16 * a), 1e-12);
    EXPECT_NEAR(low, c * 32 + a * 4096, 1e-12);  // at the rim
}

TEST(Sag, ClearanceOfCrossingSurfaces) {
    // flat, then a cap of R = 10 convex to the viewer, 1 mm behind: at s = 6 its rim is 10 - 8 = 2 mm below its vertex
    EXPECT_NEAR(clearance_mm({0, 0, 0, {}, 6, 1, 1.5}, {1, -0.1, 0, {}, 7, 1.5, 1}), -1, 1e-12);
}

// Principal planes of a plano-convex lens of thickness T: T/n into it from the flat side, and in the convex vertex.
TEST(Cardinal, PlanoConvexBothWays) {
    Display d = example();
    const double R = 7.28, n = 1.4918, T = 1 + R - std::sqrt(R * R - 36);
    Cardinal c = cardinal_points(prescription(d.lens, d.array, 550));
    EXPECT_NEAR(c.focal_length_mm, R / (n - 1), 1e-12);
    EXPECT_NEAR(c.front_principal_mm, T / n, 1e-12);
    EXPECT_NEAR(c.rear_principal_mm, T, 1e-12);
    d.lens.as<PlanoConvex>().facing = Facing::panel;
    c = cardinal_points(prescription(d.lens, d.array, 550));
    EXPECT_NEAR(c.focal_length_mm, R / (n - 1), 1e-12);
    EXPECT_NEAR(c.front_principal_mm, 0, 1e-12);
    EXPECT_NEAR(c.rear_principal_mm, T - T / n, 1e-12);
}

// A ball of radius R: f = n R / (2 (n - 1)), both principal planes through its centre.
TEST(Cardinal, Ball) {
    const double R = 3, n = 1.7;
    const Cardinal c = cardinal_points({{0, 1 / R, 0, {}, 1, 1, n}, {2 * R, -1 / R, 0, {}, 1, n, 1}});
    EXPECT_NEAR(c.focal_length_mm, n * R / (2 * (n - 1)), 1e-12);
    EXPECT_NEAR(c.front_principal_mm, R, 1e-12);
    EXPECT_NEAR(c.rear_principal_mm, R, 1e-12);
}

// A slab of glass shifts a ray's crossing of the axis by T (1 - 1/n) and keeps its direction.
TEST(Cardinal, SlabIsAfocal) {
    const Cardinal c = cardinal_points({{2, 0, 0, {}, 1, 1, 1.5}, {5, 0, 0, {}, 1, 1.5, 1}});
    EXPECT_TRUE(std::isinf(c.focal_length_mm));
    EXPECT_NEAR(c.rear_principal_mm - c.front_principal_mm, 3 * (1 - 1 / 1.5), 1e-12);
}

// Any lens turned round has the same focal length and its principal planes mirrored.
TEST(Cardinal, ReversalOfAnyLens) {
    EXPECT_TRUE(rc::check([] {
        const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) / 1000.0; };
        std::vector<PlacedSurface> lens, turned;
        const int count = *rc::gen::inRange(2, 6);
        double z = 0, below = 1;
        for (int i = 0; i < count; ++i) {
            const double above = i + 1 < count ? number(1100, 2000) : 1;  // few are afocal: rapidcheck gives up where many are
            lens.push_back({z, number(-100, 101), 0, {}, 1, below, above});
            z += number(0, 5000);
            below = above;
        }
        for (auto s = lens.rbegin(); s != lens.rend(); ++s)
            turned.push_back({-s->z_mm, -s->curvature_per_mm, 0, {}, 1, s->index_above, s->index_below});
        const Cardinal a = cardinal_points(lens), b = cardinal_points(turned);
        RC_PRE(std::abs(a.focal_length_mm) < 1e6);
        // rounding of a handful of steps, grown by how weak the lens is
        const double bound = 1e-12 * a.focal_length_mm * a.focal_length_mm + 1e-9;
        RC_ASSERT(std::abs(a.focal_length_mm - b.focal_length_mm) < bound);
        RC_ASSERT(std::abs(a.front_principal_mm + b.rear_principal_mm) < bound);
        RC_ASSERT(std::abs(a.rear_principal_mm + b.front_principal_mm) < bound);
    }));
}

}  // namespace
}  // namespace lfdsim
