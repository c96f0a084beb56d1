#include "analysis/crosstalk/slope_spread.h"
#include "base/constants.h"
#include "geometry/diffuser_profile.h"
#include "geometry/screen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace lfdsim {
namespace {

constexpr int places_across = 64;  // of the array, for which light is summed
constexpr double most_rad = 1.55;  // from the normal

double even_below(double x, double width) {
    return width > 0 ? figures_of(Profile::box).below(x / width) : x < 0 ? 0 : x > 0 ? 1 : 0.5;
}

}  // namespace

SlopeSpread::SlopeSpread(const Subject& s, double eye, int axis)
    : eye_mm_(eye),
      array_mm_(screen_size_mm(s.geometry())[std::size_t(axis)]),
      shape_(aperture_shape(s.display(), s.geometry())),
      axis_(std::size_t(axis)),
      aperture_slopes_(shape_.extent_mm(axis_) * std::abs(1 / eye - 1 / s.geometry().focal_length_mm + 1 / s.geometry().gap_mm)),
      half_rad_(0),
      above_mm_(0),
      diffuser_scale_(1),
      profile_(&figures_of(Profile::box)) {
    const Geometry& g = s.geometry();
    const double made_for = s.display().content.viewing_distance_mm - g.rear_principal_mm;
    lens_slopes_per_mm_ = 1 / made_for - 1 / eye;
    const std::size_t line = line_of_eyes(g.lattice);
    if (g.lattice.strips) {  // along the line of eyes, which crosses them obliquely
        aperture_slopes_ /= across_share(g.lattice);
        array_mm_ = std::min(array_mm_ / across_share(g.lattice), line == 0 ? g.panel_width_mm : g.panel_height_mm);
    }
    const auto& diffuser = s.display().diffuser;
    if (!diffuser) return;
    half_rad_ = std::min(diffuser->angle_deg[line == 1 ? 1 : axis_] * degree / 2, most_rad);
    profile_ = &figures_of(diffuser->profile);
    above_mm_ = diffuser->distance_mm;
    diffuser_scale_ = 1 - (*g.diffuser_z_mm - g.rear_principal_mm) / made_for;
}

double SlopeSpread::width() const { return aperture_slopes_ + 2 * std::tan(half_rad_) * std::abs(diffuser_scale_); }

SlopeSpread::Spread SlopeSpread::aperture() const {
    const double width = aperture_slopes_;
    return {-0.5 * width, 0.5 * width, [this, width](double x) {
                return width > 0 ? shape_.below(axis_, x / width * shape_.extent_mm(axis_)) : even_below(x, 0);
            }};
}

/// The spread by the lenses about a place, as far as half way to the next places.
SlopeSpread::Spread SlopeSpread::lenses() const {
    const double width = std::abs(array_mm_ / places_across * lens_slopes_per_mm_);
    return {-0.5 * width, 0.5 * width, [width](double x) { return even_below(x, width); }};
}

/// Share of the light that the diffuser turns by less than an angle.
double SlopeSpread::turned_less(double angle) const { return profile_->below(angle / (2 * half_rad_)); }

SlopeSpread::Spread SlopeSpread::diffuser(double x_mm, double aimed_mm) const {
    if (half_rad_ <= 0) return {0, 0, [](double x) { return x < 0 ? 0. : x > 0 ? 1. : 0.5; }};
    const double slope = (aimed_mm - x_mm) / eye_mm_, tilt = std::atan(slope), reach = 2 * profile_->reach * half_rad_;
    const auto turned_slope = [&](double angle) { return std::tan(std::clamp(tilt + angle, -most_rad, most_rad)) - slope; };
    const double left = (-0.5 * array_mm_ - aimed_mm) / above_mm_, right = (0.5 * array_mm_ - aimed_mm) / above_mm_;
    const double least = std::max(turned_slope(-reach), left), most = std::min(turned_slope(reach), right);
    // The slope meant falls as the line turns outwards.
    const double scale = -diffuser_scale_;
    const auto turned_below = [=, this](double t) { return turned_less(std::atan(slope + std::clamp(t, least, most)) - tilt); };
    const double none = turned_below(least), all = turned_below(most);
    if (scale == 0) return {0, 0, [all, none](double x) { return (x < 0 ? 0 : x > 0 ? 1 : 0.5) * (all - none); }};
    return {std::min(scale * least, scale * most), std::max(scale * least, scale * most),
            [=](double x) { return scale > 0 ? turned_below(x / scale) - none : all - turned_below(x / scale); }};
}

/// Light between two slopes of the sum of spreads: the widest by its closed form, the others in steps.
double SlopeSpread::convolved(std::array<const Spread*, 3> spreads, double low, double high) {
    constexpr int steps = 32;
    std::sort(spreads.begin(), spreads.end(), [](const Spread* s, const Spread* t) { return s->high - s->low < t->high - t->low; });
    const auto in_steps = [](const Spread& s) {
        const int count = s.high > s.low ? steps : 1;
        std::vector<std::pair<double, double>> parts;  // place, light
        for (int k = 0; k < count; ++k) {
            const double from = s.low + (s.high - s.low) * k / count, to = s.low + (s.high - s.low) * (k + 1) / count;
            parts.emplace_back(0.5 * (from + to), count > 1 ? s.below(to) - s.below(from) : s.below(1e300));
        }
        return parts;
    };
    double sum = 0;
    for (const auto& [x, of_x] : in_steps(*spreads[0]))
        for (const auto& [y, of_y] : in_steps(*spreads[1]))
            sum += of_x * of_y * (spreads[2]->below(high - x - y) - spreads[2]->below(low - x - y));
    return sum;
}

double SlopeSpread::within(double x_mm, double low, double high) const {
    const Spread of_aperture = aperture(), of_lenses = lenses();
    double found = 0, all = 0;
    for (int k = 0; k < places_across; ++k) {
        const double aimed = array_mm_ * ((k + 0.5) / places_across - 0.5);
        const Spread of_diffuser = diffuser(x_mm, aimed);
        const double middle = x_mm / eye_mm_ + aimed * lens_slopes_per_mm_;
        found += convolved({&of_aperture, &of_lenses, &of_diffuser}, low - middle, high - middle);
        all += of_diffuser.below(1e300);
    }
    return all > 0 ? found / all : 0;
}

}  // namespace lfdsim
