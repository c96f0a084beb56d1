#include "analysis/uniformity/luminance_over_angle.h"

#include "base/constants.h"
#include "geometry/geometry.h"

#include <cmath>

namespace lfdsim {
namespace {

constexpr int angle_lines_a_set = 256;  // of an eye at an angle, and three times as many mirrored ones
constexpr double step_deg = 2.5, last_deg = 80;

}  // namespace

std::vector<double> luminance_angles_deg() {
    std::vector<double> angles;
    for (double a = -last_deg; a <= last_deg; a += step_deg) angles.push_back(a);
    return angles;
}

LuminanceOverAngle::LuminanceOverAngle(const Subject& s, const EyeRays& rays, double distance)
    : rays_(rays), distance_(distance), nearest_(nearest_eye_mm(s.geometry())) {
    const int count = angle_lines_a_set * rays.more_for({0, 0, distance});
    for (int k = 0; k < independent_sets; ++k) sets_[std::size_t(k)] = even_choices(count, set_number(s.display().render.seed, k));
}

Sums LuminanceOverAngle::at(int axis, double angle_deg) const {
    const double across = distance_ * std::sin(angle_deg * degree), ahead = distance_ * std::cos(angle_deg * degree);
    Sums sums;
    sums.fill(nan);
    if (!(ahead > nearest_)) return sums;
    const Vec3d eye{axis == 0 ? across : 0, axis == 0 ? 0 : across, ahead};
    for (std::size_t k = 0; k < sets_.size(); ++k) {
        double sum = 0, lines = 0;
        for (const Choice& c : sets_[k])
            for (const double x : {-1., 1.})
                for (const double y : {-1., 1.}) {
                    const Sight sight = rays_.look(eye, {x * c[0], y * c[1], x * c[2], y * c[3], x * c[4], y * c[5]});
                    // Sums of floats in double are exact, so that mirrored displays have equal sums.
                    sum += double(float(sight.light));
                    lines += sight.on_screen;
                }
        sums[k] = sum / lines;
    }
    return sums;
}

/// Returns the angle, between one with more than half of the luminance on axis and one with less, at which it is half: by seven
/// bisections. The error is the noise over the slope, and half of the last step.
Estimate LuminanceOverAngle::half_between(int axis, double bright, double dark) const {
    const Sums middle = at(axis, 0);
    const auto excess = [&](const Sums& here, int without) { return total(here, without) - 0.5 * total(middle, without); };
    const Sums first = at(axis, bright), last = at(axis, dark);
    const double slope = (excess(last, -1) - excess(first, -1)) / (dark - bright);
    Sums here{};
    for (int halved = 0; halved < 7; ++halved) {
        here = at(axis, 0.5 * (bright + dark));
        (excess(here, -1) >= 0 ? bright : dark) = 0.5 * (bright + dark);
    }
    const Estimate noise =
        jackknife([&](int without) { return excess(here, without) * independent_sets / (independent_sets - (without >= 0)); });
    return {0.5 * (bright + dark), std::hypot(noise.error / slope, 0.5 * (dark - bright))};
}

Estimate LuminanceOverAngle::half_deg(int axis, const std::vector<double>& angles, const std::vector<double>& light,
                                      int side) const {
    const int middle = int(angles.size() / 2), count = int(angles.size());
    for (int k = middle + side; k >= 0 && k < count && !std::isnan(light[std::size_t(k)]); k += side)
        if (light[std::size_t(k)] < 0.5 * light[std::size_t(middle)])
            return half_between(axis, angles[std::size_t(k - side)], angles[std::size_t(k)]);
    return {nan, nan};
}

}  // namespace lfdsim
