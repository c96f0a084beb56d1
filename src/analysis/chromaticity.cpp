#include "analysis/chromaticity.h"

#include "model/numbers.h"
#include "model/subpixels.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double dark_part = 0.1;  // of the mean luminance

std::array<double, 3> light_of(const ColourSums& part, int without) {
    return {total(part[0], without), total(part[1], without), total(part[2], without)};
}

double luminance_of(const std::array<double, 3>& rgb) {
    return luminance_weights[0] * rgb[0] + luminance_weights[1] * rgb[1] + luminance_weights[2] * rgb[2];
}

Chromaticity minus(const Chromaticity& a, const Chromaticity& b) { return {a[0] - b[0], a[1] - b[1]}; }

/// Chromaticities of parts from that of all of them, without one of the sets.
std::vector<Chromaticity> differences(const std::vector<ColourSums>& parts, const std::vector<double>& weights, int without,
                                      Chromaticity& together) {
    std::array<double, 3> sum{};
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weights[k] * total(parts[k][c], without);
    together = chromaticity(sum);
    std::vector<Chromaticity> all;
    for (const ColourSums& part : parts) all.push_back(minus(chromaticity(light_of(part, without)), together));
    return all;
}

Estimate with_excess(const Sums& found, double of_all_sets) {
    Estimate e = estimate(found);
    e.value = std::max(e.value, 0.);
    e.error = std::hypot(e.error, of_all_sets - e.value);
    return e;
}

}  // namespace

Chromaticity chromaticity(const std::array<double, 3>& rgb) {
    const auto [r, g, b] = rgb;
    const double x = 0.4124 * r + 0.3576 * g + 0.1805 * b, y = 0.2126 * r + 0.7152 * g + 0.0722 * b,
                 z = 0.0193 * r + 0.1192 * g + 0.9505 * b, sum = x + 15 * y + 3 * z;
    if (!(sum > 0)) return {nan, nan};
    return {4 * x / sum, 9 * y / sum};
}

ColourSpread colour_spread(const std::vector<ColourSums>& parts, const std::vector<double>& weights) {
    double light = 0, whole = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        light += weights[k] * luminance_of(light_of(parts[k], -1));
        whole += weights[k];
    }
    std::vector<ColourSums> lit;
    std::vector<double> share;
    std::vector<std::size_t> number;
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (light > 0 && luminance_of(light_of(parts[k], -1)) >= dark_part * light / whole) {
            lit.push_back(parts[k]);
            share.push_back(weights[k]);
            number.push_back(k);
        }
    ColourSpread spread{{},
                        {},
                        {nan, nan},
                        std::vector(parts.size(), Chromaticity{nan, nan}),
                        std::vector(parts.size(), nan),
                        int(parts.size() - lit.size())};
    if (lit.empty()) return spread;
    double shares = 0, mean = 0, largest = 0;
    const std::vector<Chromaticity> of_all = differences(lit, share, -1, spread.together);
    for (std::size_t k = 0; k < lit.size(); ++k) {
        const double distance = std::hypot(of_all[k][0], of_all[k][1]);
        spread.parts[number[k]] = {spread.together[0] + of_all[k][0], spread.together[1] + of_all[k][1]};
        spread.distance[number[k]] = distance;
        shares += share[k];
        mean += share[k] * distance;
        largest = std::max(largest, distance);
    }
    Sums largest_of{}, mean_of{};
    for (int set = 0; set < independent_sets; ++set) {
        Chromaticity unused;
        const std::vector<Chromaticity> others = differences(lit, share, set, unused);
        double farthest = -1;
        for (std::size_t k = 0; k < lit.size(); ++k) {
            const double away = std::hypot(others[k][0], others[k][1]);
            // What the set by itself would have found, to first order (the jackknife's pseudo-value), along the others' direction
            double own = 0;
            for (std::size_t i = 0; i < 2 && away > 0; ++i)
                own += (independent_sets * of_all[k][i] - (independent_sets - 1) * others[k][i]) * others[k][i] / away;
            mean_of[std::size_t(set)] += share[k] * own / shares;
            if (away > farthest) {
                farthest = away;
                largest_of[std::size_t(set)] = own;
            }
        }
    }
    spread.largest = with_excess(largest_of, largest);
    spread.mean = with_excess(mean_of, mean / shares);
    return spread;
}

}  // namespace lfdsim
