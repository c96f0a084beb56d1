#include "analysis/fov/fov.h"

#include "analysis/crosstalk/slope_spread.h"
#include "analysis/fov/elemental_fov.h"
#include "analysis/fov/thresholds.h"
#include "analysis/pictures/views.h"
#include "base/constants.h"
#include "base/vec.h"
#include "engine/views/pipelined.h"
#include "geometry/screen.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// The field of view by geometry; and by simulated views beside photographs of the scene, against the angle of the view.
// docs/model.md, "Field of view".
namespace lfdsim {
namespace {

constexpr double least_view_ssim = 0.85, most_slope_per_deg = 0.005;  // the 2019 paper's
constexpr double wanted_error_deg = 0.05;

double theory_edge_deg(const Subject& s, int axis) { return arc_edge_deg(s.geometry(), s.theory(), s.viewing_distance_mm(), axis); }
double widest_edge_deg(const Subject& s) {
    double widest = 0;
    for (int axis = 0; axis < imaging_axes(s.display().array); ++axis) widest = std::max(widest, theory_edge_deg(s, axis));
    return widest;
}
constexpr const char* strips_upright = "strips show the same from above and from below";

/// What all views share: the scene, its elemental images, the white field.
struct ShownEdge {
    ContentScene scene;
    const SummedPanel& panel;
    double white;
};

/// Over the angles along one axis: SSIM of screen and content, and the photograph's share in the view.
struct AngleCurves {
    Curve screen, content, share;
};

AngleCurves measure(const Subject& subject, const ShownEdge& shown, int axis, const std::vector<double>& angles, Job& job) {
    const EyePath path = arc(subject.display(), subject.geometry(), subject.viewing_distance_mm(), axis);
    const auto seen_at = [&](double angle) { return seen_by(subject.display(), path.eye(angle)); };
    const auto expected_at = [&](double angle) {
        return expected_view(seen_at(angle), subject.geometry(), shown.scene, subject.threads(), job);
    };
    const auto likeness_at = [&](double angle, const ExpectedView& expected) {
        return likeness(expected, seen_at(angle), subject.geometry(), shown.panel, shown.white, subject.rendering(), job);
    };
    AngleCurves curves{{angles, {}}, {angles, {}}, {angles, {}}};
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
        angles.size(), renders_on_gpu(subject.rendering()), [&](std::size_t k) { return expected_at(angles[k]); }, compare);
    // The noise where it matters: at the edges that theory predicts, and between; root mean square.
    const double edge = std::min(theory_edge_deg(subject, axis), angles.back());
    const double places[] = {-edge, -0.5 * edge, 0.5 * edge, edge};
    for (const double angle : places) {
        const ExpectedView expected = expected_at(angle);
        const Likeness e = likeness_error(likeness_at(angle, expected), expected, seen_at(angle), subject.geometry(), shown.panel,
                                          shown.white, subject.rendering(), job);
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

/// The edges that the geometry of rays gives along one axis.
struct Geometric {
    OwnRange lenses, diffused;
};

Interval interval(const OwnRange& r) {
    return known({{r.at[0], r.error[0], r.missing[0]}, {r.at[1], r.error[1], r.missing[1]}}, 0);
}

/// How far on either side of its edge the field of view fades, degrees: by the lens aperture and the diffuser, and where images are
/// made for another distance by the lenses across.
double fades_over_deg(const Subject& s, int axis) {
    const double rear = s.geometry().rear_principal_mm, eye = s.viewing_distance_mm() - rear;
    const double size = screen_size_mm(s.geometry())[std::size_t(axis)];
    const double across = size * std::abs(1 / eye - 1 / (s.display().content.viewing_distance_mm - rear));
    return std::atan(0.5 * (SlopeSpread(s, eye, axis).width() + across)) / degree;
}

/// Where a curve of SSIM keeps the published rules, and where it falls half-way.
struct Rules {
    Interval ssim, gradient, half_way;
    double error;  // of the curve

    Rules(const Curve& c, const Falls& expected)
        : ssim(where_at_least(c, 0, least_view_ssim)),
          gradient(where_steady(c, 0, most_slope_per_deg)),
          half_way(where_it_falls(c, expected)),
          error(c.error) {}
};

void add_rules(Result& result, Json& json, const std::string& path, const Rules& rules) {
    result.add(path + "ssim_rule_deg", figure_of(rules.ssim));
    result.add(path + "gradient_rule_deg", figure_of(rules.gradient));
    result.add(path + "ssim_half_way_deg", figure_of(rules.half_way));
    json["bound_by"] = {bound(rules.ssim.low, rules.gradient.low), bound(rules.ssim.high, rules.gradient.high)};
    json["ssim_error"] = rules.error;
}

void add_geometry(Result& result, const std::string& name, const std::string& way, const Geometric& g, const FigureValue& theory) {
    result.add(name + ".own_lens_deg", figure_of(interval(g.lenses)),
               {.label = fmt::format("Field of view, {}", way),
                .unit = "deg",
                .theory = theory,
                .remark = "of the light from lenses whose whole image lies on the panel, half comes from their own images"});
    result.add(name + ".own_lens_with_diffuser_deg", figure_of(interval(g.diffused)),
               {.label = fmt::format("Field of view, {}: with the diffuser", way),
                .unit = "deg",
                .theory = theory,
                .remark = "the same light, turned by the diffuser"});
}

void add_likeness(Result& result, const std::string& name, const std::string& way, const AngleCurves& curves, const Geometric& g,
                  double edge_deg, double reach_deg) {
    const auto line = [&](const std::string& what, const std::string& remark) {
        return FigureLine{.label = fmt::format("Likeness, {}: {}", way, what), .unit = "deg", .remark = remark};
    };
    const double low = g.diffused.at[0], high = g.diffused.at[1];
    const Falls expected{std::isnan(low) ? -edge_deg : low, std::isnan(high) ? edge_deg : high, reach_deg};
    FigureLine edge = line("edge", "where the scene's share in the view falls half-way; beside it the edge by geometry");
    edge.theory = std::vector{expected.low, expected.high};
    result.add(name + ".gradient_edge_deg", figure_of(where_it_falls(curves.share, expected)), edge);
    const Rules content(curves.content, expected), screen(curves.screen, expected);
    Json& json = result.figures[name];
    add_rules(result, json, name + ".", content);
    add_rules(result, json["content"], name + ".content.", content);
    add_rules(result, json["screen"], name + ".screen.", screen);
    const auto add_line = [&](const Interval& found, const std::string& what, const std::string& remark) {
        result.add_line(figure_of(found), line(what, remark));
    };
    add_line(content.half_way, "SSIM of the content half-way down",
             "early by up to half the diffuser's angle: SSIM falls with the first ghost");
    add_line(content.ssim, fmt::format("SSIM of the content {} or more", least_view_ssim),
             "the published rule, where the content is");
    add_line(screen.ssim, fmt::format("SSIM of the whole screen {} or more", least_view_ssim),
             "the same with the background, which raises it where it is black in both pictures");
    add_line(content.gradient, fmt::format("slope of the content's SSIM of {} a degree or less", most_slope_per_deg),
             "the published rule, which ends before the edge where steps are of a degree");
    // The views that are nearest to the axis, mostly on it.
    const std::vector<double>& angles = curves.content.at;
    const auto middle = std::ranges::min_element(angles, {}, [](double a) { return std::abs(a); });
    const auto at_middle = [&](const Curve& c) { return Estimate{c.value[std::size_t(middle - angles.begin())], c.error}; };
    result.add(name + ".middle_ssim", at_middle(curves.content),
               {.label = fmt::format("Likeness, {}: SSIM of the content at {:.3g} degrees", way, *middle),
                .remark = fmt::format("of the whole screen {:.4g}, which a background that is black in both pictures raises",
                                      at_middle(curves.screen).value)});
    result.add(name + ".content.middle_ssim", at_middle(curves.content));
    result.add(name + ".screen.middle_ssim", at_middle(curves.screen));
}

/// How much more the edges by likeness lie to one side than those by geometry.
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

/// Where an eye may be in the plane at its distance: the width and the height.
void add_eyebox(Result& result, const Subject& s, const std::array<OwnRange, 2>& ranges) {
    // A hexagon's image is as high as from corner to corner.
    const bool hexagon = s.display().array.lattice == LatticeKind::hexagon;
    const auto theory = [&](std::size_t axis) {
        return (s.viewing_distance_mm() - s.geometry().rear_principal_mm) * s.theory().along[axis].elemental_pitch_mm /
               s.theory().gap_mm * (hexagon && axis == 1 ? 2 / std::sqrt(3) : 1);
    };
    std::vector<double> size, error;
    std::string missing;
    for (std::size_t axis = 0; axis < std::size_t(imaging_axes(s.display().array)); ++axis) {
        const OwnRange& r = ranges[axis];
        const std::string why = r.missing[0].empty() ? r.missing[1] : r.missing[0];
        size.push_back(r.at[1] - r.at[0]);
        error.push_back(std::hypot(r.error[0], r.error[1]));
        result.add_line({Estimate{size.back(), error.back()}, why},
                        {.label = axis == 0 ? "Eyebox, width" : "Eyebox, height",
                         .unit = "mm",
                         .theory = theory(axis),
                         .remark = hexagon && axis == 1
                                       ? "theory: from corner to corner of the hexagons' images; the lenses' blur takes light from "
                                         "corners first"
                                       : fmt::format("where an eye {:.4g} mm from the panel sees lenses' own images",
                                                     s.viewing_distance_mm())});
        if (!why.empty()) missing = why;
    }
    result.figures["eyebox_mm"] = numbers_json(size);
    result.figures["eyebox_mm_error"] = numbers_json(error);
    result.figures["theory_eyebox_mm"] =
        hexagon ? numbers_json({theory(0), theory(1)}) : axes_json(s.display().array, theory(0), theory(1));
    if (!missing.empty()) result.note("eyebox_mm", missing);
}

std::int64_t geometry_steps(const Subject& s) { return pictures_worth(s, 3'000'000); }

/// Both axes, without and with the diffuser; the eyebox.
std::array<Geometric, 2> measure_geometry(Result& result, const Subject& s, Job& job) {
    const Display& d = s.display();
    const OwnLens lenses(d, false), diffused(d, true);
    const double distance = s.viewing_distance_mm();
    const std::uint32_t seed = std::uint32_t(d.render.seed);
    Parts parts(job, s.threads(), (d.diffuser ? 6 : 4) * own_range_parts, geometry_steps(s));
    std::array<Geometric, 2> edges;
    std::array<OwnRange, 2> box;
    for (int axis = 0; axis < imaging_axes(d.array); ++axis) {
        Geometric& g = edges[std::size_t(axis)];
        const EyePath path = arc(d, s.geometry(), distance, axis);
        g.lenses = where_own(lenses, path, wanted_error_deg, seed, parts);
        g.diffused = d.diffuser ? where_own(diffused, path, wanted_error_deg, seed, parts) : g.lenses;
        box[std::size_t(axis)] = where_own(lenses, across(d, s.geometry(), distance, axis),
                                           wanted_error_deg * degree * (distance - s.geometry().rear_principal_mm), seed, parts);
    }
    add_eyebox(result, s, box);
    result.figures["lenses_with_whole_images"] = lenses.whole_images();
    return edges;
}

/// As fov_depth_mm, but no eye on its way stands in the scene or nearer to it than it is deep.
double fov_scene_depth_mm(const Subject& s, const std::vector<double>& angles) {
    const double nearest = s.viewing_distance_mm() * std::cos(std::max(-angles.front(), angles.back()) * degree);
    const double most = nearest - s.geometry().vertex_plane_mm - 2 * length(s.scene().half_size_mm());
    const double depth = std::min(fov_depth_mm(s), most), below = s.geometry().base_z_mm - s.geometry().vertex_plane_mm;
    return depth >= below && depth < 0 && most < 0 ? 1.01 * below : depth;  // never inside the lenses
}

}  // namespace

std::vector<double> fov_angles_deg(const Subject& s) {
    if (!s.options().angles_deg.empty()) return s.options().angles_deg;
    const double half = widest_edge_deg(s);
    const double most = std::min({80., arc(s.display(), s.geometry(), s.viewing_distance_mm(), 0).most,
                                  half <= 20.5 ? std::min(1.5 * half, 30.) : std::ceil(half) + 10});
    const int side = std::max(30, int(most));
    std::vector<double> angles;
    for (int k = -side; k <= side; ++k) angles.push_back(most * k / side);
    return angles;
}

double fov_depth_mm(const Subject& s) {
    const Geometry& g = s.geometry();
    const double distance = s.viewing_distance_mm(), described = g.content_depth_mm;
    const double edge = std::min(widest_edge_deg(s) + 2, 80.) * degree;
    const double half_screen = 0.5 * std::min({g.array_width_mm, g.array_height_mm, g.panel_width_mm, g.panel_height_mm});
    // What stands behind the lenses is seen through the screen at X d/(d + E), X how far the eye has gone aside.
    const double aside = distance * std::sin(edge), ahead = distance * std::cos(edge) - g.vertex_plane_mm;
    const double behind = aside > half_screen ? half_screen * ahead / (aside - half_screen) : 1e6;
    const double most = half_screen / std::tan(edge);
    return std::clamp(described, -std::max(most, behind), most);
}

std::int64_t fov_steps(const Subject& subject) {
    return 2 * std::int64_t(fov_angles_deg(subject).size()) + 16 + geometry_steps(subject);
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
    Result result;
    const double edge[] = {theory_edge_deg(subject, 0), is_strips(display.array) ? nan : theory_edge_deg(subject, 1)};
    const std::array<AxisTheory, 2>& along = subject.theory().along;
    result.figures["viewing_distance_mm"] = distance;
    result.figures["theory_fov_deg"] = axes_json(display.array, along[0].fov_deg, along[1].fov_deg);
    result.figures["theory_fov_elemental_deg"] = axes_json(display.array, along[0].fov_elemental_deg, along[1].fov_elemental_deg);
    result.figures["theory_edge_deg"] = axes_json(display.array, edge[0], edge[1]);
    const std::array<Geometric, 2> geometric = measure_geometry(result, subject, job);

    const double depth = fov_scene_depth_mm(subject, angles), described = subject.geometry().content_depth_mm;
    std::unique_ptr<ShownPanel> own;
    if (depth != described)
        own = elemental_panel(display, subject.geometry(), subject.scene().at_depth(depth), subject.threads(), job);
    const ShownEdge shown{subject.scene().at_depth(depth), own ? own->summed() : subject.panel(job), subject.white_field(job)};
    Plot plot{"fov", "Likeness of the simulated view to the scene", "angle of the view, degrees", "SSIM", {}};
    Plot shares{"fov-share", "The scene's share in the view", "angle of the view, degrees", "covariance / variance", {}};
    DataTable table{"fov", {{"angle_deg", angles}}};
    if (is_strips(display.array)) {
        result.figures["vertical"] = Json();
        result.note("vertical", strips_upright);
    }
    for (int axis = 0; axis < imaging_axes(display.array); ++axis) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        const std::string way = is_strips(display.array) ? "across the strips" : name;  // the arc's direction
        const Geometric& edges = geometric[std::size_t(axis)];
        const AngleCurves curves = measure(subject, shown, axis, angles, job);
        // A hexagon's image has a corner above its middle, where theory's pitch has none.
        const bool corner = axis == 1 && display.array.lattice == LatticeKind::hexagon;
        add_geometry(result, name, way, edges, corner ? FigureValue() : std::vector{-edge[axis], edge[axis]});
        add_likeness(result, name, way, curves, edges, edge[axis], fades_over_deg(subject, axis));
        table.columns.push_back({name + "_ssim", curves.screen.value});
        table.columns.push_back({name + "_content_ssim", curves.content.value});
        table.columns.push_back({name + "_share", curves.share.value});
        plot.series.push_back({way + ", content", angles, curves.content.value});
        plot.series.push_back({way + ", whole screen", angles, curves.screen.value});
        shares.series.push_back({way, angles, curves.share.value});
    }
    for (Plot* p : {&plot, &shares})
        for (const double at : geometric[0].lenses.at)
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
    if (depth != described)
        result.remarks.push_back(fmt::format(
            "The scene stands at {:.4g} mm here: at {:.4g} mm, as described, it would not be seen against the screen from "
            "all of these places, or an eye would stand in it.",
            depth, described));
    result.remarks.push_back(
        "The field of view is the geometric one: it depends on no content, picture or step. SSIM is that of the content, "
        "the rectangle about it: a background that is black in both pictures raises the whole screen's. Aberration, the diffuser's "
        "blur and the panel's pixels lower it everywhere, the repeated views beyond the edge suddenly. "
        "So its edge should lie where geometry puts it, and the published thresholds rate the picture's quality.");
    return result;
}

}  // namespace lfdsim
