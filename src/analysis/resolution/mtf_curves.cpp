#include "analysis/resolution/mtf_curves.h"

#include "analysis/core/channel_pixels.h"
#include "analysis/resolution/mtf_theory.h"
#include "analysis/resolution/slanted_edge.h"
#include "base/constants.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Returns the errors of modulation at each frequency: the jackknife's, and the change with pixels anywhere, which may be empty.
std::vector<double> errors(const Modulation& m, const std::vector<double>& pixels_anywhere) {
    std::vector<double> found(m.all.size());
    for (std::size_t n = 0; n < found.size(); ++n) {
        found[n] = jackknife([&](int k) { return k < 0 ? m.all[n] : m.without[std::size_t(k)][n]; }).error;
        if (!pixels_anywhere.empty()) found[n] = std::hypot(found[n], m.all[n] - pixels_anywhere[n]);
    }
    return found;
}

/// Returns where modulation falls below a level.
LimitingFrequency crossing(const std::vector<double>& frequencies, const Modulation& m, const std::vector<double>& pixels_anywhere,
                           double level) {
    if (m.all.empty()) return {};
    Estimate found = jackknife([&](int k) { return falls_below(frequencies, k < 0 ? m.all : m.without[std::size_t(k)], level); });
    if (const double anywhere = falls_below(frequencies, pixels_anywhere, level); std::isfinite(anywhere))
        found.error = std::hypot(found.error, found.value - anywhere);
    // The error reaches to where the curve less and plus its error crosses the level.
    std::vector<double> low = m.all, high = m.all;
    const std::vector<double> error = errors(m, pixels_anywhere);
    for (std::size_t n = 0; n < error.size(); ++n) low[n] -= error[n], high[n] += error[n];
    const double least = falls_below(frequencies, low, level), most = falls_below(frequencies, high, level);
    if (std::isnan(most)) return {{}, least};
    return {{found.value, std::max({found.error, found.value - least, most - found.value})}, least};
}

/// Returns whether modulation falls below one half, whatever its error.
bool falls_below_half(const Modulation& m) {
    const std::vector<double> error = errors(m, {});
    for (std::size_t n = 0; n < error.size(); ++n)
        if (m.all[n] + error[n] < 0.5) return true;
    return false;
}

/// Returns the mean of exp(2 pi i nu off) of the luminance by theory.
std::complex<double> luminance_wave(const std::vector<ChannelBlur>& channels, double per_mm, const Direction& direction) {
    std::complex<double> sum = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) sum += luminance_weights[c] * channels[c].wave(per_mm, direction);
    return sum;
}

}  // namespace

LimitingFrequency MtfCurves::below(double level) const { return crossing(frequencies_per_mm, modulation, pixels_anywhere, level); }

LimitingFrequency MtfCurves::below(double level, std::size_t channel) const {
    if (channels.empty()) return below(level);
    const ChannelMtf& of = channels[channel];
    return crossing(frequencies_per_mm, of.modulation, of.pixels_anywhere, level);
}

LimitingFrequency MtfCurves::edges_below(std::size_t channel, double level) const {
    LimitingFrequency crossed = crossing(frequencies_per_mm, edges[channel], {}, level);
    crossed.found.error = std::hypot(crossed.found.error, crossed.found.value - below(level, channel).found.value);
    return crossed;
}

double MtfCurves::theory_below(double level) const { return has_theory() ? falls_below(frequencies_per_mm, theory, level) : nan; }

double MtfCurves::theory_below(double level, std::size_t channel) const {
    if (channels.empty()) return theory_below(level);
    return has_theory() ? falls_below(frequencies_per_mm, channels[channel].theory, level) : nan;
}

SeenInColours seen_in_colours(const Subject& s, const Vec3d& eye) {
    if (!has_colours(s.display())) return {SeenThroughLenses(s, eye, green_channel), {}};
    const std::array channels{SeenThroughLenses(s, eye, 0), SeenThroughLenses(s, eye, 1), SeenThroughLenses(s, eye, 2)};
    return {SeenThroughLenses(channels), {channels.begin(), channels.end()}};
}

MtfCurves mtf_curves(const Subject& s, const SeenInColours& seen, double depth_mm, double angle_deg, const Direction& direction) {
    constexpr int steps = 160;
    constexpr double most_lost = 0.2;  // of the light, beyond what the screen shows of the plane
    const EdgeEye eye{angle_deg, s.viewing_distance_mm()};
    const Bars plane = bars_across(direction, s.geometry().vertex_plane_mm + depth_mm);
    using PixelPositions = SeenThroughLenses::PixelPositions;
    const LineSpread spread = seen.luminance.spread(plane.z_mm, direction, PixelPositions::as_described);
    // Seen from the side the plane is foreshortened, most along x; an eye on axis sees (z_eye - z) pi/180 mm in a degree.
    const double aside = direction.x * std::sin(angle_deg * degree), foreshortened = std::sqrt(1 - aside * aside);
    MtfCurves m{};
    m.depth_mm = depth_mm, m.angle_deg = angle_deg, m.direction = direction;
    m.mm_per_deg = (eye.z_mm() - plane.z_mm) / std::cos(angle_deg * degree) * degree / foreshortened;
    m.astray = light_astray(s, angle_deg, eye.distance_mm);
    m.spread_mm = spread.width_mm(0.95);
    // Reasons to give no figure
    if (at_the_lenses(s.display(), s.geometry(), plane.z_mm))
        m.missing = "in the lenses' own plane each lens shows only one point of it";
    else if (!(m.spread_mm > 0))
        m.missing = "no light of elemental images is seen there";
    else if (spread.width_mm(1 - most_lost) > 2 * seen_half_mm(s.geometry(), plane, eye)[0])
        m.missing = "the light is spread over more of that plane than the screen shows";

    // Frequencies reach to the first zero of a pixel's image or, if the blur is far wider, to 4 over its width, where the MTF is
    // negligible.
    const Blur by_theory = blur(s.display(), s.geometry(), s.theory(), plane.z_mm, angle_deg);
    const double width = m.spread_mm > 0 ? m.spread_mm : by_theory.width_mm(direction);
    std::vector<ChannelBlur> blurs;
    for (std::size_t c = 0; c < seen.channels.size(); ++c) blurs.emplace_back(s, c, plane.z_mm, angle_deg);
    double finest = by_theory.pixel_mm;
    for (const ChannelBlur& channel : blurs) finest = std::min(finest, channel.narrowest_mm(direction));
    double step = 1 / std::max(finest, 0.25 * width) / steps;
    if (m.missing.empty()) {
        // A narrow core within a wide halo keeps its modulation longer, and a channel may have one where luminance has none:
        // frequencies are doubled until all curves fall below one half.
        std::vector<LineSpread> spreads{spread};
        for (const SeenThroughLenses& channel : seen.channels)
            spreads.push_back(channel.spread(plane.z_mm, direction, PixelPositions::as_described));
        const auto falls = [&](const LineSpread& of) { return falls_below_half(of.mtf(step, steps + 1)); };
        while (step * steps < 1 / finest && !std::ranges::all_of(spreads, falls)) step *= 2;
        m.modulation = spread.mtf(step, steps + 1);
        m.pixels_anywhere = seen.luminance.spread(plane.z_mm, direction, PixelPositions::anywhere).mtf(step, steps + 1).all;
    }
    for (int k = 0; k <= steps; ++k) {
        m.frequencies_per_mm.push_back(step * k);
        m.theory.push_back(blurs.empty() ? by_theory.mtf(step * k, direction)
                                         : std::abs(luminance_wave(blurs, step * k, direction)));
    }
    for (std::size_t c = 0; c < seen.channels.size(); ++c) {
        ChannelMtf& channel = m.channels.emplace_back();
        for (const double f : m.frequencies_per_mm) channel.theory.push_back(std::abs(blurs[c].wave(f, direction)));
        channel.theory_middle_mm = blurs[c].middle_mm(direction);
        if (!m.missing.empty()) continue;
        const LineSpread of_channel = seen.channels[c].spread(plane.z_mm, direction, PixelPositions::as_described);
        channel.modulation = of_channel.mtf(step, steps + 1);
        channel.middle_mm = of_channel.middle_mm();
        const LineSpread anywhere = seen.channels[c].spread(plane.z_mm, direction, PixelPositions::anywhere);
        channel.pixels_anywhere = anywhere.mtf(step, steps + 1).all;
        channel.middle_anywhere_mm = anywhere.middle_mm().value;
    }
    return m;
}

}  // namespace lfdsim
