#include "analysis/core/chromaticity.h"

#include "base/constants.h"
#include "geometry/subpixels.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double dark_part = 0.1;  // of the mean luminance: parts below it count as dark

std::array<double, 3> light_of(const ColourSums& part, int without) {
    return {total(part[0], without), total(part[1], without), total(part[2], without)};
}

double luminance_of(const std::array<double, 3>& rgb) {
    return luminance_weights[0] * rgb[0] + luminance_weights[1] * rgb[1] + luminance_weights[2] * rgb[2];
}

Chromaticity minus(const Chromaticity& a, const Chromaticity& b) { return {a[0] - b[0], a[1] - b[1]}; }

/// Returns the chromaticities of parts relative to that of their light together, which goes to `together`; without one of the
/// sets.
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

struct Distances {
    double largest, mean;
};
/// Returns the largest and the weighted mean length of differences.
Distances distances(const std::vector<Chromaticity>& from_mean, const std::vector<double>& weights) {
    Distances found{0, 0};
    double whole = 0;
    for (std::size_t k = 0; k < from_mean.size(); ++k) {
        const double distance = std::hypot(from_mean[k][0], from_mean[k][1]);
        found.largest = std::max(found.largest, distance);
        found.mean += weights[k] * distance;
        whole += weights[k];
    }
    found.mean /= whole;
    return found;
}

/// Whether a part has at least a tenth of the mean luminance, and whether that is certain.
struct LitTest {
    bool lit, sure;
};
/// Tests each part: it is certain if the luminance differs from a tenth of the mean by more than twice its stated error.
std::vector<LitTest> lit_or_dark(const std::vector<ColourSums>& parts, const std::vector<double>& weights) {
    std::vector<Sums> luminance(parts.size(), Sums{});
    Sums limit{};
    double whole = 0;
    for (const double weight : weights) whole += weight;
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t set = 0; set < limit.size(); ++set) {
            luminance[k][set] = luminance_of({parts[k][0][set], parts[k][1][set], parts[k][2][set]});
            limit[set] += dark_part * weights[k] * luminance[k][set] / whole;
        }
    const bool any = total(limit) > 0;
    std::vector<LitTest> found;
    for (const Sums& of : luminance) {
        Sums above{};
        for (std::size_t set = 0; set < limit.size(); ++set) above[set] = of[set] - limit[set];
        const Estimate e = estimate(above);
        constexpr double rounding = 1e-9;  // of the limit: sums in another order
        found.push_back(
            {any && e.value >= 0, !any || std::abs(e.value) > 2 * e.error + rounding * total(limit) / independent_sets});
    }
    return found;
}

/// Returns the mean of the sets' values, at least 0, with the excess of the figure of all sets together in its error.
Estimate with_excess(const Sums& found, double of_all_sets) {
    Estimate e = estimate(found);
    e.value = std::max(e.value, 0.);
    e.error = std::hypot(e.error, of_all_sets - e.value);
    return e;
}

}  // namespace

Chromaticity chromaticity(const std::array<double, 3>& rgb) {
    const auto [r, g, b] = rgb;
    // XYZ by the matrix of IEC 61966-2-1; u' = 4X/(X + 15Y + 3Z), v' = 9Y/(X + 15Y + 3Z)
    const double x = 0.4124 * r + 0.3576 * g + 0.1805 * b, y = 0.2126 * r + 0.7152 * g + 0.0722 * b,
                 z = 0.0193 * r + 0.1192 * g + 0.9505 * b, sum = x + 15 * y + 3 * z;
    if (!(sum > 0)) return {nan, nan};
    return {4 * x / sum, 9 * y / sum};
}

ColourSpread colour_spread(const std::vector<ColourSums>& parts, const std::vector<double>& weights) {
    const std::vector<LitTest> all = lit_or_dark(parts, weights);
    // Numbers of the lit parts, with the part `other` counted as the opposite of what the test found; parts.size(): none.
    const auto lit_parts = [&](std::size_t other) {
        std::vector<std::size_t> number;
        for (std::size_t k = 0; k < parts.size(); ++k)
            if (all[k].lit != (k == other)) number.push_back(k);
        return number;
    };
    const auto of = [](const auto& values, const std::vector<std::size_t>& number) {
        std::decay_t<decltype(values)> chosen;
        for (const std::size_t k : number) chosen.push_back(values[k]);
        return chosen;
    };
    const std::vector<std::size_t> number = lit_parts(parts.size());
    const std::vector<ColourSums> lit = of(parts, number);
    const std::vector<double> share = of(weights, number);
    ColourSpread spread{{},
                        {},
                        {nan, nan},
                        std::vector(parts.size(), Chromaticity{nan, nan}),
                        std::vector(parts.size(), nan),
                        int(parts.size() - lit.size())};
    if (lit.empty()) return spread;
    // All sets together: for map and plot, and for the excess
    const std::vector<Chromaticity> of_all = differences(lit, share, -1, spread.together);
    for (std::size_t k = 0; k < lit.size(); ++k) {
        spread.parts[number[k]] = {spread.together[0] + of_all[k][0], spread.together[1] + of_all[k][1]};
        spread.distance[number[k]] = std::hypot(of_all[k][0], of_all[k][1]);
    }
    const Distances plain = distances(of_all, share);
    // Each set in turn: the other seven give the directions and the part that is farthest away.
    Sums largest_of{}, mean_of{};
    for (int set = 0; set < independent_sets; ++set) {
        Chromaticity unused;
        const std::vector<Chromaticity> others = differences(lit, share, set, unused);
        double farthest = -1, shares = 0;
        for (std::size_t k = 0; k < lit.size(); ++k) {
            const double away = std::hypot(others[k][0], others[k][1]);
            // The set's value to first order is the jackknife's pseudo-value n x_all - (n - 1) x_others, projected on the others'
            // direction.
            double own = 0;
            for (std::size_t i = 0; i < 2 && away > 0; ++i)
                own += (independent_sets * of_all[k][i] - (independent_sets - 1) * others[k][i]) * others[k][i] / away;
            shares += share[k];
            mean_of[std::size_t(set)] += share[k] * own;
            if (away > farthest) {
                farthest = away;
                largest_of[std::size_t(set)] = own;
            }
        }
        mean_of[std::size_t(set)] /= shares;
    }
    spread.largest = with_excess(largest_of, plain.largest);
    spread.mean = with_excess(mean_of, plain.mean);
    // The error includes by how much the figures would change if a part that may be on the other side of the limit were there.
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (all[k].sure) continue;
        const std::vector<std::size_t> other = lit_parts(k);
        if (other.empty()) continue;
        Chromaticity unused;
        const Distances found = distances(differences(of(parts, other), of(weights, other), -1, unused), of(weights, other));
        spread.largest.error += std::abs(found.largest - plain.largest);
        spread.mean.error += std::abs(found.mean - plain.mean);
    }
    return spread;
}

}  // namespace lfdsim
