// The transform of a box. Floor 0.
#pragma once
#include "base/constants.h"

#include <cmath>

namespace lfdsim {

/// sin(pi x) / (pi x), the mean of exp(-2 pi i x u) over -1/2 <= u <= 1/2.
inline double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }

}  // namespace lfdsim
