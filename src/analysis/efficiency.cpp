#include "analysis/efficiency.h"

#include "analysis/eye_rays.h"
#include "model/numbers.h"
#include "optics/camera.h"

#include <array>
#include <cmath>
#include <vector>

namespace lfdsim {
namespace {

constexpr int budget_rays_a_part = 1 << 12;

/// The light that one part's rays find.
struct Found {
    double reaches = 0, leaves = 0, leaves_in_fov = 0;
};

/// Real lenses conserve radiance and etendue, and so a bundle's flux. The ideal lens conserves a bundle's extent in slopes, which
/// is that in directions over the cosine's fourth power: this is the ratio of its flux to the radiance that it shows.
double flux_per_radiance(const Vec3d& at, const Vec3d& to, const Sight& sight) {
    const double x = (sight.x - at[0]) / at[2], y = (sight.y - at[1]) / at[2];
    const double ratio = 1 / ((1 + x * x + y * y) * to[2] * to[2]);  // of the squared cosines, before the lens over after it
    return ratio * ratio;
}

}  // namespace

std::array<LightBudget, independent_sets> light_budgets(const Display& display, const Geometry& geometry, Parts& parts) {
    Display bare = display;
    bare.diffuser.reset();
    const EyeRays lenses(bare, resolve(bare));
    const double width = geometry.array_width_mm, height = geometry.array_height_mm;
    // Caps rise above their rims: light that leaves them obliquely at the border crosses the vertex plane beside the array. Where
    // no other light does, in black surrounds, it is counted.
    const bool black = display.array.surround == Surround::opaque;
    const double margin = black ? 8 * (geometry.vertex_plane_mm - geometry.base_z_mm) : 0;
    const double m = display.panel.emission_exponent,
                 fov_slope[] = {display.array.pitch_mm[0] / (2 * geometry.gap_mm),
                                is_strips(display.array) ? infinity : display.array.pitch_mm[1] / (2 * geometry.gap_mm)};
    const double c = geometry.lattice.cos_turn, s = geometry.lattice.sin_turn;
    const bool ideal = display.lens.is_thin();
    const int rays = budget_rays_a_part * lenses.more_for({0, 0, geometry.vertex_plane_mm + 1e6});
    std::array<Found, light_budget_parts> sums{};
    parts.run(light_budget_parts, [&](int part) {
        Found& sum = sums[std::size_t(part)];
        for (const Choice& choice : even_choices(rays, set_number(display.render.seed, part))) {
            Vec3d to;  // as dense as its cosine: uniform over the disk below the hemisphere
            optics::disk(choice[2], choice[3], to[0], to[1]);
            to[2] = -std::sqrt(std::max(1 - to[0] * to[0] - to[1] * to[1], 0.));
            if (!(to[2] < -1e-9)) continue;
            const Vec3d inside = lenses.point(0.5 * width * choice[0], 0.5 * height * choice[1]);
            const double down = geometry.base_z_mm / -to[2];
            if (2 * std::abs(inside[0] + down * to[0]) <= geometry.panel_width_mm &&
                2 * std::abs(inside[1] + down * to[1]) <= geometry.panel_height_mm)
                sum.reaches += std::pow(-to[2], m);
            const Vec3d at = lenses.point((0.5 * width + margin) * choice[0], (0.5 * height + margin) * choice[1]);
            const Sight sight = lenses.look_along(at, to, 0, 0);
            const double light = sight.light * (ideal ? flux_per_radiance(at, to, sight) : 1);
            sum.leaves += light;
            const double along = c * to[0] + s * to[1], across = c * to[1] - s * to[0];
            if (std::abs(along) <= -to[2] * fov_slope[0] && std::abs(across) <= -to[2] * fov_slope[1]) sum.leaves_in_fov += light;
        }
    });
    const double flux = pi * independent_sets / (double(rays) * light_budget_parts), per_ray = flux * width * height,
                 per_wide_ray = flux * (width + 2 * margin) * (height + 2 * margin);
    std::array<LightBudget, independent_sets> budgets{};
    for (LightBudget& b : budgets) b.emitted = geometry.panel_width_mm * geometry.panel_height_mm * 2 * pi / (m + 2);
    for (std::size_t part = 0; part < sums.size(); ++part) {
        LightBudget& b = budgets[part % independent_sets];
        b.reaches_array += sums[part].reaches * per_ray;
        b.leaves += sums[part].leaves * per_wide_ray;
        b.leaves_in_fov += sums[part].leaves_in_fov * per_wide_ray;
    }
    return budgets;
}

LightBudget mean_budget(const std::array<LightBudget, independent_sets>& sets, int without) {
    LightBudget mean{};
    for (int k = 0; k < independent_sets; ++k) {
        if (k == without) continue;
        const LightBudget& b = sets[std::size_t(k)];
        const double share = 1. / (independent_sets - (without >= 0));
        mean.emitted += share * b.emitted;
        mean.reaches_array += share * b.reaches_array;
        mean.leaves += share * b.leaves;
        mean.leaves_in_fov += share * b.leaves_in_fov;
    }
    return mean;
}

}  // namespace lfdsim
