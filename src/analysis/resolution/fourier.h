// The discrete Fourier transform of a picture, and that of a box. Floor 3.
#pragma once
#include "base/constants.h"

#include <cmath>
#include <complex>
#include <vector>

namespace lfdsim {

/// sin(pi x) / (pi x), the mean of exp(-2 pi i x u) over -1/2 <= u <= 1/2.
inline double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }

/// Transforms values in place: sum over x, y of v(x, y) exp(-2 pi i (x k + y l)/n) at [l n + k]. n, the side, is a power of two.
void fourier(std::vector<std::complex<double>>& values, int n);

}  // namespace lfdsim
