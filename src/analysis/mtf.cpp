#include "analysis/mtf.h"

#include "analysis/edge_plane.h"
#include "analysis/mtf_theory.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

// docs/model.md, "Resolution".
namespace lfdsim {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<const char*, 3> channels{"red", "green", "blue"};

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json by_channel(const MtfCurves& m, double level, double scale) {
    Json json;
    for (std::size_t c = 0; c < 3; ++c) json[channels[c]] = number_or_null(m.below(c, level) * scale);
    return json;
}

const char* direction(const MtfCurves& m) { return m.horizontal ? "horizontal" : "vertical"; }

Json to_json(const MtfCurves& m) {
    return {{"depth_mm", m.depth_mm},
            {"angle_deg", m.angle_deg},
            {"direction", direction(m)},
            {"mtf50_per_mm", by_channel(m, 0.5, 1)},
            {"mtf50_per_deg", by_channel(m, 0.5, m.mm_per_deg)},
            {"mtf10_per_mm", by_channel(m, 0.1, 1)},
            {"theory_mtf50_per_mm", number_or_null(m.theory_below(0.5))},
            {"lenses_crossed", m.lenses}};
}

/// The lenses as samples of the edges' plane: half a cycle a pitch, as the eye on axis projects it there.
double lens_limit_per_mm(const Subject& s, double depth_mm) {
    const Bars plane{true, s.geometry().vertex_plane_mm + depth_mm, 1, 1, 0};
    return s.theory().lens_sampling_limit_per_mm / scale_to_bars(s.geometry(), plane, {0, s.viewing_distance_mm()});
}

/// The depth that the curves are plotted of: the one nearest to the central depth plane.
double plotted_depth_mm(const Subject& s, const std::vector<double>& depths) {
    const double middle = s.theory().central_depth_mm + s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    return *std::min_element(depths.begin(), depths.end(), [&](double a, double b) {
        return std::isfinite(middle) ? std::abs(a - middle) < std::abs(b - middle) : a > b;
    });
}

std::string label(bool horizontal, double angle) {
    return fmt::format("{}, {:.3g} degrees", horizontal ? "horizontal" : "vertical", angle);
}

void add_findings(const MtfCurves& m, Result& result) {
    const double theory = m.theory_below(0.5);
    const std::string what = fmt::format("MTF50 at {:.4g} mm, {}", m.depth_mm, label(m.horizontal, m.angle_deg));
    const double measured = m.below(1, 0.5);
    std::string remark = m.mtf[1].empty()       ? "no edge is seen there: too little light, or more blur than the screen is wide"
                         : std::isnan(measured) ? "never below one half as far as was measured"
                         : measured < 0.9 * theory
                             ? "aberrations and light through other lenses take more than the paraxial blur does"
                             : "theory: image of a panel pixel, paraxial spot and diffuser together";
    result.findings.push_back({what, "per mm", {measured}, {theory}, std::move(remark)});
}

/// The plot of the curves at one depth.
Plot curves(const Subject& s, const std::vector<MtfCurves>& all, double depth) {
    Plot plot{"mtf", fmt::format("Modulation transfer at {:.4g} mm", depth), "cycles per mm in that plane", "modulation", {}};
    const MtfCurves* first = nullptr;
    for (const MtfCurves& m : all) {
        if (m.depth_mm != depth) continue;
        if (!first) first = &m;
        if (!m.mtf[1].empty()) plot.series.push_back({label(m.horizontal, m.angle_deg), m.frequencies_per_mm, m.mtf[1]});
    }
    plot.series.push_back({"theory, horizontal, 0 degrees", first->frequencies_per_mm, first->theory, true});
    plot.marks.push_back({"0.5", 0.5, false});
    const Geometry& g = s.geometry();
    const auto mark = [&](const char* text, double at) {
        if (at > 0 && at < first->frequencies_per_mm.back()) plot.marks.push_back({text, at});
    };
    mark("pixel limit", 0.5 / pixel_image_mm(s.display(), g, g.vertex_plane_mm + depth));
    mark("lens sampling", lens_limit_per_mm(s, depth));
    return plot;
}

void report(const Subject& s, const std::vector<double>& depths, const std::vector<double>& angles,
            const std::vector<MtfCurves>& all, Result& result) {
    const double plotted = plotted_depth_mm(s, depths);
    for (const MtfCurves& m : all)
        if (m.depth_mm == plotted) add_findings(m, result);
    result.plots.push_back(curves(s, all, plotted));

    Plot plot{"mtf50", "Where modulation falls to one half", "depth before the lenses, mm", "cycles per mm", {}};
    DataTable table{"mtf50", {{"depth_mm", depths}}};
    for (const bool horizontal : {true, false}) {
        DataTable all_curves{horizontal ? "mtf_horizontal" : "mtf_vertical",
                             {{"depth_mm", {}},
                              {"angle_deg", {}},
                              {"frequency_per_mm", {}},
                              {"red", {}},
                              {"green", {}},
                              {"blue", {}},
                              {"theory", {}}}};
        for (const double angle : angles) {
            std::array<Column, 3> columns;
            Column theory{fmt::format("{}_{:.3g}_deg_theory_per_mm", horizontal ? "horizontal" : "vertical", angle), {}};
            for (std::size_t c = 0; c < 3; ++c)
                columns[c].name =
                    fmt::format("{}_{:.3g}_deg_{}_per_mm", horizontal ? "horizontal" : "vertical", angle, channels[c]);
            for (const MtfCurves& m : all) {
                if (m.horizontal != horizontal || m.angle_deg != angle) continue;
                for (std::size_t c = 0; c < 3; ++c) columns[c].values.push_back(m.below(c, 0.5));
                theory.values.push_back(m.theory_below(0.5));
                for (std::size_t k = 0; k < m.frequencies_per_mm.size(); ++k) {
                    const auto value = [&](std::size_t c) { return m.mtf[c].empty() ? nan : m.mtf[c][k]; };
                    const std::array row{m.depth_mm, angle, m.frequencies_per_mm[k], value(0), value(1), value(2), m.theory[k]};
                    for (std::size_t c = 0; c < row.size(); ++c) all_curves.columns[c].values.push_back(row[c]);
                }
            }
            plot.series.push_back({label(horizontal, angle), depths, columns[1].values});
            if (horizontal && angle == 0) plot.series.push_back({"theory, " + label(true, 0), depths, theory.values, true});
            for (Column& c : columns) table.columns.push_back(std::move(c));
            table.columns.push_back(std::move(theory));
        }
        result.tables.push_back(std::move(all_curves));
    }
    Column lens{"lens_sampling_limit_per_mm", {}}, pixel{"pixel_limit_per_mm", {}};
    for (const double z : depths) {
        lens.values.push_back(lens_limit_per_mm(s, z));
        const double limit = 0.5 / pixel_image_mm(s.display(), s.geometry(), s.geometry().vertex_plane_mm + z);
        pixel.values.push_back(std::isfinite(limit) ? limit : nan);
    }
    plot.series.push_back({"lens sampling, 1/2p", depths, lens.values});
    plot.series.push_back({"pixel limit, g/2az", depths, pixel.values});
    const double middle = s.theory().central_depth_mm + s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    if (middle >= depths.front() && middle <= depths.back()) plot.marks.push_back({"central depth plane", middle});
    table.columns.push_back(std::move(lens));
    table.columns.push_back(std::move(pixel));
    result.tables.push_back(std::move(table));
    result.plots.push_back(std::move(plot));

    result.remarks.push_back(
        "The display is seen by a pinhole, so that neither an eye's optics nor its focus enters. Lenses that see a place of the "
        "edges' plane at different places of it blur the mean edge; how the picture breaks up at their borders is not in it.");
    const bool grey =
        std::all_of(all.begin(), all.end(), [](const MtfCurves& m) { return m.mtf[0] == m.mtf[1] && m.mtf[1] == m.mtf[2]; });
    if (grey) result.remarks.push_back("Red, green and blue are alike: the model has neither dispersion nor subpixels.");
}

void check(const Subject& s, const std::vector<double>& depths, const std::vector<double>& angles) {
    const Geometry& g = s.geometry();
    const Eye eye{angles.back(), s.viewing_distance_mm()};
    const double top = std::max(g.top_z_mm, g.diffuser_z_mm.value_or(g.top_z_mm));
    if (!(eye.z_mm() > top))
        throw InputError("--viewing-distance-mm",
                         fmt::format("{:.6g} puts the eye at {:.3g} degrees inside the display, which ends {:.6g} mm from the "
                                     "panel; give more",
                                     eye.distance_mm, eye.angle_deg, top));
    const double most = 0.9 * (eye.z_mm() - g.vertex_plane_mm);
    for (const double z : depths)
        if (z > most)
            throw InputError(
                "--depths-mm",
                fmt::format("{:.6g} puts edges about where the eye is; depths up to {:.4g} mm are seen well", z, most));
}

}  // namespace

std::vector<double> mtf_angles_deg(const Subject& s) {
    return {0, std::min(30., 0.25 * s.theory().fov_deg), std::min(45., 0.4 * s.theory().fov_deg)};
}

std::vector<double> mtf_depths_mm(const Subject& s) {
    if (!s.options().depths_mm.empty()) return s.options().depths_mm;
    const Theory& t = s.theory();
    const double from_vertex = s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm,
                 middle = t.central_depth_mm + from_vertex;
    const Eye eye{mtf_angles_deg(s).back(), s.viewing_distance_mm()};
    const double far = 0.75 * (eye.z_mm() - s.geometry().vertex_plane_mm);
    std::vector<double> depths;
    if (!(middle < far && middle > -100 * far)) {
        for (int k = 1; k <= 9; ++k) depths.push_back(far * k / 9);
        return depths;
    }
    double low = middle - t.depth_of_field_mm, high = std::min(middle + t.depth_of_field_mm, far);
    (middle > 0 ? low : high) = middle > 0 ? std::max(low, 0.1 * middle) : std::min(high, 0.1 * middle);
    for (int k = -4; k <= 4; ++k) depths.push_back(middle + (k < 0 ? middle - low : high - middle) * k / 4);
    return depths;
}

std::int64_t mtf_steps(const Subject& s) { return 2 * std::int64_t(mtf_depths_mm(s).size()); }

Result measure_mtf(Subject& s, Job& job) {
    const std::vector<double> depths = mtf_depths_mm(s), angles = mtf_angles_deg(s);
    check(s, depths, angles);
    const auto white = bars_panel(s.display(), s.geometry(), {}, s.threads());
    std::vector<MtfCurves> all;
    for (const double depth : depths)
        for (const bool horizontal : {true, false}) {
            for (MtfCurves& m : EdgePlane(s, depth, horizontal, white->pyramid(), job).measure(angles)) all.push_back(std::move(m));
            job.advance(1);
        }

    Result result;
    result.figures["slant_deg"] = slant_deg;
    result.figures["lens_sampling_limit_per_mm"] = s.theory().lens_sampling_limit_per_mm;
    result.figures["pixel_image_limit_per_mm"] = number_or_null(s.theory().pixel_image_limit_per_mm);
    result.figures["measurements"] = Json::array();
    for (const MtfCurves& m : all) result.figures["measurements"].push_back(to_json(m));
    report(s, depths, angles, all, result);
    return result;
}

}  // namespace lfdsim
