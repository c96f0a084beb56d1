#include "analysis/zone/zone.h"

#include "analysis/core/estimate.h"
#include "analysis/core/parallel.h"
#include "analysis/crosstalk/slope_spread.h"
#include "analysis/fov/thresholds.h"
#include "base/constants.h"
#include "geometry/screen.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>

// Lines of sight from viewers about the zone, and whose elemental images they end on. docs/model.md, "Viewing zone".
namespace lfdsim {
namespace {

constexpr int map_side = 61, curve_points = 181, distance_points = 61;  // odd: the middle is one of them
constexpr int map_rays = 1024, curve_rays = 4096;
constexpr std::uint32_t zone_sets = independent_sets;  // of lines of sight; the first of them draws maps and curves
constexpr int set_rays = 2048;                         // of each where limits are sought
constexpr double thresholds[] = {0.01, 0.5};
constexpr const char* missing = "Rays that miss their own lens's elemental image";

/// The share of wrong rays at a place on a search's path, lateral in mm or an inverse distance, by all sets of lines.
using Along = std::function<Estimate(double)>;

/// How far, from the middle of `places` towards their end (step 1) or start (-1), the share stays at most `most`: bisected between
/// the last place where it does and the first where it does not. The error reaches to where the share does so less and plus its own
/// error: far apart where it stays near `most` for long.
Limit limit(const std::vector<double>& places, const std::vector<double>& wrong, int step, double most, const Along& wrong_at) {
    const int middle = int(places.size()) / 2, last = step > 0 ? int(places.size()) - 1 : 0;
    const auto at = [&](int k) { return places[std::size_t(k)]; };
    const auto first_good = [&](int k) {
        return wrong[std::size_t(k)] <= most;
    };  // by one set; NaN: nothing is seen, which is not good
    Limit none;
    if (!first_good(middle)) {
        none.missing = "more are wrong even in the middle";
        return none;
    }
    int in = middle;
    while (in != last && first_good(in + step)) in += step;
    if (in == last) {
        none.missing = "no more are wrong as far as was searched";
        return none;
    }
    double precision = 0;
    const auto ends = [&](double errors, int halvings) {
        const auto good = [&](double place) {
            const Estimate share = wrong_at(place);
            return share.value + errors * share.error <= most;
        };
        int k = in;
        while (k != middle && !good(at(k))) k -= step;
        int next = k + step;
        while (next != last && good(at(next))) next += step;
        double inside = at(next - step), outside = at(next);
        for (int n = 0; n < halvings; ++n) {
            const double half_way = 0.5 * (inside + outside);
            (good(half_way) ? inside : outside) = half_way;
        }
        if (errors == 0) precision = std::abs(outside - inside);
        return errors > 0 ? inside : errors < 0 ? outside : 0.5 * (inside + outside);
    };
    const double found = ends(0, 12), early = ends(1, 6), late = ends(-1, 6);
    return {found, precision + std::max(std::abs(found - early), std::abs(found - late)), {}};
}

std::vector<double> even_places(double low, double high, int count) {
    std::vector<double> places;
    for (int k = 0; k < count; ++k) places.push_back(low + (high - low) * k / (count - 1));
    return places;
}

/// The paraxial zone of m lenses: slopes of viewers at distance eye_mm from H', made for made_for_mm; and the inverse distances.
struct ParaxialZone {
    double half_fov, fault_per_mm;  // p'/2g; (m - 1) p/2 per difference of inverse distances
    double made_for_mm;
    double half_slope(double eye_mm) const {
        return std::max(half_fov - fault_per_mm * std::abs(1 / eye_mm - 1 / made_for_mm), 0.);
    }
    double reach_per_mm() const { return half_fov / fault_per_mm; }
    double distance_mm(int side) const {  // -1: the nearest, 1: the farthest
        const double inverse = 1 / made_for_mm - side * reach_per_mm();
        return inverse > 0 ? 1 / inverse : infinity;
    }
};

ParaxialZone paraxial(const Subject& s, std::size_t axis) {
    const Lattice<double>& lattice = s.geometry().lattice;
    // Strips are crossed obliquely by an eye that moves along x.
    const double per = lattice.strips ? 1 / lattice.cos_turn : 1;
    const double lenses = lenses_across(s.geometry(), axis);
    return {per * s.theory().along[axis].elemental_pitch_mm / (2 * s.geometry().gap_mm),
            per * (lenses - 1) * lattice.pitch[axis] / 2, s.display().content.viewing_distance_mm - s.geometry().rear_principal_mm};
}

/// Places of the search along the axis: the distance that the images are made for (the eye's, if that is none) in the middle, and
/// twice the way to the zone's ends on either side.
std::vector<double> inverse_distances(const Subject& s, double eye, const ParaxialZone& theory) {
    const double nearest = 1 / (1.001 * nearest_eye_mm(s.geometry()) - s.geometry().rear_principal_mm);
    const double made_for = 1 / theory.made_for_mm, middle = made_for > 1e-7 && made_for < nearest ? made_for : 1 / eye;
    const double reach = 2 * theory.reach_per_mm();
    const double low = std::min(std::max(middle - reach, 1e-7), middle), high = std::max(std::min(middle + reach, nearest), middle);
    std::vector<double> places = even_places(low, middle, distance_points / 2 + 1);
    const std::vector<double> upper = even_places(middle, high, distance_points / 2 + 1);
    places.insert(places.end(), upper.begin() + 1, upper.end());
    return places;
}

struct Zone {
    std::vector<double> places, wrong, mixed, dark;
    std::array<Interval, 2> limits;  // by threshold
};

class Search {
  public:
    Search(Subject& s, Job& job)
        : display_(s.display()),
          rays_(s.display(), s.geometry()),
          pickup_(s.display(), s.geometry()),
          more_(rays_.more_for({0, 0, s.viewing_distance_mm()})),
          choices_([&] {
              std::array<std::vector<Choice>, zone_sets> all;
              for (std::uint32_t set = 0; set < zone_sets; ++set)
                  all[set] = even_choices((set == 0 ? curve_rays : set_rays) * more_,
                                          zone_sets * std::uint32_t(s.display().render.seed) + set);
              return all;
          }()),
          parts(job, s.threads(), map_side + 2 * (curve_points + 4) + distance_points + 4, zone_steps(s)) {}

    SightShares at(const Vec3d& eye, int rays, std::uint32_t set = 0) const {
        return sight_shares(rays_, pickup_, display_, eye, std::span(choices_[set]).first(std::size_t(rays * more_)));
    }

    /// Along the eyes that `eye_at` gives.
    Zone along(std::vector<double> places, const std::function<Vec3d(double)>& eye_at) {
        Zone zone{std::move(places), {}, {}, {}, {}};
        zone.wrong.resize(zone.places.size());
        zone.mixed.resize(zone.places.size());
        zone.dark.resize(zone.places.size());
        parts.run(int(zone.places.size()), [&](int k) {
            const SightShares shares = at(eye_at(zone.places[std::size_t(k)]), curve_rays);
            zone.wrong[std::size_t(k)] = shares.wrong;
            zone.mixed[std::size_t(k)] = shares.mixed;
            zone.dark[std::size_t(k)] = shares.dark;
        });
        parts.run(4, [&](int k) {
            Interval& limits = zone.limits[std::size_t(k / 2)];
            (k % 2 == 0 ? limits.low : limits.high) =
                limit(zone.places, zone.wrong, k % 2 == 0 ? -1 : 1, thresholds[k / 2], [&](double place) {
                    std::array<double, zone_sets> found;
                    for (std::uint32_t set = 0; set < zone_sets; ++set) found[set] = at(eye_at(place), set_rays, set).wrong;
                    return estimate(found);
                });
        });
        return zone;
    }

  private:
    const Display& display_;
    EyeRays rays_;
    Pickup pickup_;
    int more_;
    std::array<std::vector<Choice>, zone_sets> choices_;

  public:
    Parts parts;
};

/// The same limits by another measure of the place, rising or falling; errors to first order.
template <class Map>
Interval mapped(const Interval& from, Map map) {
    const auto limit = [&](const Limit& l) {
        return Limit{map(l.at), 0.5 * std::abs(map(l.at + l.error) - map(l.at - l.error)), l.missing};
    };
    const Interval to{limit(from.low), limit(from.high)};
    return map(1.) > map(0.5) ? to : Interval{to.high, to.low};
}

void add_map(Result& result, Search& search, const std::array<double, 2>& half, double distance) {
    ColourMap wrong{
        "zone", missing, "viewer's place x, mm", "y, mm", "share", -half[0], half[0], -half[1], half[1], map_side, map_side, {},
        0,      1};
    wrong.values.resize(std::size_t(map_side) * map_side);
    ColourMap dark = wrong;
    dark.name = "zone_dark";
    dark.title = "Rays that end dark";
    ColourMap mixed = wrong;
    mixed.name = "zone_mixed";
    mixed.title = "Rays that show another neighbour's image than most";
    const auto place = [&](int k, std::size_t axis) { return half[axis] * ((2 * k + 1.) / map_side - 1); };
    search.parts.run(map_side, [&](int row) {
        for (int column = 0; column < map_side; ++column) {
            const std::size_t k = std::size_t(row) * map_side + std::size_t(column);
            const SightShares shares = search.at({place(column, 0), -place(row, 1), distance}, map_rays);
            wrong.values[k] = shares.wrong;
            mixed.values[k] = shares.mixed;
            dark.values[k] = shares.dark;
        }
    });
    DataTable table = DataTable::of_rows("zone_map", {"x_mm", "y_mm", "wrong_share", "mixed_share", "dark_share"});
    for (int k = 0; k < map_side * map_side; ++k)
        table.add_row({place(k % map_side, 0), -place(k / map_side, 1), wrong.values[std::size_t(k)], mixed.values[std::size_t(k)],
                       dark.values[std::size_t(k)]});
    result.tables.push_back(std::move(table));
    result.maps.push_back(std::move(wrong));
    result.maps.push_back(std::move(mixed));
    result.maps.push_back(std::move(dark));
}

/// Horizontally and vertically, as far as `half` mm.
void add_sideways(Result& result, Search& search, const Subject& s, const std::array<double, 2>& half, double distance) {
    const double eye = distance - s.geometry().rear_principal_mm;
    Plot plot{"zone", missing, "viewer's place, degrees", "share of rays", {}};
    DataTable table{"zone", {}};
    const auto degrees = [&](double mm) { return std::atan(mm / eye) / degree; };
    if (is_strips(s.display().array)) {
        result.figures["vertical"] = Json();
        result.note("vertical", "strips show the same from above and from below");
    }
    for (std::size_t axis = 0; axis < std::size_t(imaging_axes(s.display().array)); ++axis) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        const Zone zone = search.along(even_places(-half[axis], half[axis], curve_points), [&](double place) {
            return axis == 0 ? Vec3d{place, 0, distance} : Vec3d{0, place, distance};
        });
        std::vector<double> angles;
        for (const double mm : zone.places) angles.push_back(degrees(mm));
        const ParaxialZone zone_of = paraxial(s, axis);
        const double theory = degrees(eye * zone_of.half_slope(eye)), half_fov = degrees(eye * zone_of.half_fov);
        // A hexagon's image has a corner above its middle, where theory's pitch has none.
        const bool corner = axis == 1 && s.display().array.lattice == LatticeKind::hexagon;
        result.figures[name]["theory_deg"] = corner ? Json() : Json{0 - theory, theory};
        for (const std::size_t t : {0u, 1u}) {
            const Interval mm = known(zone.limits[t], 0);
            const Interval deg = mapped(mm, degrees);
            const std::string percent = fmt::format("{:g}", 100 * thresholds[t]), path = name + ".wrong_" + percent + "_percent_";
            result.add(path + "mm", figure_of(mm));
            result.add(path + "deg", figure_of(deg),
                       {.label = fmt::format("Viewing zone, {}: at most {} % of the rays wrong", name, percent),
                        .unit = "deg",
                        .theory = corner ? FigureValue() : std::vector{t == 0 ? 0 - theory : -half_fov, t == 0 ? theory : half_fov},
                        .remark = fmt::format("{:.4g} to {:.4g} mm", mm.low.at, mm.high.at)});
        }
        if (axis == 0) {
            table.columns = {{"place_mm", zone.places}, {"place_deg", angles}};
            plot.marks = {{"theory, horizontal", 0 - theory}, {"theory, horizontal", theory}, {"1 %", 0.01, false}};
        }
        if (axis == 1 && differs_by_axis(s.display().array)) {
            table.columns.push_back({"vertical_place_mm", zone.places});
            table.columns.push_back({"vertical_place_deg", angles});
        }
        table.columns.push_back({name + "_wrong_share", zone.wrong});
        table.columns.push_back({name + "_mixed_share", zone.mixed});
        table.columns.push_back({name + "_dark_share", zone.dark});
        plot.series.push_back({name, angles, zone.wrong});
        plot.series.push_back({name + ", mixed", angles, zone.mixed});
        plot.series.push_back({name + ", dark", angles, zone.dark});
    }
    result.tables.push_back(std::move(table));
    result.plots.push_back(std::move(plot));
}

void add_axis(Result& result, Search& search, const Subject& s, double distance) {
    const double rear = s.geometry().rear_principal_mm;
    const ParaxialZone across = paraxial(s, 0),
                       up = paraxial(s, imaging_axes(s.display().array) - 1);  // the shorter is the display's
    const ParaxialZone theory = across.reach_per_mm() <= up.reach_per_mm() ? across : up;
    const auto from_panel = [&](double inverse) { return rear + 1 / inverse; };
    Zone zone = search.along(inverse_distances(s, distance - rear, theory), [&](double inverse) {
        return Vec3d{0, 0, from_panel(inverse)};
    });
    for (double& place : zone.places) place = from_panel(place);
    const double middle = zone.places[zone.places.size() / 2];
    const double theory_nearest = rear + theory.distance_mm(-1), theory_farthest = rear + theory.distance_mm(1);
    const std::array<Interval, 2> limits{known(mapped(zone.limits[0], from_panel), middle),
                                         known(mapped(zone.limits[1], from_panel), middle)};
    const std::vector<double> by_theory{theory_nearest, theory_farthest};
    result.add("distance.wrong_1_percent_mm", figure_of(limits[0]),
               {.label = "Viewing zone along the axis: at most 1 % of the rays wrong",
                .unit = "mm",
                .theory = by_theory,
                .remark = "nearest and farthest, as far as the display's front"});
    result.add("distance.wrong_50_percent_mm", figure_of(limits[1]));
    result.add("distance.theory_mm", by_theory);
    Series near{"on axis", {}, {}};
    for (std::size_t k = zone.places.size(); k-- > 0 && zone.places[k] <= 4 * distance;) {
        near.x.push_back(zone.places[k]);
        near.y.push_back(zone.wrong[k]);
    }
    result.plots.push_back(
        {"zone_distance", missing, "distance from the panel, mm", "share of rays", {std::move(near)}, {{"1 %", 0.01, false}}});
    result.tables.push_back(
        {"zone_distance", {{"distance_mm", zone.places}, {"wrong_share", zone.wrong}, {"dark_share", zone.dark}}});
}

/// Why a zone is not symmetric, where it is not by more than the stated errors.
std::string aside_remark(const Json& figures) {
    for (const char* axis : {"horizontal", "vertical"}) {
        if (figures.at(axis).is_null()) continue;
        for (const std::string name : {"wrong_1_percent_deg", "wrong_50_percent_deg"}) {
            const Json &at = figures.at(axis).at(name), &error = figures.at(axis).at(name + "_error");
            if (!at[0].is_number() || !at[1].is_number()) continue;
            const double aside = at[0].get<double>() + at[1].get<double>();
            if (std::abs(aside) > error[0].get<double>() + error[1].get<double>())
                return "The zone is not symmetric: the array is shifted or turned, or pixels whose centres lie on the border of "
                       "two "
                       "elemental images belong, as whole pixels must, to the one to the right and above.";
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
        half[axis] = eye * std::min(3 * paraxial(s, imaging).half_fov, std::tan(80 * degree));
    }
    Search search(s, job);
    Result result;
    result.figures["viewing_distance_mm"] = distance;
    add_sideways(result, search, s, half, distance);
    add_map(result, search, half, distance);
    add_axis(result, search, s, distance);
    const double spread = SlopeSpread(s, eye).width() * s.geometry().gap_mm, image = s.theory(0).elemental_pitch_mm;
    if (const std::string aside = aside_remark(result.figures); !aside.empty()) result.remarks.push_back(aside);
    result.remarks.push_back(fmt::format(
        "A ray is wrong if it comes through a lens and ends elsewhere than on that lens's elemental image: on another's, so that "
        "views repeat, or on none. Where all are wrong but few are mixed (show another neighbour's image than most do) a repeated "
        "zone "
        "begins. Theory follows the ray through each lens's centre to a place within p/2 of the image's centre. "
        "An eye gathers light from {:.3g} mm of the panel through one lens (its aperture and the diffuser, paraxially), so the "
        "limit at 1 % lies nearer to the middle, that at 50 % does not; images {:.4g} mm wide, {:.3f} p, put both farther out. "
        "Whole pixels and the lenses' aberrations account for the rest.",
        spread, image, image / s.display().array.pitch_mm[0]));
    return result;
}

}  // namespace lfdsim
