#include "analysis/mtf_curves.h"

#include "analysis/mtf_theory.h"
#include "analysis/slanted_edge.h"
#include "model/numbers.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

Estimate crossing(const std::vector<double>& frequencies, const Modulation& m, double level) {
    if (m.all.empty()) return {nan, nan};
    return jackknife([&](int k) { return falls_below(frequencies, k < 0 ? m.all : m.without[std::size_t(k)], level); });
}

}  // namespace

Estimate MtfCurves::below(double level) const {
    Estimate found = crossing(frequencies_per_mm, modulation, level);
    if (const double anywhere = falls_below(frequencies_per_mm, pixels_anywhere, level); std::isfinite(anywhere))
        found.error = std::hypot(found.error, found.value - anywhere);
    return found;
}

Estimate MtfCurves::edges_below(std::size_t channel, double level) const {
    Estimate found = crossing(frequencies_per_mm, edges[channel], level);
    found.error = std::hypot(found.error, found.value - below(level).value);
    return found;
}

double MtfCurves::theory_below(double level) const { return has_theory() ? falls_below(frequencies_per_mm, theory, level) : nan; }

MtfCurves mtf_curves(const Subject& s, const SeenThroughLenses& seen, double depth_mm, double angle_deg,
                     const Direction& direction) {
    constexpr int steps = 160;
    constexpr double most_lost = 0.2;  // of the light, beyond what the screen shows of the plane
    const Eye eye{angle_deg, s.viewing_distance_mm()};
    const Bars plane = bars_across(direction, s.geometry().vertex_plane_mm + depth_mm);
    using Pixels = SeenThroughLenses::Pixels;
    const LineSpread spread = seen.spread(plane.z_mm, direction, Pixels::as_described);
    // Seen from the side the plane is foreshortened, most along x.
    const double aside = direction.x * std::sin(angle_deg * degree), foreshortened = std::sqrt(1 - aside * aside);
    MtfCurves m{};
    m.depth_mm = depth_mm, m.angle_deg = angle_deg, m.direction = direction;
    m.mm_per_deg = (eye.z_mm() - plane.z_mm) / std::cos(angle_deg * degree) * degree / foreshortened;
    m.astray = light_astray(s, angle_deg, eye.distance_mm);
    m.spread_mm = spread.width_mm(0.95);
    if (at_the_lenses(s.display(), s.geometry(), plane.z_mm))
        m.missing = "in the lenses' own plane each lens shows only one point of it";
    else if (!(m.spread_mm > 0))
        m.missing = "no light of elemental images is seen there";
    else if (spread.width_mm(1 - most_lost) > 2 * seen_half_mm(s.display(), s.geometry(), plane, eye)[0])
        m.missing = "light is spread there over more of the plane than the screen shows";

    // To the first zero of a pixel's image or, where the blur is far wider, to where next to nothing is left
    const Blur by_theory = blur(s.display(), s.geometry(), s.theory(), plane.z_mm, angle_deg);
    const double width = m.spread_mm > 0 ? m.spread_mm : by_theory.width_mm(direction);
    double step = 1 / std::max(by_theory.pixel_mm, 0.25 * width) / steps;
    if (m.missing.empty()) {
        // A narrow core within a wide halo keeps its modulation longer: it is followed as far as the lenses can show it.
        const double limit = lens_limit_per_mm(s, direction, plane.z_mm, angle_deg);
        const auto lowest = [&] { return *std::min_element(m.modulation.all.begin(), m.modulation.all.end()); };
        m.modulation = spread.mtf(step, steps + 1);
        for (; lowest() >= 0.5 && step * steps < std::min(limit, 1 / by_theory.pixel_mm);
             m.modulation = spread.mtf(step, steps + 1))
            step *= 2;
        m.pixels_anywhere = seen.spread(plane.z_mm, direction, Pixels::anywhere).mtf(step, steps + 1).all;
    }
    for (int k = 0; k <= steps; ++k) {
        m.frequencies_per_mm.push_back(step * k);
        m.theory.push_back(by_theory.mtf(step * k, direction));
    }
    return m;
}

}  // namespace lfdsim
