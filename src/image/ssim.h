// Structural similarity of two pictures. Floor 0.
#pragma once
#include "image/compare.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lfdsim {

/// Pixels of a picture: columns [from, to) of each row from `top` on. Empty rows have from >= to.
struct Region {
    struct Row {
        int from, to;
    };
    int top = 0;
    std::vector<Row> rows;

    static Region of(const Rect&);
    /// The pixels whose centres lie in a convex polygon of at least three corners (x, y), pixels from the picture's upper left
    /// corner, in a picture of width x height pixels. Throws std::invalid_argument for fewer corners.
    static Region polygon(std::span<const std::array<double, 2>> corners, int width, int height);

    std::int64_t pixels() const;
    Rect bounds() const;  // of what is not empty; 0, 0, 0, 0 if all is
    Region shifted(int columns, int rows) const;
    Region intersected(const Region&) const;
};

constexpr int ssim_window = 11;  // pixels along its side

/// Mean SSIM of windows that lie wholly in the region, one number for each region; NaN where there are none.
/// Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE TIP 13(4),
/// 2004: luma 0.2126 R + 0.7152 G + 0.0722 B of sRGB-encoded values clipped to [0, 1], Gaussian window 11 x 11 of sigma 1.5,
/// K1 = 0.01, K2 = 0.03. The same bits on any number of threads. Throws InputError unless both pictures have the same size.
std::vector<double> ssim(const Image& a, const Image& b, std::span<const Region> regions);

}  // namespace lfdsim
