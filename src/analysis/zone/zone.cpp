// The measure of the viewing zone: figures, maps and plots. docs/measures.md, "Viewing zone".

#include "analysis/zone/zone.h"

#include "analysis/crosstalk/slope_spread.h"
#include "analysis/zone/zone_search.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr const char* missing = "Rays that miss their own lens's elemental image";

/// Adds maps of the shares over viewer positions, as far as `half` mm from the middle along x and y, and their table.
void add_maps(Result& result, const std::vector<SightShares>& shares, const std::array<double, 2>& half) {
    constexpr int side = ZoneSearch::map_side;
    const auto add = [&](const char* name, const char* title, double SightShares::*share) {
        std::vector<double> values;
        for (const SightShares& s : shares) values.push_back(s.*share);
        result.maps.push_back({name, title, "viewer position x, mm", "y, mm", "share", -half[0], half[0], -half[1], half[1], side,
                               side, std::move(values), 0, 1});
    };
    add("zone", missing, &SightShares::wrong);
    add("zone_mixed", "Rays that show another neighbour's image than most", &SightShares::mixed);
    add("zone_dark", "Rays that end dark", &SightShares::dark);
    DataTable table = DataTable::of_rows("zone_map", {"x_mm", "y_mm", "wrong_share", "mixed_share", "dark_share"});
    for (int k = 0; k < side * side; ++k) {
        const auto [wrong, mixed, dark] = shares[std::size_t(k)];
        table.add_row({ZoneSearch::map_place(k % side, half[0]), -ZoneSearch::map_place(k / side, half[1]), wrong, mixed, dark});
    }
    result.tables.push_back(std::move(table));
}

/// Adds the zone along x and y, searched as far as `half` mm.
void add_sideways(Result& result, ZoneSearch& search, const Subject& s, const std::array<double, 2>& half, double distance) {
    const double eye = distance - s.geometry().rear_principal_mm;
    Plot plot{"zone", missing, "viewer position, degrees", "share of rays", {}};
    DataTable table{"zone", {}};
    const auto degrees = [&](double mm) { return std::atan(mm / eye) / degree; };
    const Lattice<double>& lattice = s.geometry().lattice;
    const std::size_t line = line_of_eyes(lattice);
    const auto name_of = [](std::size_t axis) { return axis == 0 ? "horizontal" : "vertical"; };
    if (lattice.strips) result.add(name_of(1 - line), FigureValue::none(same_from_both_sides(lattice)));
    for (std::size_t axis = line; axis < (lattice.strips ? line + 1 : 2); ++axis) {
        const std::string name = name_of(axis);
        const Zone zone = search.sideways(axis, half[axis]);
        std::vector<double> angles;
        for (const double mm : zone.places) angles.push_back(degrees(mm));
        const ParaxialZone zone_of = paraxial_zone(s, lattice.strips ? 0 : axis);
        const double theory = degrees(eye * zone_of.half_slope(eye)), half_fov = degrees(eye * zone_of.half_fov);
        // Theory is of an image p' high; that of a hexagon has a corner above its middle, beyond that.
        const bool corner = axis == 1 && height_per_pitch(s.geometry()) > 1;
        result.add(name + ".theory_deg",
                   corner ? FigureValue::none("theory is of images as high as wide; those of hexagons have corners above and below")
                          : FigureValue(std::vector{0 - theory, theory}));
        for (const std::size_t t : {0u, 1u}) {
            const Interval& mm = zone.limits[t];
            const Interval deg = mapped(mm, degrees);
            const std::string percent = fmt::format("{:g}", 100 * zone_thresholds[t]),
                              path = name + ".wrong_" + percent + "_percent_";
            result.add(path + "mm", figure_of(mm));
            result.add(path + "deg", figure_of(deg),
                       {.label = fmt::format("Viewing zone, {}: at most {} % of the rays wrong", name, percent),
                        .unit = "deg",
                        .theory = corner ? FigureValue() : std::vector{t == 0 ? 0 - theory : -half_fov, t == 0 ? theory : half_fov},
                        .remark = fmt::format("{:.4g} to {:.4g} mm", mm.low.at, mm.high.at)});
        }
        if (axis == line) {
            table.columns = {{"place_mm", zone.places}, {"place_deg", angles}};
            plot.marks = {{"theory, " + name, 0 - theory}, {"theory, " + name, theory}, {"1 %", 0.01, false}};
        }
        if (axis == 1 && differs_by_axis(s.display().array)) {
            table.columns.push_back({"vertical_place_mm", zone.places});
            table.columns.push_back({"vertical_place_deg", angles});
        }
        table.columns.push_back({name + "_wrong_share", zone.all(&SightShares::wrong)});
        table.columns.push_back({name + "_mixed_share", zone.all(&SightShares::mixed)});
        table.columns.push_back({name + "_dark_share", zone.all(&SightShares::dark)});
        plot.series.push_back({name, angles, zone.all(&SightShares::wrong)});
        plot.series.push_back({name + ", mixed", angles, zone.all(&SightShares::mixed)});
        plot.series.push_back({name + ", dark", angles, zone.all(&SightShares::dark)});
    }
    result.tables.push_back(std::move(table));
    result.plots.push_back(std::move(plot));
}

/// Adds the zone along the display's axis.
void add_axis(Result& result, ZoneSearch& search, const Subject& s, double distance) {
    const double rear = s.geometry().rear_principal_mm;
    // The display's zone along the axis is the shorter of those of its two axes.
    const ParaxialZone across = paraxial_zone(s, 0), up = paraxial_zone(s, imaging_axes(s.display().array) - 1);
    const ParaxialZone theory = across.reach_per_mm() <= up.reach_per_mm() ? across : up;
    const Zone zone = search.on_axis(theory);
    const std::vector<double> wrong = zone.all(&SightShares::wrong);
    const std::vector<double> by_theory{rear + theory.distance_mm(-1), rear + theory.distance_mm(1)};
    result.add("distance.wrong_1_percent_mm", figure_of(zone.limits[0]),
               {.label = "Viewing zone along the axis: at most 1 % of the rays wrong",
                .unit = "mm",
                .theory = by_theory,
                .remark = "nearest and farthest distance; the search ends at the display's front"});
    result.add("distance.wrong_50_percent_mm", figure_of(zone.limits[1]));
    result.add("distance.theory_mm", by_theory);
    Series near{"on axis", {}, {}};
    for (std::size_t k = zone.places.size(); k-- > 0 && zone.places[k] <= 4 * distance;) {
        near.x.push_back(zone.places[k]);
        near.y.push_back(wrong[k]);
    }
    result.plots.push_back(
        {"zone_distance", missing, "distance from the panel, mm", "share of rays", {std::move(near)}, {{"1 %", 0.01, false}}});
    result.tables.push_back(
        {"zone_distance", {{"distance_mm", zone.places}, {"wrong_share", wrong}, {"dark_share", zone.all(&SightShares::dark)}}});
}

/// Returns a remark if the zone is asymmetric by more than the stated errors; else an empty text.
std::string aside_remark(const Json& figures) {
    for (const char* axis : {"horizontal", "vertical"}) {
        if (figures.at(axis).is_null()) continue;
        for (const std::string name : {"wrong_1_percent_deg", "wrong_50_percent_deg"}) {
            const Json &at = figures.at(axis).at(name), &error = figures.at(axis).at(name + "_error");
            if (!at[0].is_number() || !at[1].is_number()) continue;
            const double aside = at[0].get<double>() + at[1].get<double>();
            if (std::abs(aside) > error[0].get<double>() + error[1].get<double>())
                return "The zone is not symmetric: the array is shifted or turned, or pixels whose centres lie on the border of "
                       "two elemental images belong, as whole pixels must, to the one to the right and above.";
        }
    }
    return "";
}

}  // namespace

std::int64_t zone_steps(const Subject& s) { return pictures_worth(s, 12'000'000); }

Result measure_zone(Subject& s, Job& job) {
    const double distance = checked_viewing_distance_mm(s), eye = distance - s.geometry().rear_principal_mm;
    std::array<double, 2> half;
    for (const std::size_t axis : {0u, 1u}) {
        const std::size_t imaging = std::min(axis, std::size_t(imaging_axes(s.display().array) - 1));
        half[axis] = eye * std::min(3 * paraxial_zone(s, imaging).half_fov, std::tan(80 * degree));
    }
    ZoneSearch search(s, job, zone_steps(s));
    Result result;
    result.figures["viewing_distance_mm"] = distance;
    add_sideways(result, search, s, half, distance);
    add_maps(result, search.map(half), half);
    add_axis(result, search, s, distance);
    const double spread = SlopeSpread(s, eye).width() * s.geometry().gap_mm, image = s.theory(0).elemental_pitch_mm;
    if (const std::string aside = aside_remark(result.figures); !aside.empty()) result.remarks.push_back(aside);
    result.remarks.push_back(fmt::format(
        "A ray is wrong if it passes through a lens and ends outside that lens's elemental image: on another lens's image, so that "
        "views repeat, or on none. Where all rays are wrong but few are mixed (they show another neighbour's image than most rays "
        "do), a repeated zone begins. In theory the ray through each lens's centre meets the panel within p/2 of the image's "
        "centre. An eye receives light from {:.3g} mm of the panel through one lens (its aperture and the diffuser, paraxially), "
        "which moves the limit at 1 % nearer to the middle, but not that at 50 %; images {:.4g} mm wide, {:.3f} p, move both "
        "outwards. Whole pixels and the lenses' aberrations account for the rest.",
        spread, image, image / s.geometry().lattice.pitch[0]));
    return result;
}

}  // namespace lfdsim
