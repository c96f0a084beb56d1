// Hermite polynomials and their zeros, for means over a normal distribution. Floor 0.
#pragma once
#include <cstddef>
#include <vector>

namespace lfdsim {

inline constexpr std::size_t max_hermite_degree = 32;

/// Returns the values at x of the Hermite polynomials of degrees 0 to K, orthonormal under the weight exp(-x^2) / sqrt(pi).
std::vector<double> hermite(std::size_t K, double x);

/// Returns the zeros of the polynomial of a degree from 1 to max_hermite_degree: ascending, symmetric to the last bit. The sum of
/// hermite_weight() times f(zero) is the mean of f under that weight, exact for polynomials f up to degree 2 `degree` - 1
/// (Gauss). Throws std::out_of_range for other degrees. May be called from several threads.
const std::vector<double>& hermite_zeros(std::size_t degree);

/// Returns Christoffel's weight of a zero of the polynomial of that degree; the weights of all its zeros sum to 1.
double hermite_weight(std::size_t degree, double zero);

}  // namespace lfdsim
