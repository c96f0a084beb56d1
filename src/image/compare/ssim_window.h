// The steps of SSIM at a pixel and in a window, for ssim.cpp and the GPU (engine/wide). Floor 0.
#pragma once
#include "base/host_device.h"
#include "image/compare/ssim.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

constexpr int ssim_border = ssim_window / 2;

/// The number of groups in which the columns of a row are summed, column x in group x mod 32, before the groups' sums are added:
/// the bits are the same however the work is divided, and GPU threads with a group each read neighbouring numbers.
constexpr int column_groups = 32;

/// Returns the sum of value(x) over the columns x of a row of a region, in that order.
template <class Value>
double sum_of_row(const Region::Row& row, Value value) {
    double part[column_groups] = {}, sum = 0;
    for (int x = row.from; x < row.to; ++x) part[x % column_groups] += value(x);
    for (const double of_group : part) sum += of_group;
    return sum;
}

/// Returns the pixels at which a window's middle may be so that the window lies in the region and in a picture of that size.
Region ssim_middles(const Region&, int width, int height);

/// One of the straight lines by which srgb_code() interpolates sRGB's encoding of single-precision light between 512 points an
/// octave. It is looked up by the leading bits of the number; a power takes six times as long.
struct SrgbLine {
    float at_zero, slope;  // code = at_zero + slope * light
};
constexpr int srgb_shift = 14;                                                    // 23 bits of fraction less 9 for 512 points
constexpr std::uint32_t srgb_first = __builtin_bit_cast(std::uint32_t, 0x1p-9f);  // the lines begin below the linear part's end
/// Returns the lines from 2^-9 to 1.
const std::vector<SrgbLine>& srgb_lines();

/// Returns the sRGB code in [0, 1] of light, clipped to [0, 1], accurate to 2e-7.
LFDSIM_FN float srgb_code(const SrgbLine* lines, float x) {
    x = x > 0 ? (x < 1 ? x : 1) : 0;
    if (x <= 0.0031308f) return 12.92f * x;
    const SrgbLine l = lines[(__builtin_bit_cast(std::uint32_t, x) - srgb_first) >> srgb_shift];
    return l.at_zero + l.slope * x;
}

LFDSIM_FN float luma(const float* rgb) { return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]; }

/// Returns the luma of the sRGB codes of linear light.
LFDSIM_FN float code_luma(const SrgbLine* lines, const float* light) {
    const float codes[3] = {srgb_code(lines, light[0]), srgb_code(lines, light[1]), srgb_code(lines, light[2])};
    return luma(codes);
}

/// The Gaussian over a window, along one axis: at[k] for the pixels at distance k; all eleven sum to 1.
struct SsimWeights {
    double at[ssim_border + 1];
};
SsimWeights ssim_weights();

/// Returns the weighted sum of at(0) to at(10), from the middle outwards.
template <class At>
LFDSIM_FN double weighted(const SsimWeights& w, At at) {
    return w.at[0] * at(5) + w.at[1] * (at(4) + at(6)) + w.at[2] * (at(3) + at(7)) + w.at[3] * (at(2) + at(8)) +
           w.at[4] * (at(1) + at(9)) + w.at[5] * (at(0) + at(10));
}

/// The weighted sums over a window: of the luma a, of b, of a^2 + b^2, of a b.
enum Moment { of_a, of_b, of_squares, of_product, moments };

/// Returns the SSIM of a window with these moments: Wang et al. 2004, equation 13. The sum of the two variances is both_squares -
/// (a^2 + b^2), and the covariance both_product - a b.
LFDSIM_FN double ssim_value(double a, double b, double both_squares, double both_product) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // (K1 L)^2, (K2 L)^2 with L = 1
    const double product = a * b, squares = a * a + b * b;
    return (2 * product + c1) * (2 * (both_product - product) + c2) / ((squares + c1) * (both_squares - squares + c2));
}

}  // namespace lfdsim
