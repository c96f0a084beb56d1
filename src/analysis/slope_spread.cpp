#include "analysis/slope_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lfdsim {

SlopeSpread::SlopeSpread(const Subject& s, double eye) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const bool round = d.array.aperture == Aperture::circle || d.lens.stop_radius_mm;
    aperture_ = {round ? Shape::disk : Shape::even, g.clear_aperture_mm * std::abs(1 / eye - 1 / s.theory().central_depth_mm)};
    lenses_ = {Shape::even, g.array_width_mm * std::abs(1 / eye - 1 / (d.content.viewing_distance_mm - g.rear_principal_mm))};
    diffuser_ = {Shape::even, 0};
    if (!d.diffuser) return;
    const double half = std::min(d.diffuser->angle_deg[0] * std::numbers::pi / 360, 1.55);
    diffuser_ = {d.diffuser->profile == Profile::box ? Shape::even : Shape::gaussian,
                 2 * std::tan(half) * (1 - (*g.diffuser_z_mm - g.rear_principal_mm) / eye)};
}

double SlopeSpread::Spread::below(double x) const {
    if (width <= 0 || std::isinf(x)) return x < 0 ? 0 : x > 0 ? 1 : 0.5;
    if (shape == Shape::gaussian) return 0.5 * (1 + std::erf(x / width * 2 * std::sqrt(std::numbers::ln2)));
    const double u = std::clamp(2 * x / width, -1., 1.);
    return 0.5 + (shape == Shape::even ? 0.5 * u : (u * std::sqrt(1 - u * u) + std::asin(u)) / std::numbers::pi);
}

double SlopeSpread::Spread::reach() const { return (shape == Shape::gaussian ? 3 : 0.5) * width; }

// The widest spread by its closed form, the other two in steps.
double SlopeSpread::within(double low, double high) const {
    constexpr int steps = 64;
    std::array<Spread, 3> spreads{aperture_, diffuser_, lenses_};
    std::sort(spreads.begin(), spreads.end(), [](const Spread& a, const Spread& b) { return a.width < b.width; });
    const auto in_steps = [](const Spread& s) {
        std::array<std::pair<double, double>, steps> parts;  // place, share
        for (int k = 0; k < steps; ++k) {
            const double from = s.reach() * (2. * k / steps - 1), to = s.reach() * (2. * (k + 1) / steps - 1);
            parts[std::size_t(k)] = {0.5 * (from + to), s.width > 0 ? s.below(to) - s.below(from) : 1. / steps};
        }
        return parts;
    };
    double sum = 0;
    for (const auto& [x, of_x] : in_steps(spreads[0]))
        for (const auto& [y, of_y] : in_steps(spreads[1]))
            sum += of_x * of_y * (spreads[2].below(high - x - y) - spreads[2].below(low - x - y));
    return sum;
}

}  // namespace lfdsim
