// The measure of uniformity: figures, maps and texts. docs/measures.md, "Uniformity and efficiency".

#include "analysis/uniformity/uniformity.h"

#include "analysis/resolution/fringes.h"
#include "analysis/uniformity/efficiency.h"
#include "analysis/uniformity/luminance_over_angle.h"
#include "analysis/uniformity/luminance_theory.h"
#include "analysis/uniformity/uniformity_colour.h"
#include "geometry/dark_bands.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim {
namespace {

/// Adds the luminance over the screen, with theory.
void add_screen(Result& result, const ScreenLuminance& screen, const Subject& s, double distance) {
    const Geometry& g = s.geometry();
    const double greatest = screen.greatest();
    const Estimate mean = screen.mean(), percent = screen.uniformity_percent(false), inside = screen.uniformity_percent(true);
    const TheoryFigure theory = luminance_over_panel(s.display(), g, distance);
    result.add("screen.luminance_over_panel", mean,
               {.label = "Luminance of the screen on axis over the panel's",
                .theory = {theory.value, theory.missing},
                .theory_path = "screen.theory_luminance_over_panel",
                .remark = "mean over the screen; theory: the share of lines of sight towards the array that a lens directs to the "
                          "panel, times the transmittance of its surfaces"});
    result.add("screen.least_over_panel", screen.least());
    result.add("screen.greatest_over_panel", greatest);
    result.add("screen.uniformity_percent", percent,
               {.label = "Uniformity on axis, 100 Lmin / Lmax", .unit = "%", .remark = "of means over whole lenses"});
    result.add("screen.uniformity_inner_percent", inside,
               {.label = "Uniformity on axis, middle 80 % of width and height",
                .unit = "%",
                .remark = "minimum in that part over the maximum of the whole screen"});
    if (std::isnan(mean.value)) result.note("screen.luminance_over_panel", "the eye sees no panel through the array");
    const std::string few = "none of the areas in which luminance is compared has half of its area in front of the panel";
    if (std::isnan(percent.value)) result.note("screen.uniformity_percent", few);
    if (std::isnan(inside.value)) result.note("screen.uniformity_inner_percent", few);
    const auto [width, height] = screen.size_mm;
    result.maps.push_back({"uniformity_screen", "Luminance of a white screen, seen on axis", "x along the array, mm", "y, mm",
                           "of the panel's", -width / 2, width / 2, -height / 2, height / 2, screen.columns, screen.rows,
                           screen.values(), 0, greatest > 0 ? greatest : 1});
    DataTable table = DataTable::of_rows("uniformity_screen", {"column", "row", "luminance"});
    for (int k = 0; k < screen.columns * screen.rows; ++k)
        table.add_row({double(k % screen.columns), double(k / screen.columns), screen.values()[std::size_t(k)]});
    result.tables.push_back(std::move(table));
    if (s.display().diffuser && percent.value < 90)
        result.remarks.push_back(
            "The diffuser scatters lines of sight near the array's border past the array, so the border is dim; the figure for the "
            "middle 80 % excludes it.");
}

/// Adds the dark bands between lenses: contrast along each imaging axis, and over all positions of the pitch (dots).
void add_bands(Result& result, const PitchLuminance& pitch, const Subject& s) {
    constexpr int side = PitchLuminance::side;
    const Lattice<double>& lattice = s.geometry().lattice;
    const double half[] = {lattice.pitch[0] / 2, lattice.pitch[lattice.strips ? 0 : 1] / 2};
    Plot plot{"uniformity_bands",
              "Luminance across one lens pitch, seen on axis",
              "position from the lens's axis, mm",
              "of the panel's",
              {}};
    DataTable table{"uniformity_bands", {}};
    const std::array<double, 2> theory = band_contrast(s.display(), s.geometry());
    for (int axis = 0; axis < imaging_axes(s.display().array); ++axis) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        const std::vector<Sums> profile = pitch.profile(axis);
        result.add("bands." + name + "_contrast", michelson(profile),
                   {.label = fmt::format("Dark bands at lens joints, {}: Michelson contrast", name),
                    .theory = theory[std::size_t(axis)],
                    .theory_path = "bands.theory_" + name + "_contrast",
                    .remark = "across one pitch, averaged along the other axis"});
        std::vector<double> places;
        for (int k = 0; k < side; ++k) places.push_back(half[axis] * ((2 * k + 1.) / side - 1));
        if (axis == 0 || half[1] != half[0]) table.columns.push_back({axis == 0 ? "place_mm" : "vertical_place_mm", places});
        plot.series.push_back({name, places, means(profile)});
        table.columns.push_back({name + "_luminance", means(profile)});
    }
    result.add("bands.dots_contrast", michelson(pitch.places));
    const std::vector<double> values = pitch.values();
    const double greatest = std::ranges::max(values);
    result.maps.push_back({"uniformity_pitch", "Luminance within one lens pitch, seen on axis", "x, mm", "y, mm", "of the panel's",
                           -half[0], half[0], -half[1], half[1], side, side, values, 0, greatest > 0 ? greatest : 1});
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

/// Adds the luminance over viewing angle.
void add_angles(Result& result, Subject& s, const EyeRays& rays, double distance, Parts& parts) {
    const std::vector<double> angles = luminance_angles_deg();
    const LuminanceOverAngle luminance(s, rays, distance);
    Curves curves("uniformity_angle", "Mean luminance of a white screen", "viewing angle, degrees",
                  "of the panel's along its normal", {"angle_deg", angles});
    for (const int axis : {0, 1}) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        std::vector<double> light(angles.size());
        parts.run(int(angles.size()),
                  [&](int k) { light[std::size_t(k)] = total(luminance.at(axis, angles[std::size_t(k)])) / independent_sets; });
        FigureValue half(luminance.half_deg(axis, angles, light, -1), luminance.half_deg(axis, angles, light, 1));
        if (std::isnan(half.numbers[0] + half.numbers[1]))
            half.missing =
                light[angles.size() / 2] > 0
                    ? fmt::format("luminance stays above half up to where eyes can be, or to {:.0f} degrees", angles.back())
                    : "the screen is dark on axis";
        result.add("angle." + name + "_half_luminance_deg", half,
                   {.label = fmt::format("Half the luminance on axis, {}", name),
                    .unit = "deg",
                    .remark = "mean over the screen, at the viewing distance"});
        curves.add(name, name + "_luminance", std::move(light));
    }
    result.add(std::move(curves));
}

/// Adds the light efficiency.
void add_budget(Result& result, const std::array<LightBudget, independent_sets>& budgets) {
    const auto share = [&](double LightBudget::*part, double LightBudget::*whole) {
        Estimate found = jackknife([&](int without) {
            const LightBudget b = mean_budget(budgets, without);
            return b.*whole > 0 ? b.*part / (b.*whole) : 0;
        });
        // Part and whole are sums over random rays, so that their ratio may exceed 1 by noise.
        found.value = std::min(found.value, 1.);
        return found;
    };
    result.add("light.efficiency", share(&LightBudget::leaves, &LightBudget::reaches_array),
               {.label = "Light efficiency",
                .remark = "share of the panel's light reaching the array that leaves to the viewer's side, in any direction"});
    result.add("light.efficiency_within_fov", share(&LightBudget::leaves_in_fov, &LightBudget::reaches_array),
               {.label = "Light efficiency within the field of view", .remark = "share that leaves with slopes within p/2g"});
    result.add("light.efficiency_of_panel", share(&LightBudget::leaves, &LightBudget::emitted));
    result.add("light.share_reaching_array", share(&LightBudget::reaches_array, &LightBudget::emitted));
}

}  // namespace

std::int64_t uniformity_steps(const Subject& s) { return pictures_worth(s, 7'000'000 + colour_work(s).lines); }

Result measure_uniformity(Subject& s, Job& job) {
    const double distance = checked_viewing_distance_mm(s);
    const EyeRays rays(s.display(), s.geometry());
    const int angles = int(luminance_angles_deg().size());
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
        "A lens conserves the panel's radiance: luminance is lost only by reflection and where lines of sight end beside a lens or "
        "the panel. Light efficiency is a different measure: light leaves in all directions, most of it to where there is no "
        "viewer.");
    return result;
}

}  // namespace lfdsim
