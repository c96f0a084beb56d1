#include "analysis/luminance_theory.h"

#include "model/numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lfdsim {
namespace {

struct Weighted {
    double at, share;
};

/// The diffuser's angles along one axis, radians; 0 alone without one.
std::vector<Weighted> diffuser_angles(const Display& d, int axis) {
    constexpr int steps = 128;
    const double half = d.diffuser ? d.diffuser->angle_deg[std::size_t(axis)] * pi / 360 : 0;
    if (half <= 0) return {{0, 1}};
    const bool box = d.diffuser->profile == Profile::box;
    const double sigma = half / std::sqrt(2 * std::numbers::ln2), reach = box ? half : std::min(4.5 * sigma, 1.55);
    std::vector<Weighted> angles;
    double all = 0;
    for (int k = 0; k < steps; ++k) {
        const double a = reach * ((2 * k + 1.) / steps - 1);
        angles.push_back({a, box ? 1 : std::exp(-0.5 * a * a / (sigma * sigma))});
        all += angles.back().share;
    }
    for (Weighted& a : angles) a.share /= all;
    return angles;
}

bool is_round(const Display& d) { return d.array.aperture == Aperture::circle || d.lens.stop_radius_mm; }

/// Places across the clear aperture: chords of a disk, or evenly.
std::vector<Weighted> aperture_places(const Display& d, const Geometry& g, std::size_t axis) {
    constexpr int steps = 64;
    std::vector<Weighted> places;
    double all = 0;
    for (int k = 0; k < steps; ++k) {
        const double u = (2 * k + 1.) / steps - 1;
        places.push_back({0.5 * g.clear_aperture_mm[axis] * u, is_round(d) ? std::sqrt(1 - u * u) : 1});
        all += places.back().share;
    }
    for (Weighted& p : places) p.share /= all;
    return places;
}

/// One axis of the display as an eye on axis sees it through thin lenses.
struct AxisLight {
    double eye, gap, focal_length, diffuser, pitch, offset, lenses, panel_half;
    AxisLight(const Display& d, const Geometry& g, double eye_mm, std::size_t k)
        : eye(eye_mm - g.rear_principal_mm),
          gap(g.gap_mm),
          focal_length(g.focal_length_mm),
          diffuser(d.diffuser ? d.diffuser->distance_mm : 0),
          pitch(d.array.pitch_mm[k]),
          offset(d.array.offset_mm[k]),
          lenses(g.lattice.count[k]),
          panel_half(0.5 * (k == 0 ? g.panel_width_mm : g.panel_height_mm)) {}

    /// Share of the lenses whose place q lies between these.
    double share_between(double low, double high, double q) const {
        const auto lens = [&](double place) { return (place - q - offset) / pitch + 0.5 * lenses - 0.5; };
        const double first = std::max(std::ceil(lens(low)), 0.), last = std::min(std::floor(lens(high)), lenses - 1);
        return std::max(last - first + 1, 0.) / lenses;
    }

    /// Share of the lines through place q of a lens that see the panel after the diffuser has turned them by an angle. They aim at
    /// X, come down at Y = X + d (s - X/E), s the slope behind the diffuser, and see the panel at Y - q g/f + g s. For the panel's
    /// ends X is found as a fixed point.
    double seen(double angle, double q) const {
        const auto slope = [&](double x) { return std::tan(std::atan(x / eye) + angle); };
        const auto down = [&](double x) { return x + diffuser * (slope(x) - x / eye); };
        const auto aimed_at_panel = [&](double end) {
            double x = end;
            for (int k = 0; k < 30; ++k) x = end + q * gap / focal_length - gap * slope(x) - (down(x) - x);
            return x;
        };
        const double half = 0.5 * lenses * pitch;
        return share_between(down(std::max(offset - half, aimed_at_panel(-panel_half))),
                             down(std::min(offset + half, aimed_at_panel(panel_half))), q);
    }
};

double seen_share(const Display& d, const Geometry& g, double eye_mm, int axis) {
    const AxisLight along(d, g, eye_mm, std::size_t(axis));
    double share = 0;
    for (const Weighted& angle : diffuser_angles(d, axis))
        for (const Weighted& q : aperture_places(d, g, std::size_t(axis)))
            share += angle.share * q.share * along.seen(angle.at, q.at);
    return share;
}

double transmission(const Display& d, const Geometry& g) {
    double t = 1;
    if (d.render.fresnel == Fresnel::none) return t;
    for (const PlacedSurface& s : g.surfaces)
        t *= 4 * s.index_below * s.index_above / ((s.index_below + s.index_above) * (s.index_below + s.index_above));
    return t;
}

/// The share of light that the lenses pass on, with a panel behind all of the array.
double passed(const Display& d, const Geometry& g) {
    const auto r = [&](std::size_t k) { return 0.5 * g.clear_aperture_mm[k] / d.array.pitch_mm[k]; };
    const double fill = is_round(d) ? pi * r(0) * r(1) : 1, t = transmission(d, g);
    if (d.lens.is_thin() || d.array.surround == Surround::opaque || d.lens.stop_radius_mm) return fill * t;
    return d.array.surround == Surround::plate ? t : fill * t + 1 - fill;
}

}  // namespace

TheoryFigure luminance_over_panel(const Display& d, const Geometry& g, double eye_mm) {
    if (d.panel.emission_exponent != 0) return {nan, "theory holds for a panel that is equally bright from all directions"};
    if (is_staggered(d.array) || is_strips(d.array)) return {nan, "theory holds for rows and columns of lenses"};
    if (!d.panel.layers.empty()) return {nan, "theory holds for panels without layers"};
    if (d.array.turn_deg() != 0) return {nan, "theory holds for arrays that are not turned"};
    return {passed(d, g) * seen_share(d, g, eye_mm, 0) * seen_share(d, g, eye_mm, 1), ""};
}

}  // namespace lfdsim
