#include "analysis/uniformity/uniformity.h"

#include "analysis/resolution/fringes.h"
#include "analysis/uniformity/efficiency.h"
#include "analysis/uniformity/luminance_theory.h"
#include "analysis/uniformity/uniformity_colour.h"
#include "base/constants.h"
#include "geometry/dark_bands.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// What becomes of a white panel's light. docs/model.md, "Uniformity and efficiency".
namespace lfdsim {
namespace {

constexpr int angle_lines_a_set = 256;  // of an eye at an angle; and three times as many mirrored
constexpr double step_deg = 2.5, last_deg = 80;

std::vector<double> angles_deg() {
    std::vector<double> angles;
    for (double a = -last_deg; a <= last_deg; a += step_deg) angles.push_back(a);
    return angles;
}

void add_screen(Result& result, const ScreenLuminance& screen, const Subject& s, double distance) {
    const Geometry& g = s.geometry();
    const double greatest = screen.greatest();
    const Estimate mean = screen.mean(), percent = screen.uniformity_percent(false), inside = screen.uniformity_percent(true);
    const TheoryFigure theory = luminance_over_panel(s.display(), g, distance);
    Json& json = result.figures["screen"];
    add_figure(json, "luminance_over_panel", mean);
    json["theory_luminance_over_panel"] = number_json(theory.value);
    if (!theory.missing.empty()) result.note("screen.theory_luminance_over_panel", theory.missing);
    json["least_over_panel"] = number_json(screen.least());
    json["greatest_over_panel"] = number_json(greatest);
    add_figure(json, "uniformity_percent", percent);
    add_figure(json, "uniformity_inner_percent", inside);
    if (std::isnan(mean.value)) result.note("screen.luminance_over_panel", "the eye sees no panel through the array");
    const std::string few = "none of the parts that luminance is compared for has half of itself in front of the panel";
    if (std::isnan(percent.value)) result.note("screen.uniformity_percent", few);
    if (std::isnan(inside.value)) result.note("screen.uniformity_inner_percent", few);
    result.findings.push_back({"Luminance of the screen on axis over the panel's",
                               "",
                               {mean.value},
                               {theory.value},
                               theory.missing.empty()
                                   ? "mean over the screen; theory: of lines of sight that aim at the array, the share that "
                                     "a lens leads to the panel, times what its surfaces let through"
                                   : theory.missing,
                               {mean.error}});
    result.findings.push_back(
        {"Uniformity on axis, 100 Lmin / Lmax", "%", {percent.value}, {}, "of means over whole lenses", {percent.error}});
    result.findings.push_back({"Uniformity on axis, middle 80 % of width and height",
                               "%",
                               {inside.value},
                               {},
                               "the least there over the greatest of all",
                               {inside.error}});
    result.maps.push_back({"uniformity_screen", "Luminance of a white screen, seen on axis", "x along the array, mm", "y, mm",
                           "of the panel's", -g.array_width_mm / 2, g.array_width_mm / 2, -g.array_height_mm / 2,
                           g.array_height_mm / 2, screen.columns, screen.rows, screen.values(), 0, greatest > 0 ? greatest : 1});
    DataTable table{"uniformity_screen", {{"column", {}}, {"row", {}}, {"luminance", screen.values()}}};
    for (int k = 0; k < screen.columns * screen.rows; ++k) {
        table.columns[0].values.push_back(k % screen.columns);
        table.columns[1].values.push_back(k / screen.columns);
    }
    result.tables.push_back(std::move(table));
    if (s.display().diffuser && percent.value < 90)
        result.remarks.push_back(
            "The diffuser turns lines of sight near the array's border past it, so the border is dim; the figure for the middle "
            "leaves it out.");
}

void add_bands(Result& result, const PitchLuminance& pitch, const Subject& s) {
    constexpr int side = PitchLuminance::side;
    const Lattice<double>& lattice = s.geometry().lattice;
    const double half[] = {lattice.pitch[0] / 2, lattice.pitch[lattice.strips ? 0 : 1] / 2};
    Plot plot{"uniformity_bands",
              "Luminance across one lens pitch, seen on axis",
              "place from the lens's axis, mm",
              "of the panel's",
              {}};
    DataTable table{"uniformity_bands", {}};
    const std::array<double, 2> foreseen = band_contrast(s.display(), s.geometry());
    Json& json = result.figures["bands"];
    for (int axis = 0; axis < imaging_axes(s.display().array); ++axis) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        const std::vector<Sums> profile = pitch.profile(axis);
        const Estimate contrast = michelson(profile);
        const double theory = foreseen[std::size_t(axis)];
        add_figure(json, name + "_contrast", contrast);
        json["theory_" + name + "_contrast"] = number_json(theory);
        result.findings.push_back({fmt::format("Dark bands at lens joints, {}: Michelson contrast", name),
                                   "",
                                   {contrast.value},
                                   {theory},
                                   "across one pitch, averaged along the other axis",
                                   {contrast.error}});
        std::vector<double> places;
        for (int k = 0; k < side; ++k) places.push_back(half[axis] * ((2 * k + 1.) / side - 1));
        if (axis == 0 || half[1] != half[0]) table.columns.push_back({axis == 0 ? "place_mm" : "vertical_place_mm", places});
        plot.series.push_back({name, places, means(profile)});
        table.columns.push_back({name + "_luminance", means(profile)});
    }
    add_figure(json, "dots_contrast", michelson(pitch.places));
    const std::vector<double> values = pitch.values();
    const double greatest = std::ranges::max(values);
    result.maps.push_back({"uniformity_pitch", "Luminance within one lens pitch, seen on axis", "x, mm", "y, mm", "of the panel's",
                           -half[0], half[0], -half[1], half[1], side, side, values, 0, greatest > 0 ? greatest : 1});
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

/// The mean luminance of the screen for eyes at the viewing distance, along one axis.
class LuminanceOverAngle {
  public:
    LuminanceOverAngle(const Subject& s, const EyeRays& rays, double distance)
        : rays_(rays), distance_(distance), nearest_(nearest_eye_mm(s.geometry())) {
        const int count = angle_lines_a_set * rays.more_for({0, 0, distance});
        for (int k = 0; k < independent_sets; ++k)
            sets_[std::size_t(k)] = even_choices(count, set_number(s.display().render.seed, k));
    }
    /// NaN where eyes cannot be, or see no panel through the array. Each line's mirror images in both planes are traced too.
    Sums at(int axis, double angle_deg) const {
        const double across = distance_ * std::sin(angle_deg * degree), ahead = distance_ * std::cos(angle_deg * degree);
        Sums sums;
        sums.fill(std::numeric_limits<double>::quiet_NaN());
        if (!(ahead > nearest_)) return sums;
        const Vec3d eye{axis == 0 ? across : 0, axis == 0 ? 0 : across, ahead};
        for (std::size_t k = 0; k < sets_.size(); ++k) {
            double sum = 0, lines = 0;
            for (const Choice& c : sets_[k])
                for (const double x : {-1., 1.})
                    for (const double y : {-1., 1.}) {
                        const Sight sight = rays_.look(eye, {x * c[0], y * c[1], x * c[2], y * c[3], x * c[4], y * c[5]});
                        sum += double(float(sight.light));
                        lines += sight.on_screen;
                    }
            sums[k] = sum / lines;
        }
        return sums;
    }
    /// The angle, between one brighter than half the middle and one darker, at which luminance is half of that in the middle.
    Estimate half_deg(int axis, double bright, double dark) const {
        const Sums middle = at(axis, 0);
        const auto excess = [&](const Sums& here, int without) { return total(here, without) - 0.5 * total(middle, without); };
        const Sums first = at(axis, bright), last = at(axis, dark);
        const double slope = (excess(last, -1) - excess(first, -1)) / (dark - bright);
        Sums here{};
        for (int halved = 0; halved < 7; ++halved) {
            here = at(axis, 0.5 * (bright + dark));
            (excess(here, -1) >= 0 ? bright : dark) = 0.5 * (bright + dark);
        }
        const Estimate noise =
            jackknife([&](int without) { return excess(here, without) * independent_sets / (independent_sets - (without >= 0)); });
        return {0.5 * (bright + dark), std::hypot(noise.error / slope, 0.5 * (dark - bright))};
    }

  private:
    const EyeRays& rays_;
    double distance_, nearest_;
    std::array<std::vector<Choice>, independent_sets> sets_;
};

/// From the middle to one side (-1 or 1), where the luminance first falls below half of that on axis; NaN: nowhere.
Estimate half_luminance(const LuminanceOverAngle& luminance, int axis, const std::vector<double>& angles,
                        const std::vector<double>& light, int side) {
    const int middle = int(angles.size() / 2), count = int(angles.size());
    for (int k = middle + side; k >= 0 && k < count && !std::isnan(light[std::size_t(k)]); k += side)
        if (light[std::size_t(k)] < 0.5 * light[std::size_t(middle)])
            return luminance.half_deg(axis, angles[std::size_t(k - side)], angles[std::size_t(k)]);
    return {nan, nan};
}

void add_angles(Result& result, Subject& s, const EyeRays& rays, double distance, Parts& parts) {
    const std::vector<double> angles = angles_deg();
    const LuminanceOverAngle luminance(s, rays, distance);
    Plot plot{
        "uniformity_angle", "Mean luminance of a white screen", "viewing angle, degrees", "of the panel's along its normal", {}};
    DataTable table{"uniformity_angle", {{"angle_deg", angles}}};
    Json& json = result.figures["angle"];
    for (const int axis : {0, 1}) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        std::vector<double> light(angles.size());
        parts.run(int(angles.size()),
                  [&](int k) { light[std::size_t(k)] = total(luminance.at(axis, angles[std::size_t(k)])) / independent_sets; });
        const Estimate low = half_luminance(luminance, axis, angles, light, -1),
                       high = half_luminance(luminance, axis, angles, light, 1);
        json[name + "_half_luminance_deg"] = numbers_json({low.value, high.value});
        json[name + "_half_luminance_deg_error"] = numbers_json({low.error, high.error});
        std::string missing;
        if (std::isnan(low.value + high.value)) {
            missing = light[angles.size() / 2] > 0
                          ? fmt::format("more than half as far as eyes can be, or to {:.0f} degrees", last_deg)
                          : "the screen is dark on axis";
            result.note("angle." + name + "_half_luminance_deg", missing);
        }
        result.findings.push_back({fmt::format("Half the luminance on axis, {}", name),
                                   "deg",
                                   {low.value, high.value},
                                   {},
                                   missing.empty() ? "mean over the screen, at the viewing distance" : missing,
                                   {low.error, high.error}});
        plot.series.push_back({name, angles, light});
        table.columns.push_back({name + "_luminance", std::move(light)});
    }
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

void add_budget(Result& result, const std::array<LightBudget, independent_sets>& budgets) {
    const auto share = [&](double LightBudget::*part, double LightBudget::*whole) {
        Estimate found = jackknife([&](int without) {
            const LightBudget b = mean_budget(budgets, without);
            return b.*whole > 0 ? b.*part / (b.*whole) : 0;
        });
        found.value = std::min(found.value, 1.);  // both are sums over random rays, and no part is more than the whole
        return found;
    };
    const Estimate efficiency = share(&LightBudget::leaves, &LightBudget::reaches_array),
                   within = share(&LightBudget::leaves_in_fov, &LightBudget::reaches_array);
    Json& json = result.figures["light"];
    add_figure(json, "efficiency", efficiency);
    add_figure(json, "efficiency_within_fov", within);
    add_figure(json, "efficiency_of_panel", share(&LightBudget::leaves, &LightBudget::emitted));
    add_figure(json, "share_reaching_array", share(&LightBudget::reaches_array, &LightBudget::emitted));
    result.findings.push_back({"Light efficiency",
                               "",
                               {efficiency.value},
                               {},
                               "of the panel's light that reaches the array: what leaves to the viewer's side, in any direction",
                               {efficiency.error}});
    result.findings.push_back({"Light efficiency within the field of view",
                               "",
                               {within.value},
                               {},
                               "what leaves with slopes within p/2g",
                               {within.error}});
}

}  // namespace

std::int64_t uniformity_steps(const Subject& s) { return pictures_worth(s, 7'000'000 + colour_work(s).lines); }

Result measure_uniformity(Subject& s, Job& job) {
    const double distance = checked_viewing_distance_mm(s);
    const EyeRays rays(s.display(), s.geometry());
    const int angles = int(angles_deg().size());
    Parts parts(job, s.threads(),
                screen_luminance_parts(s.display(), s.geometry()) + pitch_luminance_parts + 2 * angles + light_budget_parts +
                    colour_work(s).parts,
                uniformity_steps(s));
    const Vec3d eye{0, 0, distance};
    Result result;
    result.figures["viewing_distance_mm"] = distance;
    add_screen(result, screen_luminance(rays, s.display(), s.geometry(), eye, parts), s, distance);
    add_bands(result, pitch_luminance(rays, s.display(), s.geometry(), eye, parts), s);
    add_angles(result, s, rays, distance, parts);
    add_budget(result, light_budgets(s.display(), s.geometry(), parts));
    tell_colour_uniformity(s, distance, parts, result);
    show_white_fringes(s, job, result);
    result.remarks.push_back(
        "A lens passes on the panel's radiance: luminance falls only by reflection and where lines of sight end beside a lens or "
        "the panel. Light efficiency is a different measure: light leaves in all directions, most of it to where no viewer is.");
    return result;
}

}  // namespace lfdsim
