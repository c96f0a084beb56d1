#include "analysis/dof.h"

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

constexpr double least_ssim = 0.85, most_slope_per_mm = 0.02 / 10;  // the 2019 paper's, which counts in centimetres

/// The central depth plane from the vertex plane.
double central_depth_mm(const Subject& s) {
    return s.theory().central_depth_mm + s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
}

Json both(const std::array<double, 2>& a) {
    Json json = Json::array();
    for (const double x : a) json.push_back(std::isfinite(x) ? Json(x) : Json());
    return json;
}

}  // namespace

std::vector<double> dof_depths_mm(const Subject& s) {
    if (!s.options().depths_mm.empty()) return s.options().depths_mm;
    const double middle = central_depth_mm(s), sign = middle < 0 ? -1 : 1;
    const double first = std::isfinite(middle) ? std::max(10., std::abs(middle) - 150) : 10;
    std::vector<double> depths;
    for (int k = 0; k < 31; ++k) depths.push_back(sign * (first + 10 * k));
    std::sort(depths.begin(), depths.end());
    return depths;
}

std::int64_t dof_steps(const Subject& s) { return 2 * std::int64_t(dof_depths_mm(s).size()) + 4; }

Result measure_dof(Subject& s, Job& job) {
    const std::vector<double> depths = dof_depths_mm(s);
    for (const double z : depths) refuse_depth_in_lenses(s.geometry(), z, "--depths-mm");
    if (depths.size() < 3) throw InputError("--depths-mm", "the depth of field needs three depths or more");
    const double middle = central_depth_mm(s), centre = std::isfinite(middle) ? middle : depths.back();
    const double white = s.white_field(job);
    Curve screen{depths, {}}, content{depths, {}};
    for (std::size_t k = 0; k < depths.size(); ++k) {
        const Scene scene = s.scene().at_depth(depths[k]);
        const auto panel = elemental_panel(s.display(), s.geometry(), scene, s.threads(), job);
        const ExpectedView expected = expected_view(s.display(), s.geometry(), scene, s.threads(), job);
        const Likeness l = likeness(expected, s.display(), s.geometry(), panel->pyramid(), white, s.threads(), job);
        screen.value.push_back(l.screen);
        content.value.push_back(l.content);
        job.advance(2);
        const bool nearest = k + 1 == depths.size() || std::abs(depths[k] - centre) <= std::abs(depths[k + 1] - centre);
        if (!nearest || screen.error > 0) continue;
        const Likeness error = likeness_error(l, expected, s.display(), s.geometry(), panel->pyramid(), white, s.threads(), job);
        screen.error = error.screen;
        content.error = error.content;
        job.advance(4);
    }

    Result result;
    const auto say = [&](const char* where, const Curve& curve) {
        const Interval by_ssim = where_at_least(curve, centre, least_ssim), steady = where_steady(curve, centre, most_slope_per_mm);
        const auto best = std::max_element(curve.value.begin(), curve.value.end()) - curve.value.begin();
        return std::tuple(by_ssim, steady,
                          Json{{"ssim_rule_mm", limits_json(by_ssim)},
                               {"gradient_rule_mm", limits_json(steady)},
                               {"ssim_rule_error_mm", errors_json(by_ssim)},
                               {"gradient_rule_error_mm", errors_json(steady)},
                               {"most_alike_mm", depths[std::size_t(best)]},
                               {"ssim_error", curve.error},
                               {"region", where}});
    };
    const auto [by_ssim, steady, json] = say("screen", screen);
    result.figures = json;
    result.figures["content"] = std::get<2>(say("content", content));
    const double from_vertex = s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    const std::array<double, 2> paraxial{s.theory().depth_range_mm[0] + from_vertex, s.theory().depth_range_mm[1] + from_vertex};
    result.figures["paraxial_mm"] = both(paraxial);
    result.figures["central_depth_mm"] = std::isfinite(middle) ? Json(middle) : Json();
    result.findings.push_back(
        {fmt::format("Depth of field: SSIM of {} or more", least_ssim),
         "mm",
         bounds(by_ssim),
         {},
         by_ssim.empty ? "SSIM is less at the central depth plane already: the rule finds nothing" : "the published rule"});
    result.findings.push_back(
        {"Depth of field: slope of 0.02 a centimetre or less",
         "mm",
         bounds(steady),
         {},
         steady.empty ? "SSIM is steeper at the central depth plane already: the rule finds nothing" : "the published rule"});
    const std::array<double, 2> traced = add_spot_depths(s, result);
    result.tables.push_back({"dof", {{"depth_mm", depths}, {"ssim", screen.value}, {"content_ssim", content.value}}});
    Plot plot{"dof",
              "Likeness of the simulated view to the scene",
              "depth of the scene before the lenses, mm",
              "SSIM",
              {{"screen", depths, screen.value}, {"content", depths, content.value}},
              {{"0.85", least_ssim, false}}};
    const auto mark = [&](const char* label, double z) {
        if (z >= depths.front() && z <= depths.back()) plot.marks.push_back({label, z});
    };
    mark("central depth plane", middle);
    mark("paraxial", paraxial[0]);
    mark("paraxial", paraxial[1]);
    mark("spot", traced[0]);
    mark("spot", traced[1]);
    result.plots.push_back(std::move(plot));
    result.remarks.push_back(
        "A depth of field by likeness and one by spot size are different things: SSIM falls off slowly and peaks between the "
        "lenses and "
        "the central depth plane, since nearer scenes are sampled by more pixels' rays. Both are shown, neither is fitted to the "
        "other.");
    return result;
}

}  // namespace lfdsim
