#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bisection.h"
#include "base/constants.h"
#include "geometry/dark_bands.h"
#include "geometry/geometry.h"
#include "geometry/layers.h"
#include "geometry/resolve.h"
#include "geometry/screen.h"
#include "geometry/seen_width.h"
#include "geometry/vec.h"

namespace lfdsim {

namespace {

/// Returns the angle between the two lines to the axis at the principal point from the ends of a width on the panel, by Snell's law
/// through layers and air. The sine in air is found by bisection, to the last bit, as the place on the panel grows with it.
double exact_angle_deg(const Geometry& g, double width_mm) {
    const auto half_width = [&](double sine) {
        const double slope = sine / std::sqrt(1 - sine * sine);
        return slope * reach_below_thin_lens_mm(g, slope * slope);
    };
    const auto within = [&](double sine) { return half_width(sine) < width_mm / 2; };
    // 180 if even the steepest rays do not reach the ends
    return 2 * std::asin(bisected(0, 1, to_last_bit, within).out) / degree;
}

/// Returns the figures along an axis of the array; L is the central depth, mm.
AxisTheory theory_along(const Display& d, const Geometry& g, double L, std::size_t axis) {
    if (is_strips(d.array) && axis == 1) return {nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan};
    const double a = d.panel.pixel_pitch_mm, p = lens_pitch_mm(g, axis), gap = g.gap_mm;
    AxisTheory t{};
    t.fov_deg = 2 * std::atan(p / (2 * gap)) / degree;
    // Views of strips lie side by side along the line of eyes, which crosses a strip over p / c.
    const double c = across_share(g.lattice);
    t.views = p / (a * c);
    t.view_step_deg = 2 * std::atan(p / c / (2 * gap)) / degree / t.views;

    // To an eye at X = E tan(theta) the lens at x shows the panel at g (x - X)/E from its axis. The centre of its elemental image
    // is x g/M from the axis, with M the distance from H' that the images are made for, and the image is p' = p (1 + g/M) wide. So
    // each of m lenses shows the image that belongs to it while |X/E| is below p'/2g - (m - 1)(p/2) |1/E - 1/M|. Below, e = g/M; 0
    // for parallel images.
    const double made_for = d.content.viewing_distance_mm - g.rear_principal_mm, eye = camera_distance_mm(d) - g.rear_principal_mm;
    t.elemental_pitch_mm = p * (1 + gap / made_for);
    t.fov_elemental_deg = 2 * std::atan(t.elemental_pitch_mm / (2 * gap)) / degree;
    t.fov_exact_deg = d.lens.is_thin() ? exact_angle_deg(g, t.elemental_pitch_mm) : nan;
    const bool before = eye > 0;  // else the camera is inside the display or behind it
    t.eyebox_mm = before ? eye * t.elemental_pitch_mm / gap : std::nan("");
    const auto zone_deg = [&](double e) {
        if (!before) return std::nan("");
        const double m = lenses_across(g, axis), slope = p * (1 + e) / (2 * gap) - (m - 1) * p / 2 * std::abs(1 / eye - e / gap);
        return 2 * std::atan(std::max(slope, 0.0)) / degree;
    };
    t.viewing_zone_parallel_deg = zone_deg(0);
    t.viewing_zone_deg = zone_deg(gap / made_for);
    t.lens_sampling_limit_per_mm = 1 / (2 * p);
    const std::array<double, 2> spread = joining_spread_mm(g);  // along the display's axes
    const double joining = is_strips(d.array) ? std::max(spread[0], spread[1]) : spread[array_axis(g, axis)];
    t.gap_closing_diffuser_deg = gap_closing_angle_deg(joining, std::abs(L));
    t.gap_closing_here_deg =
        g.diffuser_z_mm ? gap_closing_angle_deg(joining, *g.diffuser_z_mm - aperture_plane_mm(d, g, axis)) : std::nan("");
    return t;
}

}  // namespace

// The formulas of first order of integral imaging, with the symbols of docs/model.md, "Theory": 1/L = 1/f - 1/g, P_I = a |L|/g, and
// the ends of the depth of field, 1/z = 1/L +- a/(g D).
Theory theory(const Display& d, const Geometry& g) {
    const double a = d.panel.pixel_pitch_mm, D = widest_aperture_mm(g), gap = g.gap_mm, f = g.focal_length_mm;
    const bool pinhole = d.lens.type() == LensType::pinhole;
    // Lenses that focus on the panel are written to a picometre (docs/model.md, "First designs").
    constexpr double rounded_mm = 2e-9;
    const double inverse_L = pinhole                          ? nan
                             : std::abs(gap - f) < rounded_mm ? 0
                                                              : 1 / f - 1 / gap,
                 L = inverse_L == 0 ? infinity : 1 / inverse_L;

    Theory t{};
    t.fov_of_eyes_deg = is_strips(d.array) ? 2 * std::atan(g.lattice.pitch[0] / (2 * gap * across_share(g.lattice))) / degree : nan;
    t.focal_length_mm = pinhole ? nan : f;
    t.gap_mm = gap;
    t.central_depth_mm = L;
    t.pixel_image_mm = a * std::abs(L) / gap;
    t.pixel_image_limit_per_mm = 1 / (2 * t.pixel_image_mm);
    t.depth_of_field_mm = 2 * std::abs(L) * t.pixel_image_mm / D;
    const double half_depth_per_mm = a / (gap * D);
    t.depth_near_per_mm = inverse_L + half_depth_per_mm;
    t.depth_far_per_mm = inverse_L - half_depth_per_mm;
    for (const std::size_t axis : {0u, 1u}) t.along[axis] = theory_along(d, g, L, axis);
    return t;
}

double reach_below_thin_lens_mm(const Geometry& g, double slope_squared) {
    double reach = g.front_principal_mm - g.layers_top_mm;
    for (const auto& [thickness, n] : g.layers) reach += thickness / std::sqrt(n * n + (n * n - 1) * slope_squared);
    return reach;
}

double camera_distance_mm(const Display& d) { return std::sqrt(dot(d.camera.position_mm, d.camera.position_mm)); }

double depth_mm(double per_mm) { return per_mm == 0 ? std::numeric_limits<double>::infinity() : 1 / per_mm; }

bool is_sharp(const Theory& t, double z_mm) { return t.depth_far_per_mm <= 1 / z_mm && 1 / z_mm <= t.depth_near_per_mm; }

}  // namespace lfdsim
