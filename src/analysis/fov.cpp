#include "analysis/fov.h"

#include "analysis/rules.h"
#include "analysis/views.h"
#include "engine/ahead.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// Simulated views beside photographs of the scene, against the angle of the view. docs/model.md, "Field of view".
namespace lfdsim {
namespace {

constexpr double least_ssim = 0.85, most_slope_per_deg = 0.005;  // the 2019 paper's
constexpr double plateau_deg = 8;

/// What all views share: the scene, its elemental images, the white field.
struct Shown {
    Scene scene;
    const Pyramid& panel;
    double white;
};

/// Over the angles along one axis: SSIM of screen and content, and the photograph's share in the view.
struct Curves {
    Curve screen, content, share;
};

Curves measure(const Subject& subject, const Shown& shown, bool horizontal, const std::vector<double>& angles, Job& job) {
    const auto seen_at = [&](double angle) { return seen_from(subject.display(), horizontal ? angle : 0, horizontal ? 0 : angle); };
    const auto expected_at = [&](double angle) {
        return expected_view(seen_at(angle), subject.geometry(), shown.scene, subject.threads(), job);
    };
    const auto likeness_at = [&](double angle, const ExpectedView& expected) {
        return likeness(expected, seen_at(angle), subject.geometry(), shown.panel, shown.white, subject.threads(), job);
    };
    Curves curves{{angles, {}}, {angles, {}}, {angles, {}}};
    const auto compare = [&](std::size_t k, const ExpectedView& expected) {
        const Likeness l = likeness_at(angles[k], expected);
        curves.screen.value.push_back(l.screen);
        curves.content.value.push_back(l.content);
        curves.share.value.push_back(l.share);
        job.advance(1);
        return true;
    };
    // The CPU photographs the scene from the next angle while a GPU renders and compares.
    make_ahead(
        angles.size(), renders_on_gpu({}), [&](std::size_t k) { return expected_at(angles[k]); }, compare);
    // The noise where it counts: about the edges that theory expects, and between; root mean square.
    const double edge = std::min(0.5 * subject.theory().fov_deg, angles.back());
    const double places[] = {-edge, -0.5 * edge, 0.5 * edge, edge};
    for (const double angle : places) {
        const ExpectedView expected = expected_at(angle);
        const Likeness e = likeness_error(likeness_at(angle, expected), expected, seen_at(angle), subject.geometry(), shown.panel,
                                          shown.white, subject.threads(), job);
        curves.screen.error += e.screen * e.screen / std::size(places);
        curves.content.error += e.content * e.content / std::size(places);
        curves.share.error += e.share * e.share / std::size(places);
        job.advance(2);
    }
    for (Curve* c : {&curves.screen, &curves.content, &curves.share}) c->error = std::sqrt(c->error);
    return curves;
}

/// Which of the two published rules ends the field of view on a side: the nearer one.
std::string bound(const Limit& ssim, const Limit& gradient) {
    if (std::isnan(ssim.at) && std::isnan(gradient.at)) return "none";
    if (std::isnan(gradient.at) || std::abs(ssim.at) <= std::abs(gradient.at)) return "ssim";
    return "gradient";
}

/// A diffuser blends the views within half its angle of the edge.
double window_deg(const Display& d) {
    return std::max(0.5 * plateau_deg, d.diffuser ? std::max(d.diffuser->angle_deg[0], d.diffuser->angle_deg[1]) : 0);
}

struct Rules {
    Rules(const Curve& c, double window_deg)
        : ssim(where_at_least(c, 0, least_ssim)),
          gradient(where_steady(c, 0, most_slope_per_deg)),
          half_way(where_edge(c, 0, plateau_deg, window_deg)),
          json{{"gradient_rule_deg", limits_json(gradient)},
               {"ssim_rule_deg", limits_json(ssim)},
               {"ssim_half_way_deg", limits_json(half_way)},
               {"gradient_rule_error_deg", errors_json(gradient)},
               {"ssim_rule_error_deg", errors_json(ssim)},
               {"ssim_half_way_error_deg", errors_json(half_way)},
               {"bound_by", {bound(ssim.low, gradient.low), bound(ssim.high, gradient.high)}},
               {"ssim_error", c.error}} {}
    Interval ssim, gradient, half_way;
    Json json;
};

void add_axis(Result& result, const std::string& name, const Curves& curves, double fov_deg, double window_deg) {
    const Rules screen(curves.screen, window_deg), content(curves.content, window_deg);
    const Interval edge = where_edge(curves.share, 0, plateau_deg, window_deg);
    Json& json = result.figures[name] = {{"gradient_edge_deg", limits_json(edge)}, {"gradient_edge_error_deg", errors_json(edge)}};
    json.update(screen.json);
    json["content"] = content.json;

    const auto add = [&](const std::string& what, const Interval& measured, std::vector<double> theory, const char* remark) {
        result.findings.push_back(
            {fmt::format("Field of view, {}: {}", name, what), "deg", bounds(measured), std::move(theory), remark});
    };
    add("edge", edge, {-0.5 * fov_deg, 0.5 * fov_deg}, "where the scene's share in the view has fallen half-way");
    add("SSIM half-way down", screen.half_way, {}, "early by up to half the diffuser's angle: SSIM falls with the first ghost");
    add(fmt::format("SSIM of {} or more", least_ssim), screen.ssim, {},
        screen.ssim.empty ? "SSIM is less on axis already: the rule finds nothing" : "the published rule");
    add(fmt::format("slope of {} a degree or less", most_slope_per_deg), screen.gradient, {},
        screen.gradient.empty ? "SSIM is steeper on axis already: the rule finds nothing"
                              : "the published rule, which ends before the edge where steps are of a degree");
}

}  // namespace

std::vector<double> fov_angles_deg(const Subject& subject) {
    if (!subject.options().angles_deg.empty()) return subject.options().angles_deg;
    const double most = std::min(80., std::max(30., std::ceil(0.5 * subject.theory().fov_deg - 1e-6) + 10));
    std::vector<double> angles;
    for (double a = -most; a <= most; ++a) angles.push_back(a);
    return angles;
}

double fov_depth_mm(const Subject& s) {
    const double described = s.geometry().content_depth_mm, edge = std::min(0.5 * s.theory().fov_deg + 2, 80.);
    const double half_screen = 0.5 * std::min(s.geometry().array_width_mm, s.geometry().array_height_mm);
    const double most = half_screen / std::tan(edge * 3.14159265358979323846 / 180);
    return std::clamp(described, -most, most);
}

std::int64_t fov_steps(const Subject& subject) { return 2 * std::int64_t(fov_angles_deg(subject).size()) + 16; }

Result measure_fov(Subject& subject, Job& job) {
    const std::vector<double> angles = fov_angles_deg(subject);
    if (angles.size() < 3 || angles.front() >= 0 || angles.back() <= 0)
        throw InputError("--angles-deg", "the field of view needs three views or more, on both sides of 0");
    const double depth = fov_depth_mm(subject), described = subject.geometry().content_depth_mm;
    std::unique_ptr<ShownPanel> own;
    if (depth != described)
        own = elemental_panel(subject.display(), subject.geometry(), subject.scene().at_depth(depth), subject.threads(), job);
    const Shown shown{subject.scene().at_depth(depth), own ? own->pyramid() : subject.panel(job), subject.white_field(job)};

    Result result;
    const double fov = subject.theory().fov_deg;
    Plot plot{"fov", "Likeness of the simulated view to the scene", "angle of the view, degrees", "SSIM", {}};
    Plot shares{"fov-share", "The scene's share in the view", "angle of the view, degrees", "covariance / variance", {}};
    DataTable table{"fov", {{"angle_deg", angles}}};
    for (const std::string name : {"horizontal", "vertical"}) {
        const Curves curves = measure(subject, shown, name == "horizontal", angles, job);
        add_axis(result, name, curves, fov, window_deg(subject.display()));
        table.columns.push_back({name + "_ssim", curves.screen.value});
        table.columns.push_back({name + "_content_ssim", curves.content.value});
        table.columns.push_back({name + "_share", curves.share.value});
        plot.series.push_back({name + ", screen", angles, curves.screen.value});
        plot.series.push_back({name + ", content", angles, curves.content.value});
        shares.series.push_back({name, angles, curves.share.value});
    }
    for (Plot* p : {&plot, &shares})
        for (const double side : {-0.5, 0.5})
            if (std::abs(side * fov) <= angles.back()) p->marks.push_back({"2 atan(p / 2g)", side * fov});
    plot.marks.push_back({"0.85", least_ssim, false});
    result.figures["theory_fov_deg"] = fov;
    result.figures["content_depth_mm"] = depth;
    result.figures["step_deg"] = angles[1] - angles[0];
    result.tables.push_back(std::move(table));
    result.plots = {std::move(plot), std::move(shares)};
    if (depth != described)
        result.remarks.push_back(
            fmt::format("The scene stands at {:.4g} mm here: at {:.4g} mm, as described, it would not be seen before "
                        "the screen any more from where theory expects the edge.",
                        depth, described));
    result.remarks.push_back(
        "SSIM compares whole pictures: aberration, the diffuser's blur and the panel's pixels lower it everywhere, the repeated "
        "views "
        "beyond the edge suddenly. So the edge tells the geometry, the published thresholds tell how good the picture is.");
    return result;
}

}  // namespace lfdsim
