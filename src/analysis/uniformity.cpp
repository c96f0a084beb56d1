#include "analysis/uniformity.h"

#include "analysis/efficiency.h"
#include "analysis/rules.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

// What becomes of a white panel's light. docs/model.md, "Uniformity and efficiency".
namespace lfdsim {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr int rays_an_angle = 8192;

std::vector<double> angles_deg() {
    std::vector<double> angles;
    for (int k = -32; k <= 32; ++k) angles.push_back(2.5 * k);
    return angles;
}

void add_screen(Result& result, const ScreenLuminance& screen, const Display& d, const Geometry& g) {
    const double greatest = screen.greatest(), percent = greatest > 0 ? 100 * screen.least() / greatest : 0,
                 inside = greatest > 0 ? 100 * screen.least_inside() / greatest : 0;
    result.figures["screen"] = {{"luminance_over_panel", screen.mean()},
                                {"least_over_panel", screen.least()},
                                {"greatest_over_panel", greatest},
                                {"uniformity_percent", percent},
                                {"uniformity_inner_percent", inside}};
    result.findings.push_back({"Luminance of the screen on axis over the panel's",
                               "",
                               {screen.mean()},
                               {1},
                               "mean over the screen; less by reflection, by what is black between lenses, and at the border"});
    result.findings.push_back({"Uniformity on axis, 100 Lmin / Lmax", "%", {percent}, {}, "of means over whole lenses"});
    result.findings.push_back(
        {"Uniformity on axis, middle 80 % of width and height", "%", {inside}, {}, "the least there over the greatest of all"});
    result.maps.push_back({"uniformity_screen", "Luminance of a white screen, seen on axis", "x along the array, mm", "y, mm",
                           "of the panel's", -g.array_width_mm / 2, g.array_width_mm / 2, -g.array_height_mm / 2,
                           g.array_height_mm / 2, screen.columns, screen.rows, screen.values, 0, greatest > 0 ? greatest : 1});
    DataTable table{"uniformity_screen", {{"column", {}}, {"row", {}}, {"luminance", screen.values}}};
    for (int k = 0; k < screen.columns * screen.rows; ++k) {
        table.columns[0].values.push_back(k % screen.columns);
        table.columns[1].values.push_back(k / screen.columns);
    }
    result.tables.push_back(std::move(table));
    if (d.diffuser && percent < 90)
        result.remarks.push_back(
            "The diffuser turns lines of sight near the array's border past it, so the border is dim; the figure for the middle "
            "leaves it out.");
}

void add_bands(Result& result, const PitchLuminance& pitch, const Display& d) {
    constexpr int side = PitchLuminance::side;
    const double half = d.array.pitch_mm / 2;
    std::vector<double> places;
    for (int k = 0; k < side; ++k) places.push_back(half * ((2 * k + 1.) / side - 1));
    Plot plot{"uniformity_bands",
              "Luminance across one lens pitch, seen on axis",
              "place from the lens's axis, mm",
              "of the panel's",
              {}};
    DataTable table{"uniformity_bands", {{"place_mm", places}}};
    Json json;
    for (const int axis : {0, 1}) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        const std::vector<double> profile = pitch.profile(axis);
        const double contrast = michelson(profile);
        json[name + "_contrast"] = contrast;
        result.findings.push_back({fmt::format("Dark bands at lens joints, {}: Michelson contrast", name),
                                   "",
                                   {contrast},
                                   {},
                                   "across one pitch, averaged along the other axis"});
        plot.series.push_back({name, places, profile});
        table.columns.push_back({name + "_luminance", profile});
    }
    json["dots_contrast"] = michelson(pitch.values);
    result.figures["bands"] = std::move(json);
    const double greatest = *std::max_element(pitch.values.begin(), pitch.values.end());
    result.maps.push_back({"uniformity_pitch", "Luminance within one lens pitch, seen on axis", "x, mm", "y, mm", "of the panel's",
                           -half, half, -half, half, side, side, pitch.values, 0, greatest > 0 ? greatest : 1});
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

void add_angles(Result& result, Subject& s, const EyeRays& rays, double distance, Parts& parts) {
    const std::vector<double> angles = angles_deg();
    const std::vector<Choice> choices = even_choices(rays_an_angle * rays.more_for({0, 0, distance}));
    Plot plot{
        "uniformity_angle", "Mean luminance of a white screen", "viewing angle, degrees", "of the panel's along its normal", {}};
    DataTable table{"uniformity_angle", {{"angle_deg", angles}}};
    Json json;
    for (const int axis : {0, 1}) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        std::vector<double> light(angles.size(), std::numeric_limits<double>::quiet_NaN());  // where eyes cannot be
        parts.run(int(angles.size()), [&](int k) {
            const double across = distance * std::sin(angles[std::size_t(k)] * degree),
                         ahead = distance * std::cos(angles[std::size_t(k)] * degree);
            if (!(ahead > nearest_eye_mm(s.geometry()))) return;
            double sum = 0;
            for (const Choice& choice : choices)
                sum += rays.look({axis == 0 ? across : 0, axis == 0 ? 0 : across, ahead}, choice).light;
            light[std::size_t(k)] = sum / double(choices.size());
        });
        Curve curve;
        for (std::size_t k = 0; k < angles.size(); ++k) {
            if (std::isnan(light[k])) continue;
            curve.at.push_back(angles[k]);
            curve.value.push_back(light[k]);
        }
        const double middle = light[angles.size() / 2];
        const Interval half = curve.at.size() < 2 || !(middle > 0) ? Interval{} : where_at_least(curve, 0, 0.5 * middle);
        json[name + "_half_luminance_deg"] = limits_json(half);
        result.findings.push_back({fmt::format("Half the luminance on axis, {}", name),
                                   "deg",
                                   bounds(half),
                                   {},
                                   "mean over the screen, at the viewing distance"});
        plot.series.push_back({name, angles, light});
        table.columns.push_back({name + "_luminance", std::move(light)});
    }
    result.figures["angle"] = std::move(json);
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

void add_budget(Result& result, const LightBudget& budget) {
    const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0; };
    const double efficiency = share(budget.leaves, budget.reaches_array),
                 within = share(budget.leaves_in_fov, budget.reaches_array);
    result.figures["light"] = {{"efficiency", efficiency},
                               {"efficiency_within_fov", within},
                               {"efficiency_of_panel", share(budget.leaves, budget.emitted)},
                               {"share_reaching_array", share(budget.reaches_array, budget.emitted)}};
    result.findings.push_back({"Light efficiency",
                               "",
                               {efficiency},
                               {},
                               "of the panel's light that reaches the array: what leaves to the viewer's side, in any direction"});
    result.findings.push_back(
        {"Light efficiency within the field of view", "", {within}, {}, "what leaves with slopes within p/2g"});
}

}  // namespace

std::int64_t uniformity_steps(const Subject& s) { return pictures_worth(s, 7'000'000); }

Result measure_uniformity(Subject& s, Job& job) {
    const double distance = checked_viewing_distance_mm(s);
    const EyeRays rays(s.display(), s.geometry());
    const int angles = int(angles_deg().size());
    Parts parts(job, s.threads(), screen_luminance_parts(s.display()) + pitch_luminance_parts + 2 * angles + light_budget_parts,
                uniformity_steps(s));
    const Vec3d eye{0, 0, distance};
    Result result;
    result.figures["viewing_distance_mm"] = distance;
    add_screen(result, screen_luminance(rays, s.display(), eye, parts), s.display(), s.geometry());
    add_bands(result, pitch_luminance(rays, s.display(), eye, parts), s.display());
    add_angles(result, s, rays, distance, parts);
    add_budget(result, light_budget(s.display(), s.geometry(), parts));
    result.remarks.push_back(
        "A lens passes on the panel's radiance: luminance falls only by reflection and where lines of sight end beside a lens or "
        "the panel. Light efficiency is another thing: light leaves in all directions, most of it to where no viewer is.");
    return result;
}

}  // namespace lfdsim
