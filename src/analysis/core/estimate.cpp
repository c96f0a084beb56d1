#include "analysis/core/estimate.h"

#include <cmath>
#include <limits>

namespace lfdsim {

Estimate jackknife(const std::function<double(int without)>& figure) {
    Estimate result{figure(-1), std::numeric_limits<double>::quiet_NaN()};
    Sums each;
    double mean = 0, variance = 0;
    for (int k = 0; k < independent_sets; ++k) mean += (each[std::size_t(k)] = figure(k)) / independent_sets;
    for (const double x : each) variance += (x - mean) * (x - mean) * (independent_sets - 1) / independent_sets;
    if (std::isfinite(result.value) && std::isfinite(variance)) result.error = student[independent_sets] * std::sqrt(variance);
    return result;
}

double total(const Sums& sums, int without) {
    double all = 0;
    for (int k = 0; k < independent_sets; ++k)
        if (k != without) all += sums[std::size_t(k)];
    return all;
}

std::uint32_t set_number(std::int64_t seed, int n) {
    // Seed 0 gives 0; by the golden ratio consecutive seeds are far apart.
    const std::uint64_t mixed = std::uint64_t(seed) * 0x9e3779b97f4a7c15u;
    return std::uint32_t(mixed >> 32) + std::uint32_t(n);
}

}  // namespace lfdsim
