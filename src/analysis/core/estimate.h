// Figures found with independent random numbers, and the errors to state. Floor 3.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

namespace lfdsim {

struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();  // covers the true value in 95 of 100 cases
};

/// The estimate from two to eight values: the mean, and Student's factor for 95 % times its standard error, plus `precision`, the
/// error of each.
inline Estimate estimate(std::span<const double> found, double precision = 0) {
    constexpr std::array<double, 9> student{0, 0, 12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36};
    const double n = double(found.size());
    double sum = 0, squares = 0;
    for (const double x : found) sum += x / n;
    for (const double x : found) squares += (x - sum) * (x - sum);
    return {sum, precision + student[std::min<std::size_t>(found.size(), 8)] * std::sqrt(squares / (n - 1) / n)};
}

/// The number of independent sets of random numbers with which a figure is measured.
inline constexpr int independent_sets = 8;

/// A figure of all sets together and its error, by the jackknife: figure(k) is that of all sets but k, figure(-1) that of all of
/// them. It may be any smooth function of sums over the sets. Where it is not finite the error is NaN.
Estimate jackknife(const std::function<double(int without)>& figure);

/// Sums of a quantity over each of the independent sets of lines of sight.
using Sums = std::array<double, independent_sets>;
/// Over all sets, or all but one.
double total(const Sums&, int without = -1);

/// The number of the n-th set of random numbers, different for each render.seed.
std::uint32_t set_number(std::int64_t seed, int n);

}  // namespace lfdsim
