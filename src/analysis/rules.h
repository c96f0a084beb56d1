// From a curve of SSIM to an interval: the published rules, and the edge of the field of view. Floor 3.
//
// Curves are given at rising places, and read as straight lines between them. An interval is the connected one about a centre.
#pragma once
#include "analysis/result.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace lfdsim {

/// Where an interval ends. NaN: not within the curve.
struct Limit {
    double at = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();  // standard deviation, from that of the curve
};

struct Interval {
    Limit low, high;
    bool empty = false;  // the rule does not hold at the centre itself: both limits stand there
};

struct Curve {
    std::vector<double> at;     // rising, at least two
    std::vector<double> value;  // of the same length
    double error = 0;           // standard deviation of each value
};

/// Where the curve is `least` or more.
Interval where_at_least(const Curve&, double centre, double least);

/// Where it rises or falls by `most` or less per unit. Slopes count in the middle between two places.
Interval where_steady(const Curve&, double centre, double most);

/// On each side, half-way down the curve's fall at its steepest step: between its minimum within `window` beyond that step and its
/// median within `plateau` of the centre, or, where that is higher, its maximum within `window` before the step (SSIM rises while a
/// scene on black leaves the screen). Unbounded where the fall is less than 0.02 or five standard deviations.
Interval where_edge(const Curve&, double centre, double plateau, double window);

/// [low, high] with null where unbounded.
Json limits_json(const Interval&);
/// The same of the limits' standard deviations.
Json errors_json(const Interval&);
/// For Finding::measured.
std::vector<double> bounds(const Interval&);

}  // namespace lfdsim
