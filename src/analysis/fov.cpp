#include "analysis/fov.h"

#include "analysis/rules.h"
#include "analysis/views.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// SSIM between simulated views and photographs of the scene, against the angle of the view. docs/model.md, "Field of view".
namespace lfdsim {
namespace {

constexpr double least_ssim = 0.85, most_slope_per_deg = 0.005;  // the 2019 paper's
constexpr double plateau_deg = 8;

struct Axis {
    std::string name;
    std::vector<double> screen, content;
    double screen_error = 0, content_error = 0;
};

Axis measure(Subject& subject, const std::string& name, const std::vector<double>& angles, Job& job) {
    const Pyramid& panel = subject.panel(job);
    const double white = subject.white_field(job);
    const bool horizontal = name == "horizontal";
    const auto seen_at = [&](double angle) { return seen_from(subject.display(), horizontal ? angle : 0, horizontal ? 0 : angle); };
    const auto view_at = [&](double angle) {
        return view_of(seen_at(angle), subject.geometry(), subject.scene(), panel, white, subject.threads(), job);
    };
    Axis axis{name, {}, {}};
    for (const double angle : angles) {
        const Likeness l = likeness(view_at(angle));
        axis.screen.push_back(l.screen);
        axis.content.push_back(l.content);
        job.advance(1);
    }
    // The noise where it counts: about the edges that theory expects, and between.
    const double edge = std::min(0.5 * subject.theory().fov_deg, angles.back());
    double screen = 0, content = 0;
    int count = 0;
    for (const double angle : {-edge, -0.5 * edge, 0.5 * edge, edge}) {
        const Likeness error =
            likeness_error(view_at(angle), seen_at(angle), subject.geometry(), panel, white, subject.threads(), job);
        screen += error.screen * error.screen;
        content += error.content * error.content;
        ++count;
        job.advance(2);
    }
    axis.screen_error = std::sqrt(screen / count);
    axis.content_error = std::sqrt(content / count);
    return axis;
}

struct Rules {
    Interval ssim, gradient, edge;
};

Rules rules(const std::vector<double>& angles, const std::vector<double>& values, double error) {
    const Curve curve{angles, values, error};
    return {where_at_least(curve, 0, least_ssim), where_steady(curve, 0, most_slope_per_deg), where_edge(curve, 0, plateau_deg)};
}

/// Which of the two published rules ends the field of view on a side: the nearer one.
std::string bound(const Limit& ssim, const Limit& gradient) {
    if (std::isnan(ssim.at) && std::isnan(gradient.at)) return "none";
    if (std::isnan(gradient.at) || std::abs(ssim.at) <= std::abs(gradient.at)) return "ssim";
    return "gradient";
}

Json to_json(const Rules& r, double error) {
    return {{"gradient_edge_deg", limits_json(r.edge)},
            {"gradient_rule_deg", limits_json(r.gradient)},
            {"ssim_rule_deg", limits_json(r.ssim)},
            {"gradient_edge_error_deg", errors_json(r.edge)},
            {"gradient_rule_error_deg", errors_json(r.gradient)},
            {"ssim_rule_error_deg", errors_json(r.ssim)},
            {"bound_by", {bound(r.ssim.low, r.gradient.low), bound(r.ssim.high, r.gradient.high)}},
            {"ssim_error", error}};
}

}  // namespace

std::vector<double> fov_angles_deg(const Subject& subject) {
    if (!subject.options().angles_deg.empty()) return subject.options().angles_deg;
    const double most = std::min(80., std::max(30., std::ceil(0.5 * subject.theory().fov_deg) + 12));
    std::vector<double> angles;
    for (double a = -most; a <= most; ++a) angles.push_back(a);
    return angles;
}

std::int64_t fov_steps(const Subject& subject) { return 2 * std::int64_t(fov_angles_deg(subject).size()) + 16; }

Result measure_fov(Subject& subject, Job& job) {
    const std::vector<double> angles = fov_angles_deg(subject);
    if (angles.size() < 3 || angles.front() >= 0 || angles.back() <= 0)
        throw InputError("--angles-deg", "the field of view needs three views or more, and 0 degrees among them or between");
    Result result;
    const double fov = subject.theory().fov_deg;
    Plot plot{"fov", "Likeness of the simulated view to the scene", "angle of the view, degrees", "SSIM", {}};
    DataTable table{"fov", {{"angle_deg", angles}}};
    for (const char* name : {"horizontal", "vertical"}) {
        const Axis axis = measure(subject, name, angles, job);
        const Rules screen = rules(angles, axis.screen, axis.screen_error),
                    content = rules(angles, axis.content, axis.content_error);
        Json& json = result.figures[name] = to_json(screen, axis.screen_error);
        json["content"] = to_json(content, axis.content_error);
        result.findings.push_back({fmt::format("Field of view, {}: edge of the likeness", name),
                                   "deg",
                                   bounds(screen.edge),
                                   {-0.5 * fov, 0.5 * fov},
                                   "half-way down from the middle to the least beyond the steepest step"});
        result.findings.push_back(
            {fmt::format("Field of view, {}: SSIM of {} or more", name, least_ssim),
             "deg",
             bounds(screen.ssim),
             {},
             screen.ssim.empty ? "SSIM is less on axis already: the rule finds nothing" : "the published rule"});
        result.findings.push_back({fmt::format("Field of view, {}: slope of {} a degree or less", name, most_slope_per_deg),
                                   "deg",
                                   bounds(screen.gradient),
                                   {},
                                   screen.gradient.empty
                                       ? "SSIM is steeper on axis already: the rule finds nothing"
                                       : "the published rule, which ends before the edge where steps are of a degree"});
        table.columns.push_back({fmt::format("{}_ssim", name), axis.screen});
        table.columns.push_back({fmt::format("{}_content_ssim", name), axis.content});
        plot.series.push_back({fmt::format("{}, screen", name), angles, axis.screen});
        plot.series.push_back({fmt::format("{}, content", name), angles, axis.content});
    }
    for (const double side : {-0.5, 0.5})
        if (std::abs(side * fov) <= angles.back()) plot.marks.push_back({"2 atan(p / 2g)", side * fov});
    plot.marks.push_back({"0.85", least_ssim, false});
    result.figures["theory_fov_deg"] = fov;
    result.figures["step_deg"] = angles[1] - angles[0];
    result.tables.push_back(std::move(table));
    result.plots.push_back(std::move(plot));
    result.remarks.push_back(
        "SSIM compares whole pictures: aberration, the diffuser's blur and the panel's pixels lower it everywhere, the repeated "
        "views "
        "beyond the edge suddenly. So the edge tells the geometry, the published thresholds tell how good the picture is.");
    return result;
}

}  // namespace lfdsim
