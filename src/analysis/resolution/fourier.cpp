#include "analysis/resolution/fourier.h"

#include "base/constants.h"

#include <cstddef>
#include <utility>

namespace lfdsim {
namespace {

/// Transforms n values `step` apart in place by Cooley and Tukey's algorithm: values are put in the order of reversed bits, then
/// sums of 2, 4, 8 ... values are combined. turns[k] = exp(-2 pi i k/n).
void transform(std::complex<double>* v, int n, std::ptrdiff_t step, const std::vector<std::complex<double>>& turns) {
    for (int k = 1, reversed = 0; k < n; ++k) {
        int bit = n / 2;
        for (; reversed & bit; bit /= 2) reversed ^= bit;
        reversed ^= bit;
        if (k < reversed) std::swap(v[k * step], v[reversed * step]);
    }
    for (int half = 1; half < n; half *= 2)
        for (int first = 0; first < n; first += 2 * half)
            for (int k = 0; k < half; ++k) {
                std::complex<double>&a = v[(first + k) * step], &b = v[(first + k + half) * step];
                const std::complex<double> turned = b * turns[std::size_t(k * (n / 2 / half))];
                b = a - turned;
                a += turned;
            }
}

}  // namespace

void fourier(std::vector<std::complex<double>>& values, int n) {
    std::vector<std::complex<double>> turns;
    for (int k = 0; k < n / 2; ++k) turns.push_back(std::polar(1., -2 * pi * k / n));
    for (int y = 0; y < n; ++y) transform(values.data() + std::ptrdiff_t(y) * n, n, 1, turns);
    for (int x = 0; x < n; ++x) transform(values.data() + x, n, n, turns);
}

}  // namespace lfdsim
