// Intervals from a curve of SSIM: the published criteria, and the edge of the field of view. Floor 3.
//
// Curves are given at rising positions, and read as straight lines between them. An interval is the connected one about a centre.
#pragma once
#include "analysis/core/result.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace lfdsim {

/// An end of an interval. NaN: nowhere, or nowhere that is known, and `missing` says why.
struct Limit {
    double at = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();  // from the curve's noise and half the step between its places
    std::string missing = {};
    // If no limit was found: how far the criterion is known to be met, the end of the search or an end that is too uncertain.
    double holds_to = std::numeric_limits<double>::quiet_NaN();
    bool searched_out = false;  // the rule holds as far as was searched

    double place() const { return missing.empty() ? at : holds_to; }
};

struct Interval {
    Limit low, high;
    bool empty = false;  // the rule does not hold at the centre itself: there are no limits
};

/// Takes away each end whose error reaches back to the centre that it was sought from: an error as large as the figure leaves none.
Interval known(Interval, double centre);

/// The interval with its limits in another measure of the place, rising or falling; errors to first order.
Interval mapped(const Interval&, const std::function<double(double)>&);

struct Curve {
    std::vector<double> at;     // rising, at least two
    std::vector<double> value;  // of the same length
    double error = 0;           // standard deviation of each value
};

/// The interval in which the curve is `least` or more.
Interval where_at_least(const Curve&, double centre, double least);

/// The interval in which the curve rises or falls by `most` or less per unit. Slopes count in the middle between two places.
Interval where_steady(const Curve&, double centre, double most);

/// The expected falls of a curve, from other sources: low to the left and high to the right of the centre; and their extent to
/// either side.
struct Falls {
    double low, high, reach;
};

/// Returns the middle, on each side, of the one sustained fall that contains the expected position: the curve crosses the middle
/// between its medians inside and outside of the fall once, and stays on either side of it. The medians are those of the
/// positions between one and three reaches (at least two steps) from the expected one. No limit is found where the medians differ
/// by less than 0.02 or five standard deviations, where the curve crosses more than once, or where it ends before. The error
/// contains the noise, half a step, the limit's distance from the expected position, which depends on no content, and half of the
/// amount by which both limits lie to one side of those.
Interval where_it_falls(const Curve&, const Falls&);

/// The part of an interval above 0, or below it: its other end is 0 where it reaches across. Empty, with that reason, where it does
/// not reach that side; an end nearer to 0 than its error is none.
Interval on_side_of_zero(Interval, bool above, const std::string& nothing_there);

/// The interval as a figure of a measure, which is missing where a limit is.
FigureValue figure_of(const Interval&);

}  // namespace lfdsim
