#include "view/answers/slider.h"

#include "base/bisection.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lfdsim::view {
namespace {

Slider about(double middle, double reach) { return {middle - reach, middle + reach, 0}; }

/// The slider of an error of assembly or moulds.
Slider of_error(std::string_view path, double pitch) {
    if (path == "errors.shift_mm") return about(0, pitch);
    if (path == "errors.gap_mm" || path == "errors.bow_mm") return about(0, 0.25 * pitch);
    if (path == "errors.rotation_deg" || path == "errors.wedge_deg") return about(0, 2);
    if (path == "errors.pitch_ppm") return about(0, 2000);
    if (path == "errors.seed") return {0, 100, 0};
    if (path.ends_with("_mm")) return {0, 0.05 * pitch, 0};
    return {0, path == "errors.tilt_sd_deg" ? 2. : 0.05, 0};
}

Slider ends_of(std::string_view path, const Range& range, double described, const Display& d, const Geometry& g) {
    const bool angle = path.ends_with("_deg");
    if (path == "array.rotation_deg") return about(described, 5);  // misalignment
    if (path == "array.slant_deg") return {-60, 60, 0};
    if (path.starts_with("errors.")) return of_error(path, d.array.pitch_mm.least());
    if (angle && range.low < 0) return {-180, 180, 0};
    if (path.ends_with("index")) return {1, 2.5, 0};
    if (path == "panel.emission_exponent") return {0, 10, 0};
    if (path == "panel.aperture_ratio") return {0.05, 1, 0};
    if (path == "render.seed") return {0, 100, 0};
    if (path == "array.offset_mm") return about(described, d.array.pitch_mm[0]);
    if (path == "content.depth_mm") return about(described, g.panel_height_mm);
    if (path.starts_with("content.light.")) return {0, std::max(1., 2 * described), 0};
    if (path.ends_with("curvature_per_mm")) return about(described, std::max(std::abs(described), 0.25 / g.clear_aperture_mm[0]));
    if (path.ends_with("conic")) return about(described, 3);
    if (range.low > 0 || range.low_open) return {described / 4, described * 4, 0};
    return {0, 4 * (described > 0 ? described : angle ? 1 : 0.25 * d.array.pitch_mm[0]), 0};
}

/// Returns 1, 2 or 5 times a power of ten, the nearest by ratio.
double round_step(double about) {
    const double power = std::pow(10, std::floor(std::log10(about)));
    double times = about / power;
    times = times < std::sqrt(2) ? 1 : times < std::sqrt(10) ? 2 : times < std::sqrt(50) ? 5 : 10;
    return rounded(times * power);
}

/// Returns the farthest point from `value` towards `end` up to which `valid` holds: tries the end and two points between, then
/// bisects. Positions are by ratio where both have the same sign and differ by more than a factor of two.
double edge(double value, double end, const std::function<bool(double)>& valid) {
    constexpr int trials = 3, halvings = 12;  // 2^-12 of a part is finer than a slider's steps
    if (valid(end)) return end;
    const bool geometric = value * end > 0 && std::abs(std::log2(end / value)) > 1;
    double good = value, bad = end;
    for (int k = 1; k < trials; ++k) {
        const double share = double(k) / trials;
        const double between = geometric ? value * std::pow(end / value, share) : value + (end - value) * share;
        if (!valid(between)) {
            bad = between;
            break;
        }
        good = between;
    }
    return bisected(good, bad, halvings, valid).in;
}

}  // namespace

double rounded(double x, int digits) { return std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr) + 0.0; }

Slider sensible_ends(std::string_view path, const Range& range, double described, const Display& d, const Geometry& g) {
    Slider ends = ends_of(path, range, described, d, g);
    const double most = std::min(range.high, 1e12);  // a viewing distance has no upper limit
    ends.low = std::clamp(ends.low, range.low, most);
    ends.high = std::clamp(ends.high, range.low, most);
    return ends;
}

Slider valid_part(Slider slider, double value, bool whole, const std::function<bool(double)>& valid) {
    slider.low = std::min(slider.low, value);
    slider.high = std::max(slider.high, value);
    const bool searched = valid(value);
    if (searched) slider = {edge(value, slider.low, valid), edge(value, slider.high, valid), 0};
    const double width = slider.high - slider.low;
    slider.step = round_step((width > 0 ? width : std::max(std::abs(value), 1e-3)) / 200);
    if (whole) slider.step = std::max(slider.step, 1.);
    // The ends are rounded inwards to multiples of the step, and one step further where rounding of numbers made them invalid.
    const auto multiple = [&](double end, double inwards) {
        double times = end / slider.step;
        times = inwards > 0 ? std::ceil(times - 1e-9) : std::floor(times + 1e-9);
        const double round = rounded(times * slider.step);
        return searched && !valid(round) ? rounded((times + inwards) * slider.step) : round;
    };
    slider.low = std::min(multiple(slider.low, 1), value);
    slider.high = std::max(multiple(slider.high, -1), value);
    return slider;
}

}  // namespace lfdsim::view
