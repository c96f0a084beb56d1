#include "analysis/mtf_theory.h"

#include "analysis/edge_view.h"
#include "analysis/eye_rays.h"
#include "analysis/slope_spread.h"
#include "content/pickup.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace lfdsim {
namespace {

constexpr double pi = std::numbers::pi, radian = pi / 180;
const double fwhm_per_sigma = 2 * std::sqrt(2 * std::log(2.));

double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }
double disk(double x) { return x == 0 ? 1 : 2 * std::cyl_bessel_j(1, pi * x) / (pi * x); }

/// The angle that a number in [-1, 1] chooses.
double diffuser_rad(const Diffuser& d, std::size_t axis, double number) {
    const double half = 0.5 * d.angle_deg[axis] * radian;
    if (d.profile == Profile::box) return half * number;
    // The normal distribution's quantile by Newton's steps from its middle, within 4 standard deviations
    const double share = std::clamp(number, -0.99994, 0.99994);
    double t = 0;
    for (int k = 0; k < 40; ++k) {
        const double step = (std::erf(t) - share) * 0.5 * std::sqrt(pi) * std::exp(t * t);
        t -= std::clamp(step, -0.5, 0.5);
    }
    return t * half / std::sqrt(std::numbers::ln2);
}

/// The unit vector across the edges.
std::array<double, 2> normal(bool horizontal) {
    const Bars unit{horizontal, 0, 1, 1, 0};
    return {across_mm(unit, 1, 0), across_mm(unit, 0, 1)};
}

}  // namespace

double pixel_image_mm(const Display& d, const Geometry& g, double z_mm) {
    return d.panel.pixel_pitch_mm * std::abs(z_mm - g.rear_principal_mm) / g.gap_mm;
}

bool at_the_lenses(const Display& d, const Geometry& g, double z_mm) {
    return pixel_image_mm(d, g, z_mm) < 1e-6 * d.array.pitch_mm;
}

Blur blur(const Display& d, const Geometry& g, const Theory& t, double z_mm, double angle_deg) {
    Blur b{pixel_image_mm(d, g, z_mm),
           g.clear_aperture_mm * std::abs(1 - (z_mm - g.rear_principal_mm) / t.central_depth_mm),
           d.array.aperture == Aperture::circle || d.lens.stop_radius_mm,
           d.array.rotation_deg * radian,
           {0, 0},
           false};
    if (!d.diffuser) return b;
    const double away = std::abs(z_mm - *g.diffuser_z_mm), angle = angle_deg * radian;
    const auto half = [&](std::size_t axis) { return 0.5 * d.diffuser->angle_deg[axis] * radian; };
    // The turn about x comes last and sees the ray from the side: its slope upwards grows by it whatever the angle of view.
    // Past the horizontal nothing is seen: an angle near it is as good.
    const auto slope = [](double a) { return std::tan(std::clamp(a, -1.5, 1.5)); };
    b.diffuser_mm = {away * (slope(angle + half(0)) - slope(angle - half(0))), away * 2 * slope(half(1))};
    b.gaussian = d.diffuser->profile == Profile::gaussian;
    return b;
}

double light_astray(const Subject& s, double angle_deg, double distance_mm) {
    const double eye = distance_mm * std::cos(angle_deg * radian) - s.geometry().rear_principal_mm;
    const double half = 0.5 * s.theory().elemental_pitch_mm / s.geometry().gap_mm;
    if (!(eye > 0)) return 1;
    return 1 - SlopeSpread(s, eye, 0).within(distance_mm * std::sin(angle_deg * radian), -half, half) *
                   SlopeSpread(s, eye, 1).within(0, -half, half);
}

double mtf_of_lines(const Subject& s, const Bars& bars, const Eye& eye, double per_mm) {
    constexpr int count = 1 << 16;
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const Pickup pickup(d, g);
    const double turn = d.array.rotation_deg * radian, c = std::cos(turn), sine = std::sin(turn), pitch = d.array.pitch_mm;
    const double e[2] = {eye.x_mm(), 0}, height = eye.z_mm() - g.rear_principal_mm, up = bars.z_mm - g.rear_principal_mm;
    const double above = g.diffuser_z_mm.value_or(0) - g.rear_principal_mm, pixel = d.panel.pixel_pitch_mm;
    const bool round = d.array.aperture == Aperture::circle || d.lens.stop_radius_mm;
    std::complex<double> sum = 0;
    int seen = 0;
    for (const Choice& choice : even_choices(count)) {
        double at[2], slope[2], place[2];
        for (std::size_t k = 0; k < 2; ++k) {
            const double aimed = 0.5 * (k == 0 ? g.array_width_mm : g.array_height_mm) * choice[k] + d.array.offset_mm[k],
                         straight = (aimed - e[k]) / height;
            slope[k] = straight;
            if (d.diffuser) slope[k] = std::tan(std::atan(straight) + diffuser_rad(*d.diffuser, k, choice[2 + k]));
            at[k] = aimed + above * (slope[k] - straight);
            place[k] = aimed - up * straight;
        }
        const double x = at[0] - d.array.offset_mm[0], y = at[1] - d.array.offset_mm[1];
        const auto cell = [&](double along, std::size_t k) {
            const double half = 0.5 * double(d.array.count[k]);
            return (std::floor(along / pitch + half) + 0.5 - half) * pitch;
        };
        const double u = cell(c * x + sine * y, 0), v = cell(c * y - sine * x, 1);
        const double q[2] = {x - (c * u - sine * v), y - (sine * u + c * v)};
        if (round && std::hypot(q[0], q[1]) > 0.5 * g.clear_aperture_mm) continue;
        const auto panel = [&](std::size_t k) {
            const double half = 0.5 * double(d.panel.pixels[k]), p = at[k] + g.gap_mm * (slope[k] - q[k] / g.focal_length_mm);
            return (std::floor(p / pixel + half) + 0.5 - half) * pixel;
        };
        const NodalLine line = pickup.line(panel(0), panel(1));
        if (!line.owned) continue;
        const double off = across_mm(bars, line.x + up * line.mx - place[0], line.y + up * line.my - place[1]);
        sum += std::polar(1., 2 * pi * per_mm * off);
        ++seen;
    }
    return seen > 0 ? std::abs(sum) / seen : 0;
}

double Blur::mtf(double f, bool horizontal) const {
    const auto [x, y] = normal(horizontal);
    const double c = std::cos(array_rad), s = std::sin(array_rad);
    double m = sinc(f * pixel_mm * x) * sinc(f * pixel_mm * y);
    m *= round ? disk(f * spot_mm) : sinc(f * spot_mm * (c * x + s * y)) * sinc(f * spot_mm * (c * y - s * x));
    const double wx = f * diffuser_mm[0] * x, wy = f * diffuser_mm[1] * y;
    const double sigma = pi / fwhm_per_sigma;
    m *= gaussian ? std::exp(-2 * sigma * sigma * (wx * wx + wy * wy)) : sinc(wx) * sinc(wy);
    return std::abs(m);
}

double Blur::width_mm(bool horizontal) const {
    // A gaussian's tails reach two half widths farther.
    return pixel_mm + spot_mm + (gaussian ? 2 : 1) * diffuser_mm[horizontal ? 0 : 1];
}

}  // namespace lfdsim
