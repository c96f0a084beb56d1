// Pupils of lenses with stops before, inside and behind them: against matrices of paraxial optics, and by hand.
#include "geometry/pupil.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "example.h"
#include "geometry/dark_bands.h"
#include "geometry/geometry.h"
#include "geometry/prescription.h"

namespace lfdsim {
namespace {

/// A stop as a surface inside a biconvex lens that fills its cell.
Display with_inner_stop(double stop) {
    Display d = example();
    d.panel.pixels = {240, 135};
    d.panel.pixel_pitch_mm = 0.2;
    d.lens = {SurfaceLens{{{0.036, 0, {}, 5.6, 2.8, 1.53}, {0, 0, {}, stop, 2.8, 1.53}, {-0.055, 0, {}, 5.6, 0, 1}}}, {}};
    d.array.count.reset();
    d.array.pitch_mm = 8;
    d.array.gap_mm = 22.7;
    d.array.aperture = Aperture::cell;
    return d;
}

TEST(Pupil, OfAStopInsideTheLensIsItsImage) {
    const double power = 0.53 * 0.055, depth = 2.8 / 1.53;  // of the viewer's surface, and reduced, of the stop below it
    const Geometry g = resolve(with_inner_stop(2.9));
    EXPECT_NEAR(g.clear_aperture_mm[0], 2 * 2.9 / (1 - power * depth), 1e-9);
    EXPECT_NEAR(g.clear_aperture_mm[0], 6.127, 1e-3);
    EXPECT_EQ(g.clear_aperture_mm[0], g.clear_aperture_mm[1]);
    EXPECT_NEAR(*g.pupil.inner_z, g.vertex_plane_mm - depth / (1 - power * depth), 1e-9);  // 1/b' = 1/b - power
    EXPECT_NEAR(aperture_plane_mm(with_inner_stop(2.9), g, 0), *g.pupil.inner_z, 1e-12);
    const Theory t = theory(with_inner_stop(2.9), g);
    EXPECT_NEAR(t.depth_near_per_mm - t.depth_far_per_mm, 2 * 0.2 / (22.7 * g.clear_aperture_mm[0]), 1e-12);
    // A wide one limits nothing.
    EXPECT_EQ(resolve(with_inner_stop(5.5)).clear_aperture_mm[0], 8);
    // Round lenses: the pupil, not the narrowest rim.
    Display round = with_inner_stop(2.9);
    round.array.aperture = Aperture::circle;
    round.lens.as<SurfaceLens>().surfaces[0].semi_aperture_mm = round.lens.as<SurfaceLens>().surfaces[2].semi_aperture_mm = 3.9;
    EXPECT_NEAR(resolve(round).clear_aperture_mm[0], 6.127, 1e-3);
    // A hole before the lens is narrower than the stop inside.
    round.lens.stop_radius_mm = 2.5;
    EXPECT_EQ(resolve(round).clear_aperture_mm[0], 5);
    EXPECT_FALSE(resolve(round).pupil.inner_z);
    round.lens.stop_radius_mm = 3.1;
    EXPECT_NEAR(resolve(round).clear_aperture_mm[0], 6.127, 1e-3);
}

// From an aperture to the viewer's side the matrix of (height, index times slope) is (A, B; C, D): the image is 1/D as large.
TEST(Pupil, AgreesWithMatricesOfRandomLenses) {
    std::mt19937 random(7);
    const auto even = [&](double low, double high) { return low + (high - low) * double(random()) / double(std::mt19937::max()); };
    for (int n = 0; n < 200; ++n) {
        const int count = 2 + int(random() % 5);
        std::vector<PlacedSurface> all;
        double z = 3, below = 1;
        for (int k = 0; k < count; ++k) {
            const double above = k + 1 == count ? 1 : even(1.3, 1.9);
            all.push_back({z, even(-0.1, 0.1), 0, {}, even(1, 3), below, above});
            z += even(0.5, 3);
            below = above;
        }
        const double stop = even(0.8, 3);
        const bool stopped = n % 2 == 0;
        double radius = INFINITY, cells = 1, A = 1, B = 0, C = 0, D = 1;  // from surface k upwards
        for (std::size_t k = all.size(); k-- > 0;) {
            if (k + 1 < all.size()) {  // the surface above comes after the way up to it
                const PlacedSurface& above = all[k + 1];
                const double power = above.curvature_per_mm * (above.index_above - above.index_below),
                             way = (above.z_mm - all[k].z_mm) / all[k].index_above;
                A -= B * power, C -= D * power;
                B += A * way, D += C * way;
            }
            radius = std::min(radius, all[k].semi_aperture_mm / std::abs(D));
            if (stopped && k + 1 == all.size()) radius = std::min(radius, stop);
            cells = std::min(cells, 1 / std::abs(D));
        }
        const Pupil found = pupil(all, stopped ? std::optional(stop) : std::nullopt, all.back().z_mm);
        EXPECT_NEAR(found.radius_mm, radius, 1e-12 * radius) << n;
        EXPECT_NEAR(found.cells, std::min(cells, 1.), 1e-12) << n;
    }
}

}  // namespace
}  // namespace lfdsim
