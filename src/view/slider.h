// How far a slider of one key goes. Floor 5.
#pragma once
#include "model/display.h"
#include "model/geometry.h"
#include "model/keys.h"

#include <functional>
#include <string_view>

namespace lfdsim::view {

struct Slider {
    double low, high, step;
};

/// What a person may want to try of a key ("array.gap_mm") whose value was described as `described`, within what the key allows:
/// a quarter to four times of it, and for those that have a zero a suitable way about that.
Slider sensible_ends(std::string_view path, const Range&, double described, const Display&, const Geometry&);

/// The part of the slider about `value` in which `valid` holds throughout, as far as a few trials tell; where it does not hold for
/// `value` itself, all of it. The step is about 1/200 of it and 1, 2 or 5 times a power of ten (a whole number for `whole`), the
/// ends are multiples of it; `value` lies between them.
Slider valid_part(Slider, double value, bool whole, const std::function<bool(double)>& valid);

/// The number with as many digits as a person writes.
double rounded(double, int digits = 12);

}  // namespace lfdsim::view
