#include "analysis/moire/eye_filter.h"

#include "base/constants.h"

#include <cmath>

namespace lfdsim {

double eye_filter(double cycles_per_degree) {
    const auto sensitivity = [](double f) { return 2.6 * (0.0192 + 0.114 * f) * std::exp(-std::pow(0.114 * f, 1.1)); };
    constexpr double at_greatest = 7.8904;
    return sensitivity(cycles_per_degree) / sensitivity(at_greatest);
}

double colour_filter(double cycles_per_degree) { return std::pow(10, -cycles_per_degree / 6); }

double mm_per_degree(double distance_mm) { return distance_mm * degree; }

}  // namespace lfdsim
