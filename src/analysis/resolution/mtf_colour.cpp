// The channels of the measure of resolution. docs/measures.md, "Resolution".

#include "analysis/resolution/mtf_colour.h"

#include "analysis/core/figure_json.h"
#include "base/constants.h"
#include "display/colour.h"

#include <fmt/format.h>
#include <cmath>

namespace lfdsim {
namespace {

/// Returns the mean distance of what a channel shows from what green shows, mm. The error includes the effect of the phases in
/// which this screen's pixels happen to meet its lenses.
Estimate from_green(const MtfCurves& m, std::size_t channel) {
    const ChannelMtf &here = m.channels[channel], &green = m.channels[green_channel];
    const double off = here.middle_mm.value - green.middle_mm.value, anywhere = here.middle_anywhere_mm - green.middle_anywhere_mm;
    return {off, std::hypot(here.middle_mm.error, green.middle_mm.error, off - anywhere)};
}

double theory_from_green(const MtfCurves& m, std::size_t channel) {
    return m.has_theory() ? m.channels[channel].theory_middle_mm - m.channels[green_channel].theory_middle_mm : nan;
}

/// Returns a plot of the three channels' curves in their colours, with theory as dots.
Plot colour_plot(const MtfCurves& m, const std::string& name) {
    Plot plot{name,
              fmt::format("Modulation transfer of each colour at {:.4g} mm, {}, {:.3g} degrees", m.depth_mm, m.direction.told,
                          m.angle_deg),
              "cycles per mm in that plane",
              "modulation",
              {}};
    for (std::size_t c = 0; c < 3; ++c)
        plot.series.push_back({colour_of_channel[c], m.frequencies_per_mm, m.channels[c].modulation.all, false, c});
    plot.series.push_back({"luminance", m.frequencies_per_mm, m.modulation.all});
    if (m.has_theory())
        for (std::size_t c = 0; c < 3; ++c) {
            Series theory{fmt::format("{}, theory", colour_of_channel[c]), {}, {}, true, c};
            for (std::size_t k = 0; k < m.frequencies_per_mm.size(); k += 4) {
                theory.x.push_back(m.frequencies_per_mm[k]);
                theory.y.push_back(m.channels[c].theory[k]);
            }
            plot.series.push_back(std::move(theory));
        }
    plot.marks.push_back({"0.5", 0.5, false});
    return plot;
}

}  // namespace

Json colours_json(const MtfCurves& m) {
    Json json;
    if (m.channels.empty()) return json;
    for (const auto& [name, level] : {std::pair{"theory_mtf50", 0.5}, std::pair{"theory_mtf10", 0.1}})
        for (std::size_t c = 0; c < 3; ++c) {
            const double per_mm = m.theory_below(level, c);
            json[std::string(name) + "_per_mm"][colour_of_channel[c]] = number_json(per_mm);
            json[std::string(name) + "_per_deg"][colour_of_channel[c]] = number_json(per_mm * m.mm_per_deg);
        }
    for (const std::size_t c : {std::size_t(0), std::size_t(2)}) {
        const Estimate off = m.missing.empty() ? from_green(m, c) : Estimate{};
        json["from_green_mm"][colour_of_channel[c]] = number_json(off.value);
        json["from_green_mm_error"][colour_of_channel[c]] = number_json(off.error);
        json["theory_from_green_mm"][colour_of_channel[c]] = number_json(theory_from_green(m, c));
    }
    return json;
}

void tell_mtf_of_colours(std::span<const MtfCurves* const> at_depth, Result& result) {
    const MtfCurves *first = nullptr, *last = nullptr;  // of the first direction: on axis, and from the farthest angle
    for (const MtfCurves* m : at_depth) {
        if (m->channels.empty() || !m->missing.empty()) continue;
        if (!first) first = m;
        if (m->direction.axis != first->direction.axis) break;
        last = m;
    }
    if (!first) return;
    for (std::size_t c = 0; c < 3; ++c) {
        const Estimate mtf50 = first->below(0.5, c).found;
        result.add_line({mtf50, "MTF is not clearly below one half up to the highest frequency measured"},
                        {.label = fmt::format("MTF50 of {} at {:.4g} mm, {}, {:.3g} degrees", colour_of_channel[c], first->depth_mm,
                                              first->direction.told, first->angle_deg),
                         .unit = "per mm",
                         .theory = first->theory_below(0.5, c),
                         .remark = fmt::format("{:.4g} cycles per degree", mtf50.value * first->mm_per_deg)});
    }
    result.add_line({from_green(*last, 0), from_green(*last, 2)},
                    {.label = fmt::format("Red and blue from green at {:.4g} mm, {}, {:.3g} degrees", last->depth_mm,
                                          last->direction.told, last->angle_deg),
                     .unit = "mm",
                     .theory = std::vector{theory_from_green(*last, 0), theory_from_green(*last, 2)},
                     .remark = "shift of the colours shown, mean over the screen: the width of an edge's coloured fringe"});
    result.plots.push_back(colour_plot(*first, "mtf_colour"));
    if (last != first) result.plots.push_back(colour_plot(*last, "mtf_colour_aside"));
}

std::string remark_on_channels(std::span<const MtfCurves> all) {
    for (const MtfCurves& m : all)
        if (!m.channels.empty())
            return "MTF is that of the luminance; red, green and blue are traced from their positions on the panel and at their "
                   "own wavelengths.";
    return "Red, green and blue are alike: the model has neither dispersion nor subpixels.";
}

}  // namespace lfdsim
