#include "analysis/dof.h"

#include "analysis/dof_depths.h"
#include "analysis/rules.h"
#include "analysis/spot_depth.h"
#include "analysis/views.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// SSIM between the simulated view and a photograph of the scene, against the scene's depth; beside it the depths of field by spot
// size and diffraction. docs/model.md, "Depth of field".
namespace lfdsim {
namespace {

constexpr double least_depth_ssim = 0.85, most_slope_per_mm = 0.02 / 10;  // the 2019 paper's, which counts in centimetres

/// Places count from the vertex plane, theory's from the rear principal plane.
double from_vertex_mm(const Subject& s) { return s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm; }

/// Of the depths measured, the one nearest to the central depth plane in inverse distance; and its run.
struct Centre {
    std::size_t run = 0, place = 0;
};

Centre centre(const Subject& s, const std::vector<DepthRun>& runs) {
    const double wanted = 0.5 * (s.theory().depth_near_per_mm + s.theory().depth_far_per_mm);
    Centre best;
    double least = INFINITY;
    for (std::size_t r = 0; r < runs.size(); ++r)
        for (std::size_t k = 0; k < runs[r].depths_mm.size(); ++k)
            if (const double away = std::abs(1 / (runs[r].depths_mm[k] - from_vertex_mm(s)) - wanted); away < least)
                least = away, best = {r, k};
    return best;
}

/// SSIM of screen and of content along one run.
struct DepthCurves {
    Curve screen, content;
};

/// `noisy`: the place where the noise is measured; none if beyond the run's.
DepthCurves measure(Subject& s, const std::vector<double>& depths, std::size_t noisy, double white, Job& job) {
    DepthCurves curves{{depths, {}}, {depths, {}}};
    for (std::size_t k = 0; k < depths.size(); ++k) {
        const ContentScene scene = s.scene().at_depth(depths[k]);
        const auto panel = elemental_panel(s.display(), s.geometry(), scene, s.threads(), job);
        const ExpectedView expected = expected_view(s.display(), s.geometry(), scene, s.threads(), job);
        const Likeness l = likeness(expected, s.display(), s.geometry(), panel->pyramid(), white, s.rendering(), job);
        curves.screen.value.push_back(l.screen);
        curves.content.value.push_back(l.content);
        job.advance(2);
        if (k != noisy) continue;
        const Likeness error = likeness_error(l, expected, s.display(), s.geometry(), panel->pyramid(), white, s.rendering(), job);
        curves.screen.error = error.screen;
        curves.content.error = error.content;
        job.advance(4);
    }
    return curves;
}

/// Adds, to limits that were not found, why the run ends.
Interval explained(Interval i, const DepthRun& run) {
    if (i.empty) return i;
    if (!i.low.missing.empty()) i.low.missing += ": " + run.why_low;
    if (!i.high.missing.empty()) i.high.missing += ": " + run.why_high;
    return i;
}

void add_rules(Result& result, const std::string& region, const Curve& curve, const DepthRun& run, double centre_mm) {
    const bool screen = region == "screen";
    const Interval by_ssim = explained(where_at_least(curve, centre_mm, least_depth_ssim), run),
                   steady = explained(where_steady(curve, centre_mm, most_slope_per_mm), run);
    const auto best = std::max_element(curve.value.begin(), curve.value.end()) - curve.value.begin();
    Json json{{"most_alike_mm", curve.at[std::size_t(best)]}, {"ssim_error", curve.error}, {"region", region}};
    add_limits(result, json, screen ? "" : "content.", "ssim_rule_mm", by_ssim);
    add_limits(result, json, screen ? "" : "content.", "gradient_rule_mm", steady);
    if (!screen) {
        result.figures["content"] = std::move(json);
        return;
    }
    result.figures.update(json);
    const auto add = [&](const std::string& what, const Interval& i) {
        result.findings.push_back(finding("Depth of field: " + what, "mm", i, {}, "the published rule"));
    };
    add(fmt::format("SSIM of {} or more", least_depth_ssim), by_ssim);
    add("slope of 0.02 a centimetre or less", steady);
}

void add_likeness(Subject& s, Result& result, Plot& plot, Job& job) {
    const std::vector<DepthRun> runs = dof_depths(s);
    if (runs.empty()) {
        const std::string why = fmt::format(
            "none of the depths within twice theory's depth of field can be seen from {:.4g} mm: they are among the lenses, "
            "at the eye or too far behind; --depths-mm chooses others",
            eye_distance_mm(s.display()));
        for (const char* name : {"ssim_rule_mm", "gradient_rule_mm", "most_alike_mm"}) {
            result.figures[name] = Json();
            result.note(name, why);
        }
        result.remarks.push_back("Likeness was not measured: " + why + ".");
        return;
    }
    const Centre middle = centre(s, runs);
    const double white = s.white_field(job);
    DataTable table{"dof", {{"depth_mm", {}}, {"ssim", {}}, {"content_ssim", {}}}};
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const std::vector<double>& depths = runs[r].depths_mm;
        const DepthCurves curves = measure(s, depths, r == middle.run ? middle.place : depths.size(), white, job);
        if (r == middle.run) {
            add_rules(result, "screen", curves.screen, runs[r], depths[middle.place]);
            add_rules(result, "content", curves.content, runs[r], depths[middle.place]);
        }
        const std::vector<double>* columns[] = {&depths, &curves.screen.value, &curves.content.value};
        for (std::size_t c = 0; c < 3; ++c)
            table.columns[c].values.insert(table.columns[c].values.end(), columns[c]->begin(), columns[c]->end());
        const std::string where = runs.size() == 1 ? "" : r == 0 ? ", behind the lenses" : ", in front of the lenses";
        plot.series.push_back({"screen" + where, depths, curves.screen.value});
        plot.series.push_back({"content" + where, depths, curves.content.value});
    }
    result.figures["searched_mm"] = Json::array();
    for (const DepthRun& run : runs) result.figures["searched_mm"].push_back({run.depths_mm.front(), run.depths_mm.back()});
    result.tables.push_back(std::move(table));
}

}  // namespace

std::int64_t dof_steps(const Subject& s) {
    std::size_t depths = 0;
    for (const DepthRun& run : dof_depths(s)) depths += run.depths_mm.size();
    return 2 * std::int64_t(depths) + 4;
}

Result measure_dof(Subject& s, Job& job) {
    const std::vector<double>& asked = s.options().depths_mm;
    for (const double z : asked) refuse_depth_in_lenses(s.geometry(), z, "--depths-mm");
    if (!asked.empty() && asked.size() < 3) throw InputError("--depths-mm", "the depth of field needs three depths or more");
    Result result;
    Plot plot{"dof",
              "Likeness of the simulated view to the scene",
              "depth of the scene in front of the lenses, mm",
              "SSIM",
              {},
              {{"0.85", least_depth_ssim, false}}};
    add_likeness(s, result, plot, job);
    const double from_vertex = from_vertex_mm(s), middle = s.theory().central_depth_mm + from_vertex;
    const double near = depth_mm(s.theory().depth_near_per_mm) + from_vertex,
                 far = depth_mm(s.theory().depth_far_per_mm) + from_vertex;
    result.figures["paraxial_mm"] = numbers_json({near, far});
    result.figures["central_depth_mm"] = number_json(middle);
    const SharpDepths traced = add_spot_depths(s, result);
    const auto mark = [&](const char* label, double z) {
        for (const Series& series : plot.series)
            if (z >= series.x.front() && z <= series.x.back()) return plot.marks.push_back({label, z});
    };
    mark("central depth plane", middle);
    mark("paraxial", near);
    mark("paraxial", far);
    mark("spot", depth_mm(traced.near_per_mm) + from_vertex);
    mark("spot", depth_mm(traced.far_per_mm) + from_vertex);
    if (!plot.series.empty()) result.plots.push_back(std::move(plot));
    result.remarks.push_back(
        "A depth of field by likeness and one by spot size are different things: SSIM falls off slowly and peaks between the "
        "lenses "
        "and the central depth plane, since nearer scenes are sampled by more pixels' rays. Both are shown, neither is fitted to "
        "the "
        "other. Depths by spot size are one interval of 1/z: where it goes through infinity, sharp depths lie beyond both ends.");
    return result;
}

}  // namespace lfdsim
