#include "analysis/resolution/mtf_theory.h"

#include "analysis/crosstalk/paraxial_lines.h"
#include "analysis/crosstalk/slope_spread.h"
#include "base/constants.h"
#include "base/sinc.h"
#include "geometry/sharp_range.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// The share of slanted strips' light beside their own images: the sum over lines of sight of paraxial theory, across the strips.
/// One closed form of SlopeSpread's kind does not do: a diffuser's and a pixel's widths along x and y both count across.
double strips_astray(const Subject& s, double angle_deg, double distance_mm) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const Lattice<double>& l = g.lattice;
    const ParaxialLines lines(d, g, {distance_mm * std::sin(angle_deg * degree), 0, distance_mm * std::cos(angle_deg * degree)});
    const double image = s.theory(0).elemental_pitch_mm, scale = image / l.pitch[0];
    const double off = optics::to_array(l, l.offset[0], l.offset[1]).x;  // elemental images spread from the panel's middle
    int own = 0, all = 0;
    for (const Choice& c : even_choices(1 << 14)) {
        const auto line = lines.look(0.5 * g.panel_width_mm * c[4], 0.5 * g.panel_height_mm * c[5], c[2], c[3]);
        if (!line || !line->through) continue;
        const double half_pixel = 0.5 * d.panel.pixel_pitch_mm;
        const double middle = line->seen.x + half_pixel * (c[0] * l.cos_turn + c[1] * l.sin_turn);  // of the pixel
        ++all;
        own += std::abs(middle + off - scale * (line->axis.x + off)) <= 0.5 * image;
    }
    return all > 0 ? 1 - double(own) / all : 1;
}

}  // namespace

double pixel_image_mm(const Display& d, const Geometry& g, double z_mm) {
    return d.panel.pixel_pitch_mm * std::abs(z_mm - g.rear_principal_mm) / g.gap_mm;
}

double lens_limit_per_mm(const Subject& s, const Direction& direction, double z_mm, double angle_deg) {
    return lens_limit_per_mm(s.display(), s.geometry(), s.theory(), z_mm - s.geometry().vertex_plane_mm,
                             s.viewing_distance_mm() * std::cos(angle_deg * degree), std::size_t(direction.axis));
}

double pixel_limit_per_mm(const Subject& s, const Direction& direction, double z_mm) {
    const double pixel = pixel_image_mm(s.display(), s.geometry(), z_mm) * std::max(std::abs(direction.x), std::abs(direction.y));
    return pixel > 0 ? 0.5 / pixel : infinity;
}

std::vector<double> limits_to_plot(std::vector<double> limits, double at_lenses) {
    for (double& limit : limits)
        if (!(limit <= 4 * at_lenses)) limit = nan;
    return limits;
}

bool at_the_lenses(const Display& d, const Geometry& g, double z_mm) {
    return pixel_image_mm(d, g, z_mm) < 1e-6 * g.lattice.pitch[0];
}

Blur blur(const Display& d, const Geometry& g, const Theory& t, double z_mm, double angle_deg) {
    const double defocus = std::abs(1 - (z_mm - g.rear_principal_mm) / t.central_depth_mm);
    Blur b{pixel_image_mm(d, g, z_mm) * std::sqrt(d.panel.aperture_ratio),
           aperture_shape(d, g),
           defocus,
           g.turn_deg * degree,
           {0, 0},
           &figures_of(Profile::box)};
    if (!d.diffuser) return b;
    const double away = std::abs(z_mm - *g.diffuser_z_mm), angle = angle_deg * degree;
    const auto half = [&](std::size_t axis) { return 0.5 * d.diffuser->angle_deg[axis] * degree; };
    // The turn about x comes last: it adds the same upward slope at every angle of view. Past the horizontal nothing is seen:
    // an angle near it serves as well.
    const auto slope = [](double a) { return std::tan(std::clamp(a, -1.5, 1.5)); };
    b.diffuser_mm = {away * (slope(angle + half(0)) - slope(angle - half(0))), away * 2 * slope(half(1))};
    b.profile = &figures_of(d.diffuser->profile);
    return b;
}

double light_astray(const Subject& s, double angle_deg, double distance_mm) {
    const double eye = distance_mm * std::cos(angle_deg * degree) - s.geometry().rear_principal_mm;
    if (is_strips(s.display().array)) return strips_astray(s, angle_deg, distance_mm);
    const auto half = [&](int axis) { return 0.5 * s.theory(axis).elemental_pitch_mm / s.geometry().gap_mm; };
    if (!(eye > 0)) return 1;
    return 1 - SlopeSpread(s, eye, 0).within(distance_mm * std::sin(angle_deg * degree), -half(0), half(0)) *
                   SlopeSpread(s, eye, 1).within(0, -half(1), half(1));
}

std::complex<double> Blur::wave(std::complex<double> pixel, double f, const Direction& direction) const {
    const double c = std::cos(array_rad), s = std::sin(array_rad), x = f * direction.x, y = f * direction.y;
    const double spot = aperture.mean(defocus * (c * x + s * y), defocus * (c * y - s * x));
    return pixel * spot * profile->transfer(x * diffuser_mm[0]) * profile->transfer(y * diffuser_mm[1]);
}

double Blur::mtf(double f, const Direction& direction) const {
    return std::abs(wave(sinc(f * direction.x * pixel_mm) * sinc(f * direction.y * pixel_mm), f, direction));
}

// A line of sight of slope m that meets a lens at q from its axis C ends, in this light, on P = C - q g/L - g m. By its nodal line
// in green light (g', from H') P shows C + (z - z_H') (C - P)/g'. The line itself is at C + q + (z - z_H) m.
ChannelBlur::ChannelBlur(const Subject& s, std::size_t channel, double z_mm, double angle_deg) : pixels_(s.display(), channel) {
    const Display& d = s.display();
    const Geometry& green = s.geometry();
    const double shown = (z_mm - green.rear_principal_mm) / green.gap_mm;  // height of the plane in gaps
    image_ = d.panel.pixel_pitch_mm * shown;
    for (const auto& [g, weight] : light_paths(d, green, channel)) {
        const Theory t = theory(d, g);
        BlurPath path{weight, blur(d, green, t, z_mm, angle_deg), {}, {}};
        const double lateral = shown * g.gap_mm - (z_mm - g.rear_principal_mm);  // off per slope
        path.blur.defocus = std::abs(1 - shown * g.gap_mm / t.central_depth_mm);
        if (d.diffuser) {
            const double away = z_mm - *green.diffuser_z_mm;
            for (double& width : path.blur.diffuser_mm) width *= std::abs(away) > 0 ? std::abs(1 + lateral / away) : 0;
        }
        const double eye = s.viewing_distance_mm() * std::cos(angle_deg * degree) - g.rear_principal_mm,
                     aside = s.viewing_distance_mm() * std::sin(angle_deg * degree);
        path.lateral_mm = {green.array_width_mm * lateral / eye, green.array_height_mm * lateral / eye};
        path.middle_mm = {(aside - g.lattice.offset[0]) * lateral / eye, -g.lattice.offset[1] * lateral / eye};
        paths_.push_back(std::move(path));
    }
}

std::complex<double> ChannelBlur::wave(double f, const Direction& direction) const {
    const std::complex<double> pixel = pixels_.wave(f * image_ * direction.x, -f * image_ * direction.y);
    std::complex<double> sum = 0;
    for (const auto& [weight, blur, lateral, middle] : paths_) {
        const double c = std::cos(blur.array_rad), s = std::sin(blur.array_rad), x = f * direction.x, y = f * direction.y;
        const double screen = sinc((c * x + s * y) * lateral[0]) * sinc((c * y - s * x) * lateral[1]);
        sum += weight * screen * blur.wave(pixel, f, direction) * std::polar(1., 2 * pi * (x * middle[0] + y * middle[1]));
    }
    return sum;
}

double ChannelBlur::middle_mm(const Direction& direction) const {
    double sum = 0;
    for (const BlurPath& path : paths_) sum += path.weight * (direction.x * path.middle_mm[0] + direction.y * path.middle_mm[1]);
    const auto [x, y] = pixels_.middle();
    return sum + image_ * (direction.x * x - direction.y * y);
}

double Blur::width_mm(const Direction& direction) const {
    return pixel_mm + defocus * aperture.width_mm[std::size_t(direction.axis)] +
           profile->width * (std::abs(direction.x) * diffuser_mm[0] + std::abs(direction.y) * diffuser_mm[1]);
}

}  // namespace lfdsim
