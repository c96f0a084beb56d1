#include "analysis/rules.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// From the centre outwards along one side (+1 or -1): the first place where the curve falls below `level`.
struct Crossing {
    Limit limit;
    bool at_once = false;  // it is below at the centre
};

double value_at(const Curve& c, double place) {
    const auto after = std::upper_bound(c.at.begin(), c.at.end(), place);
    if (after == c.at.begin()) return c.value.front();
    if (after == c.at.end()) return c.value.back();
    const std::size_t k = std::size_t(after - c.at.begin());
    const double t = (place - c.at[k - 1]) / (c.at[k] - c.at[k - 1]);
    return c.value[k - 1] + t * (c.value[k] - c.value[k - 1]);
}

Crossing first_below(const Curve& c, double centre, int side, double level) {
    double at = std::clamp(centre, c.at.front(), c.at.back()), value = value_at(c, at);
    if (value < level) return {{at, 0}, true};
    const int count = int(c.at.size());
    int k = int(std::upper_bound(c.at.begin(), c.at.end(), at) - c.at.begin());  // the first after
    if (side < 0) k = int(std::lower_bound(c.at.begin(), c.at.end(), at) - c.at.begin()) - 1;
    for (; k >= 0 && k < count; k += side) {
        const double next = c.at[std::size_t(k)], next_value = c.value[std::size_t(k)];
        if (next_value < level) {
            const double slope = (next_value - value) / (next - at);
            return {{at + (level - value) / slope, c.error / std::abs(slope)}};
        }
        at = next;
        value = next_value;
    }
    return {};
}

Interval about(const Curve& c, double centre, double level) {
    const Crossing low = first_below(c, centre, -1, level), high = first_below(c, centre, 1, level);
    return {low.limit, high.limit, low.at_once};
}

double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    const std::size_t n = v.size();
    return n % 2 ? v[n / 2] : 0.5 * (v[n / 2 - 1] + v[n / 2]);
}

}  // namespace

Interval where_at_least(const Curve& c, double centre, double least) { return about(c, centre, least); }

Interval where_steady(const Curve& c, double centre, double most) {
    Curve steadiness;  // minus the size of the slope
    for (std::size_t k = 0; k + 1 < c.at.size(); ++k) {
        const double step = c.at[k + 1] - c.at[k];
        steadiness.at.push_back(0.5 * (c.at[k] + c.at[k + 1]));
        steadiness.value.push_back(-std::abs(c.value[k + 1] - c.value[k]) / step);
        steadiness.error = std::max(steadiness.error, std::sqrt(2.) * c.error / step);
    }
    return about(steadiness, centre, -most);
}

Interval where_edge(const Curve& c, double centre, double plateau, double window) {
    std::vector<double> inner;
    for (std::size_t k = 0; k < c.at.size(); ++k)
        if (std::abs(c.at[k] - centre) <= plateau) inner.push_back(c.value[k]);
    if (inner.empty()) inner.push_back(value_at(c, centre));
    const double level = median(inner);
    Interval edges;
    for (const int side : {-1, 1}) {
        // Outwards from the centre
        std::vector<std::size_t> places;
        for (std::size_t k = 0; k < c.at.size(); ++k)
            if (side * (c.at[k] - centre) >= 0) places.push_back(k);
        if (side < 0) std::reverse(places.begin(), places.end());
        const auto at = [&](std::size_t n) { return c.at[places[n]]; };
        const auto value = [&](std::size_t n) { return c.value[places[n]]; };
        std::size_t step = 0;
        double steepest = 0;
        for (std::size_t n = 0; n + 1 < places.size(); ++n) {
            const double fall = (value(n) - value(n + 1)) / std::abs(at(n + 1) - at(n));
            if (fall > steepest) steepest = fall, step = n;
        }
        if (steepest == 0) continue;
        double top = level, bottom = value(step + 1), from = centre;
        for (std::size_t n = 0; n <= step; ++n)
            if (std::abs(at(n) - at(step)) <= window && value(n) > top) top = value(n), from = at(n);
        for (std::size_t n = step + 1; n < places.size(); ++n)
            if (std::abs(at(n) - at(step + 1)) <= window) bottom = std::min(bottom, value(n));
        if (top - bottom < std::max(0.02, 5 * c.error)) continue;
        const Crossing crossing = first_below(c, from, side, 0.5 * (top + bottom));
        if (!crossing.at_once) (side < 0 ? edges.low : edges.high) = crossing.limit;
    }
    return edges;
}

namespace {
Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }
}  // namespace

Json limits_json(const Interval& i) { return {number_or_null(i.low.at), number_or_null(i.high.at)}; }
Json errors_json(const Interval& i) { return {number_or_null(i.low.error), number_or_null(i.high.error)}; }
std::vector<double> bounds(const Interval& i) { return {i.low.at, i.high.at}; }

}  // namespace lfdsim
