#include "analysis/uniformity/efficiency.h"

#include "analysis/core/eye_rays.h"
#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "geometry/resolve.h"
#include "optics/camera.h"
#include "optics/layers.h"

#include <array>
#include <cmath>
#include <vector>

namespace lfdsim {
namespace {

constexpr int budget_rays_a_part = 1 << 12;

/// The basic radiance found by one part's rays, summed.
struct Found {
    double reaches = 0, leaves = 0, leaves_in_fov = 0;
};

/// Returns the ratio of a line's flux to the radiance that it shows: for ideal lenses (cos below/cos above)^4, with the angles to
/// the lens's axis. Real lenses conserve radiance and etendue, and so a bundle's flux. The ideal lens conserves a bundle's extent
/// in slopes, which is that in directions over cos^4.
double flux_per_radiance(const Sight& sight) {
    const double squared = sight.cosines * sight.cosines;
    return squared * squared;
}

/// Indices of the medium into which the panel emits, and of the one just below the lenses' lowest point.
struct Media {
    double at_panel, at_lens;
};
Media media_of(const Geometry& g) {
    const std::vector<PlacedLayer>& layers = g.layers;
    const double glass = g.glued ? g.surfaces.front().index_above : 1;
    if (layers.empty()) return {glass, glass};
    return {layers.front().index, g.glued ? layers.back().index : 1};
}

/// Returns the basic radiance, relative to the panel's along its normal, of the light that arrives at a position at the lenses'
/// lowest point from the direction opposite to the unit vector `to`, in the medium there.
double coming_up(const Display& d, const Geometry& g, const optics::TracedDisplay<double>& scene, const Vec3d& at,
                 const Vec3d& to) {
    optics::Vec3<double> down{to[0], to[1], to[2]};
    double weight = 1;
    bool alive = true;
    const auto end = optics::down_to_panel<double>(scene, {at[0], at[1], g.base_z_mm}, g.glued, down, weight, alive);
    if (!alive || 2 * std::abs(end.x) > g.panel_width_mm || 2 * std::abs(end.y) > g.panel_height_mm) return 0;
    return weight * std::pow(-down.z, d.panel.emission_exponent);
}

}  // namespace

std::array<LightBudget, independent_sets> light_budgets(const Display& display, const Geometry& geometry, Parts& parts) {
    Display bare = display;
    bare.diffuser.reset();
    Geometry bare_geometry = geometry;
    bare_geometry.diffuser_z_mm.reset();
    const EyeRays lenses(bare, bare_geometry);
    const auto scene = make_traced_display<double>(bare, bare_geometry);
    const Media media = media_of(geometry);
    const double width = geometry.array_width_mm, height = geometry.array_height_mm;
    // Caps rise above their rims: light that leaves them obliquely at the border crosses the vertex plane beside the array. In
    // black surrounds, where no other light does, it is counted within a margin.
    const bool black = display.array.surround == Surround::opaque;
    const double margin = black ? 8 * (geometry.vertex_plane_mm - geometry.base_z_mm) : 0;
    const double m = display.panel.emission_exponent,
                 fov_slope[] = {geometry.lattice.pitch[0] / (2 * geometry.gap_mm),
                                is_strips(display.array) ? infinity : lens_pitch_mm(geometry, 1) / (2 * geometry.gap_mm)};
    const double c = geometry.lattice.cos_turn, s = geometry.lattice.sin_turn;
    const int rays = budget_rays_a_part * lenses.more_for({0, 0, geometry.vertex_plane_mm + 1e6});
    std::array<Found, light_budget_parts> sums{};
    parts.run(light_budget_parts, [&](int part) {
        Found& sum = sums[std::size_t(part)];
        for (const Choice& choice : even_choices(rays, set_number(display.render.seed, part))) {
            // The directions are cosine-weighted: uniform over the disk below the hemisphere.
            Vec3d to;
            optics::disk(choice[2], choice[3], to[0], to[1]);
            to[2] = -std::sqrt(std::max(1 - to[0] * to[0] - to[1] * to[1], 0.));
            if (!(to[2] < -1e-9)) continue;
            const Vec3d inside = lenses.point(0.5 * width * choice[0], 0.5 * height * choice[1]);
            sum.reaches += media.at_lens * media.at_lens * coming_up(display, geometry, scene, inside, to);
            const Vec3d at = lenses.point((0.5 * width + margin) * choice[0], (0.5 * height + margin) * choice[1]);
            // Light that leaves the lenses there
            const Sight sight = lenses.look_along(at, to, 0, 0);
            const double light = sight.light * flux_per_radiance(sight);
            sum.leaves += light;
            const double along = c * to[0] + s * to[1], across = c * to[1] - s * to[0];
            if (std::abs(along) <= -to[2] * fov_slope[0] && std::abs(across) <= -to[2] * fov_slope[1]) sum.leaves_in_fov += light;
        }
    });
    // Each set has 1/independent_sets of the parts: a mean over its rays, times pi and the area.
    const double flux = pi * independent_sets / (double(rays) * light_budget_parts), per_ray = flux * width * height,
                 per_wide_ray = flux * (width + 2 * margin) * (height + 2 * margin);
    std::array<LightBudget, independent_sets> budgets{};
    for (LightBudget& b : budgets)
        b.emitted = media.at_panel * media.at_panel * geometry.panel_width_mm * geometry.panel_height_mm * 2 * pi / (m + 2);
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
