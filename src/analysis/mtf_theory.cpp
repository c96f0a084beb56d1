#include "analysis/mtf_theory.h"

#include "analysis/slanted_edge.h"
#include "analysis/slope_spread.h"
#include "model/numbers.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

const double fwhm_per_sigma = 2 * std::sqrt(2 * std::log(2.));

double disk(double x) { return x == 0 ? 1 : 2 * std::cyl_bessel_j(1, pi * x) / (pi * x); }

}  // namespace

double pixel_image_mm(const Display& d, const Geometry& g, double z_mm) {
    return d.panel.pixel_pitch_mm * std::abs(z_mm - g.rear_principal_mm) / g.gap_mm;
}

double lens_limit_per_mm(const Subject& s, const Bars& plane, double angle_deg) {
    return s.theory(plane.upright ? 0 : 1).lens_sampling_limit_per_mm /
           scale_to_bars(s.geometry(), plane, {angle_deg, s.viewing_distance_mm()});
}

bool at_the_lenses(const Display& d, const Geometry& g, double z_mm) {
    return pixel_image_mm(d, g, z_mm) < 1e-6 * d.array.pitch_mm.least();
}

Blur blur(const Display& d, const Geometry& g, const Theory& t, double z_mm, double angle_deg) {
    const double defocus = std::abs(1 - (z_mm - g.rear_principal_mm) / t.central_depth_mm);
    Blur b{pixel_image_mm(d, g, z_mm),
           {g.clear_aperture_mm[0] * defocus, g.clear_aperture_mm[1] * defocus},
           d.array.aperture == Aperture::circle || d.lens.stop_radius_mm,
           d.array.turn_deg() * degree,
           {0, 0},
           false};
    if (!d.diffuser) return b;
    const double away = std::abs(z_mm - *g.diffuser_z_mm), angle = angle_deg * degree;
    const auto half = [&](std::size_t axis) { return 0.5 * d.diffuser->angle_deg[axis] * degree; };
    // The turn about x comes last: it adds the same upward slope at every angle of view. Past the horizontal nothing is seen:
    // an angle near it serves as well.
    const auto slope = [](double a) { return std::tan(std::clamp(a, -1.5, 1.5)); };
    b.diffuser_mm = {away * (slope(angle + half(0)) - slope(angle - half(0))), away * 2 * slope(half(1))};
    b.gaussian = d.diffuser->profile == Profile::gaussian;
    return b;
}

double light_astray(const Subject& s, double angle_deg, double distance_mm) {
    const double eye = distance_mm * std::cos(angle_deg * degree) - s.geometry().rear_principal_mm;
    const auto half = [&](int axis) { return 0.5 * s.theory(axis).elemental_pitch_mm / s.geometry().gap_mm; };
    if (!(eye > 0)) return 1;
    return 1 - SlopeSpread(s, eye, 0).within(distance_mm * std::sin(angle_deg * degree), -half(0), half(0)) *
                   SlopeSpread(s, eye, 1).within(0, -half(1), half(1));
}

double Blur::mtf(double f, bool horizontal) const {
    // Of a turned array the axis near this direction counts with its cosine, the other with its sine.
    const std::size_t near = horizontal ? 0 : 1;
    const double c = std::cos(array_rad), s = std::sin(array_rad), w = f * diffuser_mm[horizontal ? 0 : 1];
    const double sigma = pi / fwhm_per_sigma;
    const double spot = round ? disk(f * spot_mm[0]) : sinc(f * spot_mm[near] * c) * sinc(f * spot_mm[1 - near] * s);
    return std::abs(sinc(f * pixel_mm) * spot * (gaussian ? std::exp(-2 * sigma * sigma * w * w) : sinc(w)));
}

double Blur::width_mm(bool horizontal) const {
    // A gaussian's tails reach two half widths farther.
    return pixel_mm + spot_mm[horizontal ? 0 : 1] + (gaussian ? 2 : 1) * diffuser_mm[horizontal ? 0 : 1];
}

}  // namespace lfdsim
