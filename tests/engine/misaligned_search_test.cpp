#include "engine/scene/traced_display.h"
#include "geometry/geometry.h"
#include "optics/misaligned.h"
#include "pictures.h"

#include <gtest/gtest.h>
#include <random>

namespace lfdsim {
namespace {

using optics::Cell;

/// Errors as large as any that keep lenses near their places.
Errors large(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    Errors e;
    e.decenter_sd_mm = 0.1 * share(random);
    e.height_sd_mm = 0.3 * share(random);
    e.tilt_sd_deg = share(random) < 0.5 ? 0 : 2 * share(random);
    e.curvature_sd = share(random) < 0.5 ? 0 : 0.05 * share(random);
    e.bow_mm = 3 * (share(random) - 0.5);
    e.pitch_ppm = 5000 * (share(random) - 0.5);
    e.seed = std::int64_t(random());
    return e;
}

/// Rays from above the lenses, of all slopes up to 8: how many of them first enter another lens than the first of all lenses does.
int wrong_of(const Display& d, int rays, std::mt19937& random, int& entering) {
    const Geometry g = resolve(d);
    const StoredDisplay<double> scene = make_traced_display<double>(d, g);
    const auto& lattice = scene.lattice;
    const optics::Extent<double> extent{0, lattice.count[0] - 1, 0, lattice.count[1] - 1};
    const double width = lattice.count[0] * lattice.pitch[0], height = lattice.count[1] * lattice.pitch[1];
    std::uniform_real_distribution<double> share(-0.6, 0.6), slope(-8, 8);
    int wrong = 0;
    for (int k = 0; k < rays; ++k) {
        const double mx = slope(random), my = slope(random), per = 1 / std::sqrt(1 + mx * mx + my * my);
        const optics::Ray<double> ray{
            {width * (0.5 + share(random)), height * (0.5 + share(random)), scene.misaligned.search_top + 1},
            {mx * per, my * per, -per}};
        const auto found = optics::enter_misaligned<optics::Facts{}>(scene, extent, ray, true);
        double first = 1e30;
        for (double j = 0; j < lattice.count[1]; ++j)
            for (double i = 0; i < lattice.count[0]; ++i) {
                const auto met = optics::meet_misaligned<optics::Facts{}>(scene, extent, ray, 1 / ray.to.z, Cell<double>{i, j});
                if (met.enters) first = std::min(first, met.path_length);
            }
        entering += first < 1e30;
        wrong += found.enters ? found.path_length != first : first < 1e30;
    }
    return wrong;
}

// No lens is missed, however it stands: the first of those near a ray is the first of all.
TEST(PlacedSearch, FindsTheFirstOfAllLenses) {
    std::mt19937 random(11);
    int wrong = 0, entering = 0, displays = 0;
    for (const LatticeKind lattice :
         {LatticeKind::square, LatticeKind::rectangle, LatticeKind::hexagon, LatticeKind::brick, LatticeKind::strips})
        for (const bool fills : {false, true})
            for (const int kind : {0, 1, 2, 3})  // ideal lenses, caps, hollow lenses, aspheres
                for (int repeat = 0; repeat < 3; ++repeat) {
                    Display d = in_lattice(kind == 1 ? example() : ideal_example(), lattice);
                    if (kind == 2) d.lens = {SurfaceLens{{{0.02, 0, {}, 3.1, 1.5, 1.5}, {0.08, 0, {}, 3.1}}}, {}};
                    if (kind == 3) d.lens = {SurfaceLens{{{0, 0, {}, 3.1, 1.5, 1.5}, {-0.2, -0.5, {1e-4}, 3.1}}}, {}};
                    if (kind == 1) d.lens.as<PlanoConvex>() = {3.3, {}, 0.5, 1.5, Facing::viewer};
                    if (!fills) {
                        d.array.aperture = Aperture::circle;
                        if (kind == 0) d.lens.as<IdealLens>().aperture_radius_mm = 1.4;
                        if (kind == 1) d.lens.as<PlanoConvex>().aperture_radius_mm = 1.4;
                        if (kind > 1)
                            for (Surface& s : d.lens.as<SurfaceLens>().surfaces) s.semi_aperture_mm = 1.4;
                    }
                    if (lattice != LatticeKind::strips) d.array.count = {6, 5};
                    d.errors = large(random);
                    if (!validate(d).empty()) continue;
                    ++displays;
                    wrong += wrong_of(d, 2000, random, entering);
                }
    EXPECT_GT(displays, 90);
    EXPECT_GT(entering, displays * 600);
    EXPECT_EQ(wrong, 0) << "of " << entering << " rays that enter lenses of " << displays << " displays";
}

}  // namespace
}  // namespace lfdsim
