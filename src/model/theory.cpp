#include <algorithm>
#include <cmath>
#include <limits>

#include "model/geometry.h"

namespace lfdsim {

// First-order formulas of integral imaging; docs/model.md, "Theory". Symbols as there.
Theory theory(const Display& d, const Geometry& g) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double degree = std::acos(-1.0) / 180;
    const double a = d.panel.pixel_pitch_mm, p = d.array.pitch_mm, D = g.clear_aperture_mm, gap = g.gap_mm, f = g.focal_length_mm;
    const double L = gap == f ? infinity : 1 / (1 / f - 1 / gap);

    Theory t{};
    t.fov_deg = 2 * std::atan(p / (2 * gap)) / degree;
    t.focal_length_mm = f;
    t.gap_mm = gap;
    t.central_depth_mm = L;
    t.pixel_image_mm = a * std::abs(L) / gap;
    // A lens's spot at depth z is D |z - L|/|L| wide; the marginal planes are where it is as wide as a pixel's image.
    const double half_depth = std::abs(L) * t.pixel_image_mm / D;
    t.depth_of_field_mm = 2 * half_depth;
    t.depth_range_mm = {L - half_depth, L + half_depth};
    // Collimated, the spot is D wide at all depths and a pixel's image a z/g: from where they are equal on, the picture is sharp.
    if (std::isinf(L)) t.depth_range_mm = {D * gap / a, infinity};
    t.views = p / a;
    t.view_step_deg = t.fov_deg / t.views;

    // Seen from X = D' tan(theta), the lens at x shows the panel at g (x - X)/D' from its axis; its elemental image is centred at
    // e x, with e = g/D' for the distance it was made for. All of m lenses show their own image while |X/D'| stays below
    // p/2g - (m - 1) p/2 |1/D' - e/g|.
    const double made_for = d.content.viewing_distance_mm - g.rear_principal_mm;
    const double eye = (std::isinf(made_for) ? d.camera.position_mm[2] : d.content.viewing_distance_mm) - g.rear_principal_mm;
    const auto zone_deg = [&](double e) {
        const double m = double(d.array.count[0]), slope = p / (2 * gap) - (m - 1) * p / 2 * std::abs(1 / eye - e / gap);
        return 2 * std::atan(std::max(slope, 0.0)) / degree;
    };
    t.viewing_zone_parallel_deg = zone_deg(0);
    t.viewing_zone_deg = zone_deg(gap / made_for);
    t.elemental_pitch_mm = p * (1 + gap / made_for);
    t.lens_sampling_limit_per_mm = 1 / (2 * p);
    t.pixel_image_limit_per_mm = 1 / (2 * t.pixel_image_mm);
    t.gap_closing_diffuser_deg = 2 * std::atan(p / (2 * std::abs(L))) / degree;
    return t;
}

}  // namespace lfdsim
