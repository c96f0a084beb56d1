// The measure of resolution: its figures, texts and plots. docs/measures.md, "Resolution".

#include "analysis/resolution/mtf.h"

#include "analysis/core/channel_pixels.h"
#include "analysis/core/elemental_panel.h"
#include "analysis/core/figure_json.h"
#include "analysis/resolution/edge_plane.h"
#include "analysis/resolution/fringes.h"
#include "analysis/resolution/mtf_colour.h"
#include "analysis/resolution/mtf_resolution.h"
#include "analysis/resolution/mtf_theory.h"
#include "base/constants.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>

namespace lfdsim {
namespace {

constexpr const char* across_alone =
    "strips do not image along their axes: in that direction a picture is as fine as the panel's pixels at any depth";
constexpr std::array levels{std::pair{"mtf50", 0.5}, std::pair{"mtf10", 0.1}};

/// Adds NAME and NAME_error of red, green and blue, times `scale`.
template <class Figure>
void add_channels(Json& json, const std::string& name, double scale, const Figure& figure) {
    for (std::size_t c = 0; c < 3; ++c) {
        const Estimate found = figure(c);
        json[name][colour_of_channel[c]] = number_json(found.value * scale);
        json[name + "_error"][colour_of_channel[c]] = number_json(found.error * scale);
    }
}

/// Returns the figures of one plane, direction and angle for scripts.
Json to_json(const MtfCurves& m, const Resolution& r) {
    Json json{{"depth_mm", m.depth_mm}, {"angle_deg", m.angle_deg}, {"direction", m.direction.name}};
    for (const auto& [unit, scale] : {std::pair{"_per_mm", 1.}, std::pair{"_per_deg", m.mm_per_deg}}) {
        write_value(json, std::string("resolution") + unit, Estimate{r.per_mm.value * scale, r.per_mm.error * scale});
        json[std::string("lens_sampling_limit") + unit] = number_json(r.lens_limit_per_mm * scale);
        json[std::string("pixel_image_limit") + unit] = number_json(r.pixel_limit_per_mm * scale);
        for (const auto& [name, level] : levels) {
            add_channels(json, std::string(name) + unit, scale, [&, at = level](std::size_t c) { return m.below(at, c).found; });
            if (!m.channels.empty()) {
                const Estimate luminance = m.below(level).found;
                json[std::string(name) + unit]["luminance"] = number_json(luminance.value * scale);
                json[std::string(name) + unit + "_error"]["luminance"] = number_json(luminance.error * scale);
            }
            add_channels(json, std::string("edge_") + name + unit, scale,
                         [&, at = level](std::size_t c) { return m.edges_below(c, at).found; });
        }
        json[std::string("theory_mtf50") + unit] = number_json(m.theory_below(0.5) * scale);
        json[std::string("theory_resolution") + unit] = number_json(r.theory_per_mm * scale);
    }
    json["limited_by"] = r.missing.empty() ? Json(r.limited_by) : Json();
    json["astray_share"] = m.astray;
    json["lenses_crossed"] = m.lenses;
    if (const Json colour = colours_json(m); !colour.is_null()) json["colour"] = colour;
    return json;
}

/// Adds notes on why figures of measurement n are null.
void add_notes(const MtfCurves& m, const Resolution& r, std::size_t n, Result& result) {
    const std::string path = fmt::format("measurements.{}", n);
    if (!m.has_theory())
        for (const char* name : {"theory_mtf50", "theory_resolution"})
            result.note(fmt::format("{}.{}", path, name),
                        fmt::format("{:.3g} % of the light comes from other lenses' elemental images, which theory leaves out",
                                    100 * m.astray));
    if (!r.missing.empty()) return result.note(path, r.missing);
    for (const auto& [name, level] : levels) {
        const double last = m.frequencies_per_mm.back();
        const std::string never = fmt::format(
            "modulation is never below {:.0f} % up to the highest frequency measured, {:.4g} per mm", 100 * level, last);
        // Returns why one of the figures is missing; empty if none is.
        const auto reason = [&, at = level](std::initializer_list<LimitingFrequency> figures) -> std::string {
            for (const LimitingFrequency& of : figures)
                if (std::isnan(of.found.value))
                    return std::isnan(of.least)
                               ? never
                               : fmt::format(
                                     "modulation stays near {:.0f} %: within its error it falls below that from {:.4g} per mm on, "
                                     "or not up to the highest frequency measured, {:.4g} per mm",
                                     100 * at, of.least, last);
            return {};
        };
        if (std::string why = reason({m.below(level), m.below(level, 0), m.below(level, 1), m.below(level, 2)}); !why.empty())
            result.note(fmt::format("{}.{}", path, name), std::move(why));
        if (std::string why = reason({m.edges_below(0, level), m.edges_below(1, level), m.edges_below(2, level)}); !why.empty())
            result.note(fmt::format("{}.edge_{}", path, name),
                        m.edges[1].all.empty() ? "the screen shows too little of the plane about an edge for the edge's light"
                                               : std::move(why));
    }
}

/// Returns the depth for which curves are plotted: the one nearest to the central depth plane, or the farthest if that is
/// infinite.
double plotted_depth_mm(const Subject& s, const std::vector<double>& depths) {
    const double middle = s.theory().central_depth_mm + s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    return *std::min_element(depths.begin(), depths.end(), [&](double a, double b) {
        return std::isfinite(middle) ? std::abs(a - middle) < std::abs(b - middle) : a > b;
    });
}

std::string label(const Direction& direction, double angle) { return fmt::format("{}, {:.3g} degrees", direction.told, angle); }

/// Adds a line on the resolution of one plane, direction and angle.
void add_findings(const MtfCurves& m, const Resolution& r, Result& result) {
    const double mtf50 = m.below(0.5).found.value;
    std::string remark = r.missing;
    if (remark.empty()) {
        remark = fmt::format("{:.4g} cycles per degree, limited by {}", r.per_mm.value * m.mm_per_deg, r.limited_by);
        if (std::isnan(mtf50))
            remark += "; MTF is not clearly below one half up to the highest frequency measured";
        else if (mtf50 > r.per_mm.value)
            remark += fmt::format("; MTF50 alone is {:.4g} per mm", mtf50);
        if (r.per_mm.value < 0.9 * r.theory_per_mm)
            remark += "; aberrations and light through other lenses blur more than paraxial theory predicts";
    }
    result.add_line(r.per_mm, {.label = fmt::format("Resolution at {:.4g} mm, {}", m.depth_mm, label(m.direction, m.angle_deg)),
                               .unit = "per mm",
                               .theory = r.theory_per_mm,
                               .remark = remark});
}

/// Returns the plot of the curves at one depth.
Plot curves(const Subject& s, const std::vector<MtfCurves>& all, double depth) {
    Plot plot{"mtf", fmt::format("Modulation transfer at {:.4g} mm", depth), "cycles per mm in that plane", "modulation", {}};
    const MtfCurves* first = nullptr;
    for (const MtfCurves& m : all) {
        if (m.depth_mm != depth) continue;
        if (!first) first = &m;
        if (!m.missing.empty()) continue;
        plot.series.push_back({label(m.direction, m.angle_deg), m.frequencies_per_mm, m.modulation.all});
    }
    if (!first->edges[1].all.empty())
        plot.series.push_back(
            {"edges, " + label(first->direction, first->angle_deg), first->frequencies_per_mm, first->edges[1].all, true});
    plot.series.push_back({"theory, " + label(first->direction, first->angle_deg), first->frequencies_per_mm, first->theory, true});
    plot.marks.push_back({"0.5", 0.5, false});
    const Resolution r = resolution(s, *first);
    const auto mark = [&](const char* text, const char* limit, double at) {
        if (at > 0 && at < first->frequencies_per_mm.back())
            plot.marks.push_back({fmt::format("{}{}", text, std::string_view(limit) == r.limited_by ? ", which limits" : ""), at});
    };
    mark("pixel limit", "pixel image", r.pixel_limit_per_mm);
    mark("lens sampling", "lens sampling", r.lens_limit_per_mm);
    if (std::string_view(r.limited_by) == "mtf50") mark("MTF50", "mtf50", r.per_mm.value);
    return plot;
}

/// Adds lines, plots and tables of all planes.
void report(const Subject& s, const std::vector<double>& depths, const std::vector<double>& angles,
            const std::vector<MtfCurves>& all, Result& result) {
    const double plotted = plotted_depth_mm(s, depths);
    std::vector<const MtfCurves*> at_plotted;
    for (const MtfCurves& m : all) {
        if (m.depth_mm != plotted) continue;
        add_findings(m, resolution(s, m), result);
        at_plotted.push_back(&m);
    }
    result.plots.push_back(curves(s, all, plotted));
    tell_mtf_of_colours(at_plotted, result);

    Plot plot{"mtf50", "Resolution: MTF50, or the limit below it", "depth in front of the lenses, mm", "cycles per mm", {}};
    DataTable table{"mtf50", {{"depth_mm", depths}}};
    for (const Direction& direction : directions(s.geometry())) {
        DataTable all_curves = DataTable::of_rows(
            std::string("mtf_") + direction.name,
            {"depth_mm", "angle_deg", "frequency_per_mm", "modulation", "edge_red", "edge_green", "edge_blue", "theory"});
        if (has_colours(s.display()))
            for (const char* kind : {"", "theory_"})
                for (const char* colour : colour_of_channel) all_curves.columns.push_back({std::string(kind) + colour, {}});
        for (const double angle : angles) {
            const auto column = [&](const char* what) {
                return Column{fmt::format("{}_{:.3g}_deg_{}_per_mm", direction.name, angle, what), {}};
            };
            Column mtf50 = column("mtf50"), edges = column("edge_mtf50"), theory = column("theory"),
                   resolved = column("resolution");
            for (const MtfCurves& m : all) {
                if (m.direction.axis != direction.axis || m.angle_deg != angle) continue;
                mtf50.values.push_back(m.below(0.5).found.value);
                edges.values.push_back(m.edges_below(1, 0.5).found.value);
                theory.values.push_back(m.theory_below(0.5));
                resolved.values.push_back(resolution(s, m).per_mm.value);
                for (std::size_t k = 0; k < m.frequencies_per_mm.size(); ++k) {
                    const auto value = [&](const Modulation& of) { return of.all.empty() ? nan : of.all[k]; };
                    std::vector row{m.depth_mm,
                                    angle,
                                    m.frequencies_per_mm[k],
                                    value(m.modulation),
                                    value(m.edges[0]),
                                    value(m.edges[1]),
                                    value(m.edges[2]),
                                    m.theory[k]};
                    for (const ChannelMtf& channel : m.channels) row.push_back(value(channel.modulation));
                    for (const ChannelMtf& channel : m.channels) row.push_back(channel.theory[k]);
                    all_curves.add_row(row);
                }
            }
            plot.series.push_back({label(direction, angle), depths, resolved.values});
            if (direction.axis == 0 && angle == 0)
                plot.series.push_back({"theory's MTF50, " + label(direction, 0), depths, theory.values, true});
            for (Column* c : {&mtf50, &edges, &theory, &resolved}) table.columns.push_back(std::move(*c));
        }
        result.tables.push_back(std::move(all_curves));
    }
    Column lens{"lens_sampling_limit_per_mm", {}}, pixel{"pixel_limit_per_mm", {}};
    for (const double z : depths) {
        const auto at =
            std::find_if(all.begin(), all.end(), [&](const MtfCurves& m) { return m.depth_mm == z && m.angle_deg == 0; });
        const Resolution r = resolution(s, *at);
        const auto finite = [](double limit) { return std::isfinite(limit) ? limit : nan; };
        lens.values.push_back(finite(r.lens_limit_per_mm));
        pixel.values.push_back(finite(r.pixel_limit_per_mm));
    }
    const double at_lenses = s.theory(0).lens_sampling_limit_per_mm;
    plot.series.push_back({"lens sampling", depths, limits_to_plot(lens.values, at_lenses)});
    plot.series.push_back({"pixel limit, g/2az", depths, limits_to_plot(pixel.values, at_lenses)});
    const double middle = s.theory().central_depth_mm + s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    if (middle >= depths.front() && middle <= depths.back()) plot.marks.push_back({"central depth plane", middle});
    table.columns.push_back(std::move(lens));
    table.columns.push_back(std::move(pixel));
    result.tables.push_back(std::move(table));
    result.plots.push_back(std::move(plot));

    result.remarks.push_back(
        "Resolution is MTF50 or, where lower, half a cycle per jump from lens to lens, p |1 - z/L|, or per image of a panel pixel: "
        "finer detail is aliased. Values per degree are as seen from the eye. The display is seen through a pinhole, so that "
        "neither the optics nor the "
        "focus of an eye enters. MTF is that of lines of sight through the whole screen; MTF of edges in pictures, which sample "
        "some positions, is given for comparison. Lenses that show a point of the plane at different positions blur the mean edge; "
        "the discontinuities of the picture at lens borders are not included.");
    if (is_strips(s.display().array))
        result.remarks.push_back(fmt::format("Resolution is that across the strips: {}.", across_alone));
    result.remarks.push_back(remark_on_channels(all));
}

/// Throws InputError if the eye is inside the display, or for edges near the eye.
void check(const Subject& s, const std::vector<double>& depths, const std::vector<double>& angles) {
    const Geometry& g = s.geometry();
    const EdgeEye eye{angles.back(), s.viewing_distance_mm()};
    const double top = std::max(g.top_z_mm, g.diffuser_z_mm.value_or(g.top_z_mm));
    if (!(eye.z_mm() > top))
        throw InputError("--viewing-distance-mm",
                         fmt::format("{:.6g} puts the eye at {:.3g} degrees inside the display, which ends {:.6g} mm from the "
                                     "panel; give more",
                                     eye.distance_mm, eye.angle_deg, top));
    const double most = 0.9 * (eye.z_mm() - g.vertex_plane_mm);
    for (const double z : depths)
        if (z > most)
            throw InputError("--depths-mm",
                             fmt::format("{:.6g} puts edges near the eye; depths up to {:.4g} mm can be measured", z, most));
}

}  // namespace

std::vector<double> mtf_angles_deg(const Subject& s) {
    const double fov_deg = is_strips(s.display().array) ? s.theory().fov_of_eyes_deg : s.theory(0).fov_deg;
    return {0, std::min(30., 0.25 * fov_deg), std::min(45., 0.4 * fov_deg)};
}

std::vector<double> mtf_depths_mm(const Subject& s) {
    if (!s.options().depths_mm.empty()) return s.options().depths_mm;
    const Theory& t = s.theory();
    const double from_vertex = s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm,
                 middle = t.central_depth_mm + from_vertex;
    const EdgeEye eye{mtf_angles_deg(s).back(), s.viewing_distance_mm()};
    const double far = 0.75 * (eye.z_mm() - s.geometry().vertex_plane_mm);
    std::vector<double> depths;
    // Without a central depth plane within reach depths are even from the lenses on.
    if (!(middle < far && middle > -100 * far)) {
        for (int k = 1; k <= 9; ++k) depths.push_back(far * k / 9);
        return depths;
    }
    double low = middle - t.depth_of_field_mm, high = std::min(middle + t.depth_of_field_mm, far);
    (middle > 0 ? low : high) = middle > 0 ? std::max(low, 0.1 * middle) : std::min(high, 0.1 * middle);
    for (int k = -4; k <= 4; ++k) depths.push_back(middle + (k < 0 ? middle - low : high - middle) * k / 4);
    return depths;
}

std::int64_t mtf_steps(const Subject& s) {
    return std::int64_t(directions(s.geometry()).size()) * std::int64_t(mtf_depths_mm(s).size());
}

Result measure_mtf(Subject& s, Job& job) {
    const std::vector<double> depths = mtf_depths_mm(s), angles = mtf_angles_deg(s);
    check(s, depths, angles);
    const auto white = bars_panel(s.display(), s.geometry(), {}, s.threads());
    // Lines of sight depend on the angle only, and serve all planes.
    std::vector<SeenInColours> seen;
    for (const double angle : angles) {
        if (job.cancelled()) throw Stopped{};
        const EdgeEye eye{angle, s.viewing_distance_mm()};
        seen.push_back(seen_in_colours(s, {eye.x_mm(), 0, eye.z_mm()}));
    }
    std::vector<MtfCurves> all;
    for (const double depth : depths)
        for (const Direction& direction : directions(s.geometry())) {
            std::vector<MtfCurves> plane;
            for (std::size_t k = 0; k < angles.size(); ++k) plane.push_back(mtf_curves(s, seen[k], depth, angles[k], direction));
            EdgePlane(s, depth, direction, white->summed(), job).measure(plane);
            std::move(plane.begin(), plane.end(), std::back_inserter(all));
            job.advance(1);
        }

    Result result;
    result.figures["slant_deg"] = slant_deg;
    result.figures["lens_sampling_limit_per_mm"] =
        axes_json(s.display().array, s.theory(0).lens_sampling_limit_per_mm, s.theory(1).lens_sampling_limit_per_mm);
    result.add("pixel_image_limit_per_mm", s.theory().pixel_image_limit_per_mm);
    result.figures["measurements"] = Json::array();
    for (std::size_t n = 0; n < all.size(); ++n) {
        const Resolution r = resolution(s, all[n]);
        result.figures["measurements"].push_back(to_json(all[n], r));
        add_notes(all[n], r, n, result);
    }
    if (is_strips(s.display().array)) result.add("along", FigureValue::none(across_alone));
    report(s, depths, angles, all, result);
    show_edge_fringes(s, plotted_depth_mm(s, depths), angles, job, result);
    return result;
}

}  // namespace lfdsim
