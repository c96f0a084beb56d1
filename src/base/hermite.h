// Hermite polynomials and their zeros, for means over a normal distribution. Floor 0.
#pragma once
#include <cstddef>
#include <vector>

namespace lfdsim {

/// Hermite polynomials of degrees 0 to K, orthonormal under the weight exp(-x^2) / sqrt(pi).
std::vector<double> hermite(std::size_t K, double x);

/// The zeros of the polynomial of a degree from 1 to 32: ascending, symmetric to the last bit. They and hermite_weight() are a
/// Gauss rule for that weight.
const std::vector<double>& hermite_zeros(std::size_t degree);

/// Christoffel's weight of a zero of the polynomial of that degree; those of all its zeros sum to 1.
double hermite_weight(std::size_t degree, double zero);

}  // namespace lfdsim
