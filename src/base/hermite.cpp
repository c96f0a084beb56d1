#include "base/hermite.h"

#include "base/bisection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lfdsim {
namespace {

/// Returns the zero of the polynomial of degree K between two positions where its signs differ.
double zero_between(std::size_t K, double low, double high) {
    const bool rises = hermite(K, high)[K] > 0;
    return bisected(low, high, to_last_bit, [&](double x) { return (hermite(K, x)[K] > 0) != rises; }).middle();
}

using Zeros = std::array<std::vector<double>, max_hermite_degree + 1>;

/// Returns the zeros of the Hermite polynomials by degree. The zeros of degree K - 1 separate those of degree K, and none of
/// these is beyond sqrt(2 K + 1): so each zero is bracketed by the ones of the degree before. Negative zeros mirror the positive
/// ones, and odd degrees have one at 0.
Zeros all_zeros() {
    Zeros all;
    for (std::size_t degree = 1; degree < all.size(); ++degree) {
        const std::vector<double>& zeros = all[degree - 1];
        std::vector<double> next(degree, 0);
        for (std::size_t i = degree / 2 + degree % 2; i < degree; ++i) {  // the positive ones
            const double above = i < zeros.size() ? zeros[i] : std::sqrt(2. * double(degree) + 1);
            next[i] = zero_between(degree, std::max(zeros[i - 1], 0.), above);
            next[degree - 1 - i] = -next[i];
        }
        all[degree] = std::move(next);
    }
    return all;
}

}  // namespace

std::vector<double> hermite(std::size_t K, double x) {
    // h_0 = 1, h_1 = sqrt(2) x, h_{k+1} = (sqrt(2) x h_k - sqrt(k) h_{k-1}) / sqrt(k + 1)
    std::vector<double> h(K + 1, 1);
    if (K > 0) h[1] = std::numbers::sqrt2 * x;
    for (std::size_t k = 1; k < K; ++k)
        h[k + 1] = (x * std::numbers::sqrt2 * h[k] - std::sqrt(double(k)) * h[k - 1]) / std::sqrt(double(k + 1));
    return h;
}

const std::vector<double>& hermite_zeros(std::size_t degree) {
    static const Zeros zeros = all_zeros();
    return zeros.at(degree);
}

double hermite_weight(std::size_t degree, double zero) {
    // Christoffel's weight is 1 / sum of h_k(x)^2 over k < degree (docs/model.md, "Colour").
    double squares = 0;
    for (const double h : hermite(degree - 1, zero)) squares += h * h;
    return 1 / squares;
}

}  // namespace lfdsim
