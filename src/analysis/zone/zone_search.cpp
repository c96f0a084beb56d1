// The search for the limits of the viewing zone. docs/measures.md, "Viewing zone".

#include "analysis/zone/zone_search.h"

#include "base/bisection.h"
#include "geometry/screen.h"

namespace lfdsim {
namespace {

constexpr int curve_points = 181, distance_points = 61;  // odd: the middle is one of them
constexpr int map_rays = 1024, curve_rays = 4096;        // of an eye
constexpr int set_rays = 2048;                           // of each set, where limits are sought

/// Returns the wrong share at a position of the search's path (mm aside, or an inverse distance) by all sets of lines.
using Along = std::function<Estimate(double)>;

/// Returns the limit up to which, from the middle of `places` towards their end (step 1) or start (-1), the share stays at most
/// `most`, by bisection between the last position where it does and the first where it does not. The error reaches to where the
/// share does so less and plus its stated error, which is far away where the share stays near `most` for long.
Limit limit(const std::vector<double>& places, const std::vector<double>& wrong, int step, double most, const Along& wrong_at) {
    const int middle = int(places.size()) / 2, last = step > 0 ? int(places.size()) - 1 : 0;
    const auto at = [&](int k) { return places[std::size_t(k)]; };
    // The curve, by one set, tells where to start. NaN, where no light is seen, is not good.
    const auto first_good = [&](int k) { return wrong[std::size_t(k)] <= most; };
    if (!first_good(middle)) return Limit::none("more rays are wrong even in the middle");
    int in = middle;
    while (in != last && first_good(in + step)) in += step;
    if (in == last) return Limit::none("no more rays are wrong within the searched range");
    // Returns the end where the share by all sets, plus `errors` times its error, passes `most`: the search goes back from the
    // curve's limit to a good position, on to the next bad one, and halves the step between them.
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
        const Bisected end = bisected(at(next - step), at(next), halvings, good);
        if (errors == 0) precision = std::abs(end.out - end.in);
        return errors > 0 ? end.in : errors < 0 ? end.out : end.middle();
    };
    const double found = ends(0, 12), early = ends(1, 6), late = ends(-1, 6);
    return {found, precision + std::max(std::abs(found - early), std::abs(found - late)), {}};
}

/// Returns `count` positions at equal distances from low to high.
std::vector<double> even_places(double low, double high, int count) {
    std::vector<double> places;
    for (int k = 0; k < count; ++k) places.push_back(low + (high - low) * k / (count - 1));
    return places;
}

/// Returns the inverse distances, 1/mm, of the search along the axis, ascending: in the middle the distance that the images are
/// made for (the eye's, if that is infinite or inside the display), and twice the way to the paraxial zone's ends on either side.
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

}  // namespace

ParaxialZone paraxial_zone(const Subject& s, std::size_t axis) {
    const Lattice<double>& lattice = s.geometry().lattice;
    const double per = 1 / across_share(lattice);  // an eye crosses slanted strips obliquely
    const double lenses = lenses_across(s.geometry(), axis);
    return {per * s.theory().along[axis].elemental_pitch_mm / (2 * s.geometry().gap_mm),
            per * (lenses - 1) * lattice.pitch[axis] / 2, s.display().content.viewing_distance_mm - s.geometry().rear_principal_mm};
}

ZoneSearch::ZoneSearch(Subject& s, Job& job, std::int64_t steps)
    : subject_(s),
      distance_(checked_viewing_distance_mm(s)),
      rays_(s.display(), s.geometry()),
      pickup_(s.display(), s.geometry()),
      more_(rays_.more_for({0, 0, distance_})),
      parts_(job, s.threads(), map_side + 2 * (curve_points + 4) + distance_points + 4, steps) {
    for (std::uint32_t set = 0; set < independent_sets; ++set)
        choices_[set] = even_choices((set == 0 ? curve_rays : set_rays) * more_,
                                     independent_sets * std::uint32_t(s.display().render.seed) + set);
}

SightShares ZoneSearch::at(const Vec3d& eye, int rays, std::uint32_t set) const {
    return sight_shares(rays_, pickup_, subject_.display(), eye, std::span(choices_[set]).first(std::size_t(rays * more_)));
}

Zone ZoneSearch::along(std::vector<double> places, const std::function<Vec3d(double)>& eye_at) {
    Zone zone{std::move(places), {}, {}};
    zone.shares.resize(zone.places.size());
    parts_.run(int(zone.places.size()),
               [&](int k) { zone.shares[std::size_t(k)] = at(eye_at(zone.places[std::size_t(k)]), curve_rays); });
    const std::vector<double> wrong = zone.all(&SightShares::wrong);
    parts_.run(4, [&](int k) {
        Interval& limits = zone.limits[std::size_t(k / 2)];
        (k % 2 == 0 ? limits.low : limits.high) =
            limit(zone.places, wrong, k % 2 == 0 ? -1 : 1, zone_thresholds[std::size_t(k / 2)], [&](double place) {
                std::array<double, independent_sets> found;
                for (std::uint32_t set = 0; set < independent_sets; ++set) found[set] = at(eye_at(place), set_rays, set).wrong;
                return estimate(found);
            });
    });
    return zone;
}

Zone ZoneSearch::sideways(std::size_t axis, double half_mm) {
    Zone zone = along(even_places(-half_mm, half_mm, curve_points), [&](double place) {
        return axis == 0 ? Vec3d{place, 0, distance_} : Vec3d{0, place, distance_};
    });
    for (Interval& limits : zone.limits) limits = known(limits, 0);
    return zone;
}

Zone ZoneSearch::on_axis(const ParaxialZone& theory) {
    const double rear = subject_.geometry().rear_principal_mm;
    const auto from_panel = [&](double inverse) { return rear + 1 / inverse; };
    Zone zone = along(inverse_distances(subject_, distance_ - rear, theory), [&](double inverse) {
        return Vec3d{0, 0, from_panel(inverse)};
    });
    for (double& place : zone.places) place = from_panel(place);
    for (Interval& limits : zone.limits) limits = known(mapped(limits, from_panel), zone.places[zone.places.size() / 2]);
    return zone;
}

std::vector<SightShares> ZoneSearch::map(const std::array<double, 2>& half_mm) {
    std::vector<SightShares> shares(std::size_t(map_side) * map_side);
    parts_.run(map_side, [&](int row) {
        for (int column = 0; column < map_side; ++column)
            shares[std::size_t(row) * map_side + std::size_t(column)] =
                at({map_place(column, half_mm[0]), -map_place(row, half_mm[1]), distance_}, map_rays);
    });
    return shares;
}

}  // namespace lfdsim
