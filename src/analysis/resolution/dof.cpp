// The measure of the depth of field: likeness of the simulated view and a photograph of the scene over the scene's depth, and
// resolution by theory. docs/measures.md, "Depth of field".

#include "analysis/resolution/dof.h"

#include "analysis/core/elemental_panel.h"
#include "analysis/core/figure_json.h"
#include "analysis/fov/thresholds.h"
#include "analysis/pictures/views.h"
#include "analysis/resolution/dof_depths.h"
#include "analysis/resolution/mtf_theory.h"
#include "analysis/spots/spot_depth.h"
#include "base/constants.h"
#include "checks/depth_words.h"
#include "geometry/resolve.h"
#include "geometry/sharp_range.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double least_depth_ssim = 0.85, most_slope_per_mm = 0.02 / 10;  // of the 2019 paper, 0.02 per centimetre

/// SSIM of screen and of content over the scene's depth.
struct DepthCurves {
    Curve screen, content;
};

/// Measures the curves. Their noise is measured at one depth: that of the description, or the one nearest to it.
DepthCurves measure(Subject& s, const std::vector<double>& depths, double white, Job& job) {
    DepthCurves curves{{depths, {}}, {depths, {}}};
    std::size_t noisy = 0;
    const auto away = [&](std::size_t k) { return std::abs(depths[k] - s.geometry().content_depth_mm); };
    for (std::size_t k = 1; k < depths.size(); ++k)
        if (away(k) < away(noisy)) noisy = k;
    for (std::size_t k = 0; k < depths.size(); ++k) {
        const ContentScene scene = s.scene().at_depth(depths[k]);
        const auto panel = elemental_panel(s.display(), s.geometry(), scene, s.threads(), job);
        const ExpectedView expected = expected_view(s.display(), s.geometry(), scene, s.threads(), job);
        const Likeness l = likeness(expected, s.display(), s.geometry(), panel->summed(), white, s.rendering(), job);
        curves.screen.value.push_back(l.screen);
        curves.content.value.push_back(l.content);
        job.advance(2);
        if (k != noisy) continue;
        const Likeness error = likeness_error(l, expected, s.display(), s.geometry(), panel->summed(), white, s.rendering(), job);
        curves.screen.error = error.screen;
        curves.content.error = error.content;
        job.advance(4);
    }
    return curves;
}

/// Returns an interval with the reason why the run ends added to limits that were searched for to its ends.
Interval explained(Interval i, const DepthRun& run) {
    if (i.low.searched_out) i.low.missing += ": " + run.why_low;
    if (i.high.searched_out) i.high.missing += ": " + run.why_high;
    return i;
}

/// Returns the interval common to both, given about the same centre: at each end the limit nearer to it.
Interval narrower(const Interval& a, const Interval& b) {
    if (a.empty || b.empty) return a.empty ? a : b;
    const auto inner = [](const Limit& l, const Limit& m, bool low) { return (l.place() > m.place()) == low ? l : m; };
    return {inner(a.low, b.low, true), inner(a.high, b.high, false)};
}

/// Adds the published criteria, each as the connected interval about the depth of greatest likeness, and, for the content, both
/// together on either side of the lenses. Returns where both are met, for a plot: ends that are uncertain or beyond the search as
/// far as they are known.
PlotBar add_rules(Result& result, const std::string& region, const Curve& curve, const DepthRun& run) {
    const bool content = region == "content";
    const double most_alike = curve.at[std::size_t(std::ranges::max_element(curve.value) - curve.value.begin())];
    const Interval by_ssim = explained(where_at_least(curve, most_alike, least_depth_ssim), run),
                   steady = explained(where_steady(curve, most_alike, most_slope_per_mm), run);
    const std::string path = content ? "" : "screen.";
    Json& json = content ? result.figures : result.figures["screen"];
    json.update({{"most_alike_mm", most_alike}, {"ssim_error", curve.error}, {"region", region}});
    result.add(path + "ssim_rule_mm", figure_of(by_ssim));
    result.add(path + "gradient_rule_mm", figure_of(steady));
    if (!content) return {};
    const Interval both = narrower(by_ssim, steady);
    Json& spans = result.figures["by_likeness"];
    PlotBar bar{"by likeness", {}};
    for (const bool in_front : {false, true}) {
        const std::string name = in_front ? "in_front_mm" : "behind_mm";
        const Interval side = on_side_of_zero(both, in_front, "no depth on this side of the lenses meets the criterion");
        const FigureValue found = figure_of(side);
        spans[name] = side.empty ? Json() : numbers_json(found.numbers);
        spans[name + "_error"] = side.empty ? Json() : numbers_json(found.errors);
        if (!found.missing.empty()) result.note("by_likeness." + name, found.missing);
        result.add_line(
            found,
            {.label = fmt::format("Depth of field by likeness, {} the lenses", in_front ? "in front of" : "behind"),
             .unit = "mm",
             .remark = "the published criterion: SSIM of the content is 0.85 or more and changes by 0.02 per centimetre or less"});
        const auto end = [](const Limit& l, double beyond) { return l.searched_out ? beyond : l.place(); };
        if (!side.empty) bar.spans.push_back({end(side.low, -infinity), end(side.high, infinity)});
    }
    return bar;
}

/// Adds the resolution that lens pitch and panel pixels allow at each depth, as the eye sees it, along the axis of the greater
/// pitch.
void add_resolution(const Subject& s, Result& result, const std::vector<double>& depths) {
    const Geometry& g = s.geometry();
    const double eye = camera_distance_mm(s.display());
    const std::size_t coarser = lens_pitch_mm(g, 1) > lens_pitch_mm(g, 0) ? 1 : 0;
    const auto by_lens = [&](double z) { return lens_limit_per_mm(s.display(), g, s.theory(), z, eye, coarser); };
    const auto by_pixel = [&](double z) { return pixel_limit_per_mm(s.display(), g, z); };
    DataTable table =
        DataTable::of_rows("dof_resolution", {"depth_mm", "lens_per_mm", "pixel_per_mm", "lens_per_degree", "pixel_per_degree"});
    for (const double z : depths) {
        const double lens = by_lens(z), pixel = by_pixel(z);
        table.add_row({z, lens, pixel, cycles_per_degree(g, lens, z, eye), cycles_per_degree(g, pixel, z, eye)});
    }
    Plot plot{"dof_resolution", "Finest detail by theory", "depth in front of the lenses, mm", "cycles per degree", {}};
    const double at_lenses = s.theory(int(coarser)).lens_sampling_limit_per_mm;
    const double at_lenses_per_degree = cycles_per_degree(g, at_lenses, 0, eye);
    plot.series = {{"of the lens pitch", depths, limits_to_plot(table.columns[3].values, at_lenses_per_degree)},
                   {"of the panel's pixels", depths, limits_to_plot(table.columns[4].values, at_lenses_per_degree)}};
    const double z = g.content_depth_mm, at_content = std::min(by_lens(z), by_pixel(z));
    const FigureValue per_degree = cycles_per_degree(g, at_content, z, eye);
    result.add("resolution.at_the_lenses_per_mm", at_lenses);
    result.add("resolution.at_the_lenses_per_degree", at_lenses_per_degree);
    result.add("resolution.at_the_content_per_mm", at_content);
    result.add("resolution.at_the_content_per_degree", per_degree);
    result.add_line({}, {.label = "Resolution at the content's depth: limit of lenses and pixels",
                         .unit = "cycles per degree",
                         .theory = per_degree,
                         .remark = fmt::format("{:.4g} cycles per mm, {}", at_content, depth_in_words(z))});
    result.tables.push_back(std::move(table));
    result.plots.push_back(std::move(plot));
}

/// Adds the depth of field by likeness, and its curves to `plot`; or why no depth can be shown.
void add_likeness(Subject& s, Result& result, Plot& plot, const DepthRun& run, Job& job) {
    const std::vector<double>& depths = run.depths_mm;
    if (depths.size() < 3) {
        const std::string why = fmt::format(
            "none of the depths that theory calls sharp can be seen from {:.4g} mm: they are among the lenses, at the eye or too "
            "far "
            "behind; --depths-mm chooses others",
            camera_distance_mm(s.display()));
        for (const char* name : {"ssim_rule_mm", "gradient_rule_mm", "most_alike_mm", "by_likeness"})
            result.add(name, FigureValue::none(why));
        result.remarks.push_back("Likeness was not measured: " + why + ".");
        return;
    }
    const double white = s.white_field(job);
    const DepthCurves curves = measure(s, depths, white, job);
    plot.bars.push_back(add_rules(result, "content", curves.content, run));
    add_rules(result, "screen", curves.screen, run);
    result.tables.push_back({"dof", {{"depth_mm", depths}, {"ssim", curves.screen.value}, {"content_ssim", curves.content.value}}});
    plot.series = {{"content", depths, curves.content.value}, {"whole screen", depths, curves.screen.value}};
    result.figures["searched_mm"] = {depths.front(), depths.back()};
}

/// Returns the pieces of a range on either side of the lenses, for a plot.
std::vector<std::array<double, 2>> spans_of(const Json& range) {
    std::vector<std::array<double, 2>> spans;
    for (const char* side : {"behind_mm", "in_front_mm"}) {
        const Json& ends = range.at(side);
        if (ends.is_null() || ends[0].is_null() || ends[1].is_null()) continue;
        spans.push_back({ends[0].is_number() ? ends[0].get<double>() : -infinity, ends[1].get<double>()});
    }
    return spans;
}

}  // namespace

std::int64_t dof_steps(const Subject& s) { return 2 * std::int64_t(dof_depths(s).depths_mm.size()) + 4; }

Result measure_dof(Subject& s, Job& job) {
    const std::vector<double>& asked = s.options().depths_mm;
    for (const double z : asked) refuse_depth_in_lenses(s.geometry(), z, "--depths-mm");
    if (!asked.empty() && asked.size() < 3) throw InputError("--depths-mm", "the depth of field needs three depths or more");
    Result result;
    const Geometry& g = s.geometry();
    add_spot_depths(s, result);
    const double central = s.theory().central_depth_mm + g.rear_principal_mm - g.vertex_plane_mm;
    result.add("central_depth_mm", central);
    Plot plot{"dof",
              "Likeness of the simulated view to the scene",
              "depth of the scene in front of the lenses, mm",
              "SSIM",
              {},
              {{"0.85", least_depth_ssim, false}}};
    for (const auto& [key, label] : {std::pair{"by_lens", "sharp by the lens"}, {"by_pixel", "sharp by the pixel"}})
        plot.bars.push_back({label, spans_of(result.figures.at(key))});
    const DepthRun run = dof_depths(s);
    add_likeness(s, result, plot, run, job);
    if (!plot.series.empty() && central > run.depths_mm.front() && central < run.depths_mm.back())
        plot.marks.push_back({"central depth plane", central});
    if (!plot.series.empty()) {
        result.plots.push_back(std::move(plot));
        add_resolution(s, result, run.depths_mm);
    }
    result.remarks.push_back(
        "Depth of field is stated by three criteria. By the lens: depths at which a point's image is no wider than the lens pitch; "
        "they include the lenses' own plane, where detail is as fine as the lenses. By the pixel: depths at which the lens's blur "
        "is no wider than the image of a panel pixel; that image has no width in the lenses' plane, so no lens is that sharp "
        "there. By likeness: depths at which pictures of the display resemble the content. Depths behind the lenses are negative; "
        "in front of the lenses all ranges end at the viewer.");
    return result;
}

}  // namespace lfdsim
