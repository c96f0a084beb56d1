// The steps of SSIM at a pixel and in a window, for ssim.cpp and the GPU (engine/wide). Floor 0.
#pragma once
#include "base/host_device.h"
#include "image/compare/ssim.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lfdsim {

constexpr int ssim_border = ssim_window / 2;

/// The columns of a row are summed in so many groups, dealt out one after another, and then the groups' sums: the same bits however
/// the work is divided, and threads side by side, a group each, read numbers that lie side by side.
constexpr int column_groups = 32;

/// Sum of value(x) over the columns x of a row of a region.
template <class Value>
double sum_of_row(const Region::Row& row, Value value) {
    double part[column_groups] = {}, sum = 0;
    for (int x = row.from; x < row.to; ++x) part[x % column_groups] += value(x);
    for (const double of_group : part) sum += of_group;
    return sum;
}

/// Where a window's middle may be so that the window lies in the region and in the picture.
Region ssim_middles(const Region&, int width, int height);

/// sRGB's encoding of single-precision light in [0, 1], accurate to 2e-7: straight lines between 512 points an octave, looked up by
/// the bits of the number. A power takes six times as long.
struct SrgbLine {
    float at_zero, slope;
};
constexpr int srgb_shift = 14;
constexpr std::uint32_t srgb_first = __builtin_bit_cast(std::uint32_t, 0x1p-9f);
const std::vector<SrgbLine>& srgb_lines();

LFDSIM_FN float srgb_code(const SrgbLine* lines, float x) {
    x = x > 0 ? (x < 1 ? x : 1) : 0;
    if (x <= 0.0031308f) return 12.92f * x;
    const SrgbLine l = lines[(__builtin_bit_cast(std::uint32_t, x) - srgb_first) >> srgb_shift];
    return l.at_zero + l.slope * x;
}

LFDSIM_FN float luma(const float* rgb) { return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]; }

/// Luma of the sRGB codes of linear light.
LFDSIM_FN float code_luma(const SrgbLine* lines, const float* light) {
    const float codes[3] = {srgb_code(lines, light[0]), srgb_code(lines, light[1]), srgb_code(lines, light[2])};
    return luma(codes);
}

/// The Gaussian over a window, along one axis: at[k] for the pixels at distance k; all eleven sum to 1.
struct SsimWeights {
    double at[ssim_border + 1];
};
SsimWeights ssim_weights();

/// Weighted sum of at(0) .. at(10).
template <class At>
LFDSIM_FN double weighted(const SsimWeights& w, At at) {
    return w.at[0] * at(5) + w.at[1] * (at(4) + at(6)) + w.at[2] * (at(3) + at(7)) + w.at[3] * (at(2) + at(8)) +
           w.at[4] * (at(1) + at(9)) + w.at[5] * (at(0) + at(10));
}

/// The weighted sums over a window: of both lumas, of the sum of their squares, of their product.
enum Moment { of_a, of_b, of_squares, of_product, moments };

/// SSIM of a window with these moments: Wang et al. 2004, equation 13.
LFDSIM_FN double ssim_value(double a, double b, double both_squares, double both_product) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // (K1 L)^2, (K2 L)^2 with L = 1
    const double product = a * b, squares = a * a + b * b;
    return (2 * product + c1) * (2 * (both_product - product) + c2) / ((squares + c1) * (both_squares - squares + c2));
}

}  // namespace lfdsim
