// Intervals from a curve of SSIM: the published criteria, and the edge of the field of view. Floor 3.
//
// Curves are given at rising positions, and read as straight lines between them. An interval is the connected one about a centre.
#pragma once
#include "analysis/core/result.h"

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace lfdsim {

/// An end of an interval. NaN: there is none, or none that is known, and `missing` says why.
struct Limit {
    double at = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();  // by the curve's noise and half the step between its positions
    std::string missing = {};
    // If no limit was found: how far the criterion is known to be met, the end of the search or an end that is too uncertain.
    double holds_to = std::numeric_limits<double>::quiet_NaN();
    bool searched_out = false;  // the criterion is met to the end of the search

    /// Returns a limit that was not found, for this reason.
    static Limit none(std::string why) { return {.missing = std::move(why)}; }
    /// Returns the limit, or how far the criterion is known to be met.
    double place() const { return missing.empty() ? at : holds_to; }
};

/// A connected interval about a centre.
struct Interval {
    Limit low, high;
    bool empty = false;  // the criterion is not met at the centre: there are no limits
};

/// Returns the interval without those ends that are no farther from the centre than their error.
Interval known(Interval, double centre);

/// Returns the interval in another coordinate, a rising or falling function of the present one; errors to first order.
Interval mapped(const Interval&, const std::function<double(double)>&);

/// A curve given at points.
struct Curve {
    std::vector<double> at;     // ascending, at least two
    std::vector<double> value;  // one at each position
    double error = 0;           // standard deviation of each value
};

/// Returns the interval about the centre in which the curve is `least` or more.
Interval where_at_least(const Curve&, double centre, double least);

/// Returns the interval about the centre in which the curve changes by `most` or less per unit. Slopes are assigned half-way
/// between two positions.
Interval where_steady(const Curve&, double centre, double most);

/// The positions, known from elsewhere, at which a curve is expected to fall, to the left (low) and to the right (high) of the
/// centre; and the reach of each fall to either side of its position.
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

/// Returns the part of an interval above 0, or below it; its other end is 0 if the interval contains 0. If nothing of it lies on
/// that side it is empty, for the reason `nothing_there`. An end no farther from 0 than its error is removed.
Interval on_side_of_zero(Interval, bool above, const std::string& nothing_there);

/// Returns the interval as a figure, which is missing if a limit is.
FigureValue figure_of(const Interval&);

}  // namespace lfdsim
