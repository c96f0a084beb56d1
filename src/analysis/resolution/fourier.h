// The discrete Fourier transform of a picture. Floor 3.
#pragma once
#include <complex>
#include <vector>

namespace lfdsim {

/// Transforms values in place: sum over x, y of v(x, y) exp(-2 pi i (x k + y l)/n) at [l n + k]. n, the side, is a power of two.
void fourier(std::vector<std::complex<double>>& values, int n);

}  // namespace lfdsim
