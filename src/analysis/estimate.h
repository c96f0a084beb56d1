// A figure found several times with independent random numbers: its mean, and the error to state. Floor 3.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace lfdsim {

struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();  // covers the truth in 95 of 100 cases
};

/// Of two to eight of them: the mean, and Student's factor for 95 % times its standard error, plus what each may be off by.
inline Estimate estimate(std::span<const double> found, double precision = 0) {
    constexpr std::array<double, 9> student{0, 0, 12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36};
    const double n = double(found.size());
    double sum = 0, squares = 0;
    for (const double x : found) sum += x / n;
    for (const double x : found) squares += (x - sum) * (x - sum);
    return {sum, precision + student[std::min<std::size_t>(found.size(), 8)] * std::sqrt(squares / (n - 1) / n)};
}

}  // namespace lfdsim
