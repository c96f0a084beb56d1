// Figures from independent random numbers, and their stated errors. Floor 3.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

namespace lfdsim {

/// A figure and its stated error. NaN: undefined, or not stated.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();  // covers the true value in 95 of 100 cases
};

/// Student's factor for 95 % by the number of independent values, two to eight.
inline constexpr std::array<double, 9> student{0, 0, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365};

/// Returns the estimate from two to eight independent values: their mean, and as error `precision` + student[n] s/sqrt(n), with s
/// the values' standard deviation and `precision` the error that each single value has.
inline Estimate estimate(std::span<const double> found, double precision = 0) {
    const double n = double(found.size());
    double sum = 0, squares = 0;
    for (const double x : found) sum += x / n;
    for (const double x : found) squares += (x - sum) * (x - sum);
    return {sum, precision + student[std::min<std::size_t>(found.size(), 8)] * std::sqrt(squares / (n - 1) / n)};
}

/// The number of independent sets of random numbers with which a figure is measured.
inline constexpr int independent_sets = 8;

/// Returns a figure of all sets together and its error by the jackknife, student[n] sqrt((n - 1)/n sum (x_k - mean)^2)
/// with n = 8 sets: x_k = figure(k) is the figure of all sets but k, figure(-1) that of all of them. The figure may be any smooth
/// function of sums over the sets. If the error is not finite it is NaN.
Estimate jackknife(const std::function<double(int without)>& figure);

/// Sums of a quantity over each of the independent sets of lines of sight.
using Sums = std::array<double, independent_sets>;
/// Returns the sum over all sets, or over all but one.
double total(const Sums&, int without = -1);

/// Returns the number of the n-th set of random numbers for a render.seed, for even_choices().
std::uint32_t set_number(std::int64_t seed, int n);

}  // namespace lfdsim
