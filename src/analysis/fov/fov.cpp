// The measure of the field of view: by geometry, and by the likeness of simulated views and photographs of the scene over the
// angle of the view. docs/measures.md, "Field of view".

#include "analysis/fov/fov.h"

#include "analysis/core/elemental_panel.h"
#include "analysis/core/estimate.h"
#include "analysis/core/figure_json.h"
#include "analysis/fov/fov_views.h"
#include "base/constants.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double least_view_ssim = 0.85, most_slope_per_deg = 0.005;  // the 2019 paper's

/// Returns which published rule ends the field of view on a side: the one that ends nearer to the middle.
std::string bound(const Limit& ssim, const Limit& gradient) {
    if (std::isnan(ssim.at) && std::isnan(gradient.at)) return "none";
    if (std::isnan(gradient.at) || std::abs(ssim.at) <= std::abs(gradient.at)) return "ssim";
    return "gradient";
}

/// Returns the range as an interval about 0.
Interval interval(const OwnRange& r) {
    return known({{r.at[0], r.error[0], r.missing[0]}, {r.at[1], r.error[1], r.missing[1]}}, 0);
}

/// The intervals in which a curve of SSIM meets the published criteria, and that in which it is above half of its fall.
struct SsimIntervals {
    Interval ssim, gradient, half_way;
    double error;  // standard deviation of the curve's values

    SsimIntervals(const Curve& c, const Falls& expected)
        : ssim(where_at_least(c, 0, least_view_ssim)),
          gradient(where_steady(c, 0, most_slope_per_deg)),
          half_way(where_it_falls(c, expected)),
          error(c.error) {}
};

/// Adds the intervals of a curve under a path that ends with a dot.
void add_rules(Result& result, Json& json, const std::string& path, const SsimIntervals& rules) {
    result.add(path + "ssim_rule_deg", figure_of(rules.ssim));
    result.add(path + "gradient_rule_deg", figure_of(rules.gradient));
    result.add(path + "ssim_half_way_deg", figure_of(rules.half_way));
    json["bound_by"] = {bound(rules.ssim.low, rules.gradient.low), bound(rules.ssim.high, rules.gradient.high)};
    json["ssim_error"] = rules.error;
}

/// Adds the edges by geometry along one axis; `way` is the axis in words.
void add_geometry(Result& result, const std::string& name, const std::string& way, const OwnRange& lenses, const OwnRange& diffused,
                  const FigureValue& theory) {
    result.add(name + ".own_lens_deg", figure_of(interval(lenses)),
               {.label = fmt::format("Field of view, {}", way),
                .unit = "deg",
                .theory = theory,
                .remark = "up to the angles at which half of the light, of lenses whose whole image lies on the panel, comes from "
                          "their own images"});
    result.add(name + ".own_lens_with_diffuser_deg", figure_of(interval(diffused)),
               {.label = fmt::format("Field of view, {}: with the diffuser", way),
                .unit = "deg",
                .theory = theory,
                .remark = "up to the same share of light, scattered by the diffuser"});
}

/// Adds the edges by likeness along one axis. They are searched for where geometry has the edge with the diffuser, or theory.
void add_likeness(Result& result, const std::string& name, const std::string& way, const AngleCurves& curves,
                  const OwnRange& diffused, double edge_deg, double reach_deg) {
    const auto line = [&](const std::string& what, const std::string& remark) {
        return FigureLine{.label = fmt::format("Likeness, {}: {}", way, what), .unit = "deg", .remark = remark};
    };
    const double low = diffused.at[0], high = diffused.at[1];
    const Falls expected{std::isnan(low) ? -edge_deg : low, std::isnan(high) ? edge_deg : high, reach_deg};
    FigureLine edge = line("edge", "where the scene's share in the view has fallen half-way; beside it the edge by geometry");
    edge.theory = std::vector{expected.low, expected.high};
    result.add(name + ".gradient_edge_deg", figure_of(where_it_falls(curves.share, expected)), edge);
    const SsimIntervals content(curves.content, expected), screen(curves.screen, expected);
    Json& json = result.figures[name];
    add_rules(result, json, name + ".", content);
    add_rules(result, json["content"], name + ".content.", content);
    add_rules(result, json["screen"], name + ".screen.", screen);
    const auto add_line = [&](const Interval& found, const std::string& what, const std::string& remark) {
        result.add_line(figure_of(found), line(what, remark));
    };
    add_line(content.half_way, "SSIM of the content fallen half-way",
             "too small by up to half the diffuser's angle: SSIM falls with the first ghost");
    add_line(content.ssim, fmt::format("SSIM of the content {} or more", least_view_ssim),
             "the published criterion, on the content's rectangle");
    add_line(screen.ssim, fmt::format("SSIM of the whole screen {} or more", least_view_ssim),
             "with the background, which raises SSIM where it is black in both pictures");
    add_line(content.gradient, fmt::format("slope of the content's SSIM of {} per degree or less", most_slope_per_deg),
             "the published criterion, which ends before the edge with steps of one degree");
    // The likeness of the view nearest to the axis, usually on it
    const std::vector<double>& angles = curves.content.at;
    const auto middle = std::ranges::min_element(angles, {}, [](double a) { return std::abs(a); });
    const auto at_middle = [&](const Curve& c) { return Estimate{c.value[std::size_t(middle - angles.begin())], c.error}; };
    result.add(name + ".middle_ssim", at_middle(curves.content),
               {.label = fmt::format("Likeness, {}: SSIM of the content at {:.3g} degrees", way, *middle),
                .remark = fmt::format("{:.4g} for the whole screen, raised by a background that is black in both pictures",
                                      at_middle(curves.screen).value)});
    result.add(name + ".content.middle_ssim", at_middle(curves.content));
    result.add(name + ".screen.middle_ssim", at_middle(curves.screen));
}

/// Returns the largest shift to one side, degrees, of the edges by likeness against those by geometry: the sum of both ends.
double most_aside_deg(const Json& figures) {
    double most = 0;
    for (const char* axis : {"horizontal", "vertical"}) {
        if (figures.at(axis).is_null()) continue;
        const auto aside = [&](const char* name) {
            const Json& at = figures.at(axis).at(name);
            return at[0].is_number() && at[1].is_number() ? at[0].get<double>() + at[1].get<double>() : 0;
        };
        for (const char* name : {"gradient_edge_deg", "ssim_half_way_deg", "ssim_rule_deg", "gradient_rule_deg"})
            most = std::max(most, std::abs(aside(name) - aside("own_lens_with_diffuser_deg")));
    }
    return most;
}

/// Adds the eyebox, the extent of the field of view in the plane at the eye's distance, width and height, mm; by theory E p'/g,
/// upwards times the image's height per p'.
void add_eyebox(Result& result, const Subject& s, const std::array<OwnRange, 2>& ranges) {
    const double height = height_per_pitch(s.geometry());
    const auto theory = [&](std::size_t axis) {
        return (s.viewing_distance_mm() - s.geometry().rear_principal_mm) * s.theory().along[axis].elemental_pitch_mm /
               s.theory().gap_mm * (axis == 1 ? height : 1);
    };
    std::vector<double> size, error;
    std::string missing;
    for (std::size_t axis = 0; axis < std::size_t(imaging_axes(s.display().array)); ++axis) {
        const OwnRange& r = ranges[axis];
        const std::string why = r.missing[0].empty() ? r.missing[1] : r.missing[0];
        size.push_back(r.at[1] - r.at[0]);
        error.push_back(std::hypot(r.error[0], r.error[1]));
        result.add_line(
            {Estimate{size.back(), error.back()}, why},
            {.label = axis == 0 ? "Eyebox, width" : "Eyebox, height",
             .unit = "mm",
             .theory = theory(axis),
             .remark = axis == 1 && height > 1 ? "theory: from corner to corner of the hexagons' images; the lenses' blur removes "
                                                 "light from the corners first"
                                               : fmt::format("where an eye {:.4g} mm from the panel sees lenses' own images",
                                                             s.viewing_distance_mm())});
        if (!why.empty()) missing = why;
    }
    result.figures["eyebox_mm"] = numbers_json(size);
    result.figures["eyebox_mm_error"] = numbers_json(error);
    result.figures["theory_eyebox_mm"] =
        height > 1 ? numbers_json({theory(0), theory(1)}) : axes_json(s.display().array, theory(0), theory(1));
    if (!missing.empty()) result.note("eyebox_mm", missing);
}

}  // namespace

std::int64_t fov_steps(const Subject& subject) {
    return 2 * std::int64_t(fov_angles_deg(subject).size()) + 16 + geometric_fov_steps(subject);
}

Result measure_fov(Subject& subject, Job& job) {
    const Display& display = subject.display();
    const double distance = checked_viewing_distance_mm(subject);
    const std::vector<double> angles = fov_angles_deg(subject);
    if (angles.size() < 3 || angles.front() >= 0 || angles.back() <= 0)
        throw InputError("--angles-deg", "the field of view needs three views or more, on both sides of 0");
    if (const double most = arc(display, subject.geometry(), distance, 0).most; std::max(-angles.front(), angles.back()) > most)
        throw InputError("--angles-deg",
                         fmt::format("from {:.4g} degrees on an eye {:.4g} mm from the panel's centre is inside the "
                                     "display; give less",
                                     most, distance));
    // Theory and geometry
    Result result;
    const double edge[] = {theory_edge_deg(subject, 0), is_strips(display.array) ? nan : theory_edge_deg(subject, 1)};
    const std::array<AxisTheory, 2>& along = subject.theory().along;
    result.figures["viewing_distance_mm"] = distance;
    result.figures["theory_fov_deg"] = axes_json(display.array, along[0].fov_deg, along[1].fov_deg);
    result.figures["theory_fov_elemental_deg"] = axes_json(display.array, along[0].fov_elemental_deg, along[1].fov_elemental_deg);
    result.figures["theory_edge_deg"] = axes_json(display.array, edge[0], edge[1]);
    const GeometricFov geometric = geometric_fov(subject, job);
    add_eyebox(result, subject, geometric.eyebox);
    result.figures["lenses_with_whole_images"] = geometric.whole_images;

    // Views of the scene, at a depth at which it can be seen from all of the angles
    const double depth = fov_scene_depth_mm(subject, angles), described = subject.geometry().content_depth_mm;
    std::unique_ptr<ShownPanel> own;
    if (depth != described)
        own = elemental_panel(display, subject.geometry(), subject.scene().at_depth(depth), subject.threads(), job);
    const ShownEdge shown{subject.scene().at_depth(depth), own ? own->summed() : subject.panel(job), subject.white_field(job)};
    Plot plot{"fov", "Likeness of the simulated view to the scene", "angle of the view, degrees", "SSIM", {}};
    Plot shares{"fov-share", "The scene's share in the view", "angle of the view, degrees", "covariance / variance", {}};
    DataTable table{"fov", {{"angle_deg", angles}}};
    if (is_strips(display.array)) result.add("vertical", FigureValue::none("strips show the same to an eye that moves along them"));
    for (int axis = 0; axis < imaging_axes(display.array); ++axis) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        const std::string way = is_strips(display.array) ? "across the strips" : name;  // the arc's direction
        const OwnRange &lenses = geometric.lenses[std::size_t(axis)], &diffused = geometric.diffused[std::size_t(axis)];
        const AngleCurves curves = angle_curves(subject, shown, axis, angles, job);
        // Theory is of an image p' high; that of a hexagon has a corner above its middle, beyond that.
        const bool corner = axis == 1 && height_per_pitch(subject.geometry()) > 1;
        add_geometry(result, name, way, lenses, diffused, corner ? FigureValue() : std::vector{-edge[axis], edge[axis]});
        add_likeness(result, name, way, curves, diffused, edge[axis], fades_over_deg(subject, axis));
        table.columns.push_back({name + "_ssim", curves.screen.value});
        table.columns.push_back({name + "_content_ssim", curves.content.value});
        table.columns.push_back({name + "_share", curves.share.value});
        plot.series.push_back({way + ", content", angles, curves.content.value});
        plot.series.push_back({way + ", whole screen", angles, curves.screen.value});
        shares.series.push_back({way, angles, curves.share.value});
    }
    for (Plot* p : {&plot, &shares})
        for (const double at : geometric.lenses[0].at)
            if (std::abs(at) <= angles.back()) p->marks.push_back({"edge by geometry", at});
    plot.marks.push_back({"0.85", least_view_ssim, false});
    result.figures["content_depth_mm"] = depth;
    result.figures["step_deg"] = angles[1] - angles[0];
    result.tables.push_back(std::move(table));
    result.plots = {std::move(plot), std::move(shares)};
    if (const double aside = most_aside_deg(result.figures); aside > 0.5 * (angles[1] - angles[0]))
        result.remarks.push_back(
            fmt::format("The edges by likeness lie up to {:.2g} degrees farther out on one side than on the other, more than those "
                        "by geometry: "
                        "the scene is not its own mirror image, and different parts of it are compared on either side.",
                        aside));
    if (const double exact = along[0].fov_exact_deg; std::abs(exact / along[0].fov_elemental_deg - 1) > 0.02)
        result.remarks.push_back(fmt::format(
            "Theory is paraxial. By Snell's law the layers on the panel bend the steep rays so that an elemental image is "
            "seen over {:.4g} degrees, not {:.4g}.",
            exact, along[0].fov_elemental_deg));
    if (depth != described)
        result.remarks.push_back(
            fmt::format("The scene is at {:.4g} mm here: at {:.4g} mm, as described, it would not be seen against the screen from "
                        "all of these positions, or an eye would be inside it.",
                        depth, described));
    result.remarks.push_back(
        "The field of view is the geometric one: it depends on no content, picture or step. SSIM is evaluated on the rectangle "
        "around the content, because a background that is black in both pictures raises the SSIM of the whole screen. Aberration, "
        "the diffuser's blur and the panel's pixels lower SSIM at all angles; beyond the edge the repeated views lower it "
        "suddenly. Its edge should therefore lie where geometry puts it, while the published thresholds rate the picture's "
        "quality.");
    return result;
}

}  // namespace lfdsim
