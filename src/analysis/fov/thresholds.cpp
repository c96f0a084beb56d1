#include "analysis/fov/thresholds.h"

#include "base/constants.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace lfdsim {
namespace {

/// Returns the curve's value at a position, interpolated linearly, and beyond its ends that of the end.
double value_at(const Curve& c, double place) {
    const auto after = std::upper_bound(c.at.begin(), c.at.end(), place);
    if (after == c.at.begin()) return c.value.front();
    if (after == c.at.end()) return c.value.back();
    const std::size_t k = std::size_t(after - c.at.begin());
    const double t = (place - c.at[k - 1]) / (c.at[k] - c.at[k - 1]);
    return c.value[k - 1] + t * (c.value[k] - c.value[k - 1]);
}

/// Returns where the line between two points, the first at or above the level, the other below it, crosses the level. The error
/// is the noise over the slope, and half the distance of the points.
Limit crossing(const Curve& c, double at, double value, double next, double next_value, double level) {
    const double slope = (next_value - value) / (next - at);
    return {at + (level - value) / slope, std::hypot(c.error / slope, 0.5 * (next - at))};
}

/// Returns the first position, from the centre to one side, at which the curve falls below the level.
Limit first_below(const Curve& c, double centre, int side, double level) {
    double at = std::clamp(centre, c.at.front(), c.at.back()), value = value_at(c, at);
    const int count = int(c.at.size());
    int k = int(std::upper_bound(c.at.begin(), c.at.end(), at) - c.at.begin());  // the first after
    if (side < 0) k = int(std::lower_bound(c.at.begin(), c.at.end(), at) - c.at.begin()) - 1;
    for (; k >= 0 && k < count; k += side) {
        const double next = c.at[std::size_t(k)], next_value = c.value[std::size_t(k)];
        if (next_value < level) return crossing(c, at, value, next, next_value, level);
        at = next;
        value = next_value;
    }
    Limit none = Limit::none(fmt::format("the criterion is still met at {:.4g}, where the search ended", at));
    none.holds_to = at;
    none.searched_out = true;
    return none;
}

/// Returns the interval about the centre in which the curve is at the level or above.
Interval about(const Curve& c, double centre, double level) {
    if (value_at(c, std::clamp(centre, c.at.front(), c.at.back())) < level) {
        const Limit none = Limit::none("the criterion is not met even in the middle");
        return {none, none, true};
    }
    return known({first_below(c, centre, -1, level), first_below(c, centre, 1, level)}, centre);
}

double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    const std::size_t n = v.size();
    return n % 2 ? v[n / 2] : 0.5 * (v[n / 2 - 1] + v[n / 2]);
}

/// Returns the fall near `expected` as the curve is followed outwards to one side.
Limit fall(const Curve& c, double expected, double reach, int side) {
    if (!std::isfinite(expected)) return Limit::none("there is no edge to look for");
    // Levels inside and outside of the fall: medians of the positions from one to three reaches away
    std::vector<double> inside, outside;
    for (std::size_t k = 0; k < c.at.size(); ++k) {
        const double beyond = side * (c.at[k] - expected);
        if (beyond < -reach && beyond >= -3 * reach) inside.push_back(c.value[k]);
        if (beyond > reach && beyond <= 3 * reach) outside.push_back(c.value[k]);
    }
    if (inside.size() < 2 || outside.size() < 2)
        return Limit::none(fmt::format("there are too few views on both sides of the edge expected at {:.4g}", expected));
    const double top = median(inside), bottom = median(outside), level = 0.5 * (top + bottom);
    if (top - bottom < std::max(0.02, 5 * c.error))
        return Limit::none(
            fmt::format("there is no clear fall about the edge expected at {:.4g}: from {:.3f} to {:.3f}", expected, top, bottom));
    // The curve must cross the middle of both exactly once within three reaches, and that within one reach of the expected
    // position.
    std::optional<Limit> found;
    int crossings = 0;
    for (std::size_t n = 0; n + 1 < c.at.size(); ++n) {
        const std::size_t k = side > 0 ? n : c.at.size() - 2 - n, from = side > 0 ? k : k + 1, to = side > 0 ? k + 1 : k;
        if (side * (c.at[to] - expected) <= -3 * reach || side * (c.at[from] - expected) >= 3 * reach) continue;
        if ((c.value[from] >= level) == (c.value[to] >= level)) continue;
        ++crossings;
        if (c.value[from] >= level) found = crossing(c, c.at[from], c.value[from], c.at[to], c.value[to], level);
    }
    if (crossings != 1 || !found || std::abs(found->at - expected) > reach)
        return Limit::none(fmt::format("the curve crosses the middle of the fall expected at {:.4g} {}", expected,
                                       crossings != 1 ? fmt::format("{} times", crossings) : "elsewhere"));
    found->error = std::hypot(found->error, found->at - expected);
    return *found;
}

}  // namespace

Interval known(Interval i, double centre) {
    for (Limit* limit : {&i.low, &i.high})
        if (limit->error > 0 && limit->error >= std::abs(limit->at - centre)) {
            std::string missing =
                fmt::format("the interval ends at {:.4g}, which is no farther from the middle, {:.4g}, than its error of {:.2g}",
                            limit->at, centre, limit->error);
            *limit = {nan, nan, std::move(missing), limit->at};
        }
    return i;
}

Interval mapped(const Interval& from, const std::function<double(double)>& map) {
    const auto limit = [&](const Limit& l) {
        return Limit{map(l.at), 0.5 * std::abs(map(l.at + l.error) - map(l.at - l.error)), l.missing};
    };
    const Interval to{limit(from.low), limit(from.high)};
    return map(1.) > map(0.5) ? to : Interval{to.high, to.low};
}

Interval where_at_least(const Curve& c, double centre, double least) { return about(c, centre, least); }

Interval where_steady(const Curve& c, double centre, double most) {
    Curve steadiness;  // -|slope|: the criterion is then a lower bound
    for (std::size_t k = 0; k + 1 < c.at.size(); ++k) {
        const double step = c.at[k + 1] - c.at[k];
        steadiness.at.push_back(0.5 * (c.at[k] + c.at[k + 1]));
        steadiness.value.push_back(-std::abs(c.value[k + 1] - c.value[k]) / step);
        steadiness.error = std::max(steadiness.error, std::sqrt(2.) * c.error / step);
    }
    return about(steadiness, centre, -most);
}

Interval where_it_falls(const Curve& c, const Falls& expected) {
    const double step = (c.at.back() - c.at.front()) / double(c.at.size() - 1), reach = std::max(expected.reach, 2 * step);
    Interval edges{fall(c, expected.low, reach, -1), fall(c, expected.high, reach, 1)};
    const double aside = 0.5 * std::abs(edges.low.at + edges.high.at - expected.low - expected.high);
    if (std::isfinite(aside))
        for (Limit* limit : {&edges.low, &edges.high}) limit->error = std::hypot(limit->error, aside);
    return edges;
}

namespace {

/// Returns the reasons of both limits, once if they are the same.
std::string why_missing(const Interval& i) {
    std::string why = i.low.missing;
    if (!i.high.missing.empty() && i.high.missing != why) why += (why.empty() ? "" : "; ") + i.high.missing;
    return why;
}

}  // namespace

Interval on_side_of_zero(Interval i, bool above, const std::string& nothing_there) {
    if (i.empty) return i;
    const Limit none = Limit::none(nothing_there);
    if (above ? i.high.place() <= 0 : i.low.place() >= 0) return {none, none, true};
    const Limit zero{0, 0, {}};
    if (above && i.low.place() <= 0) i.low = zero;
    if (!above && i.high.place() >= 0) i.high = zero;
    return known(i, 0);
}

FigureValue figure_of(const Interval& i) {
    return {std::vector{i.low.at, i.high.at}, std::vector{i.low.error, i.high.error}, why_missing(i)};
}

}  // namespace lfdsim
