// The range of a slider for one key: useful values, and those with which the display is valid. Floor 5.
#pragma once
#include "display/display.h"
#include "display/keys.h"
#include "geometry/geometry.h"

#include <functional>
#include <string_view>

namespace lfdsim::view {

struct Slider {
    double low, high, step;
};

/// Returns a useful range for a key ("array.gap_mm") that has the value `described` in the description, within the range that the
/// key allows: a quarter to four times the value, and for keys that can be zero a suitable range about it. The step is 0.
Slider sensible_ends(std::string_view path, const Range&, double described, const Display&, const Geometry&);

/// Returns the part of the slider around `value` in which `valid` holds throughout, as found by a few trials; where it does not
/// hold for `value`, the whole slider. The step is about 1/200 of the range and 1, 2 or 5 times a power of ten (a whole number for
/// `whole`), the ends are multiples of it; `value` lies between them.
Slider valid_part(Slider, double value, bool whole, const std::function<bool(double)>& valid);

/// Returns a number rounded to a number of significant digits.
double rounded(double, int digits = 12);

}  // namespace lfdsim::view
