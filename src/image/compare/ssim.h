// Structural similarity of two pictures. Floor 0.
#pragma once
#include "image/compare/region.h"
#include "image/image.h"

#include <span>
#include <vector>

namespace lfdsim {

constexpr int ssim_window = 11;  // pixels along its side

/// Returns the mean SSIM of the windows that lie wholly in a region, one number for each region; NaN where there are none.
/// docs/measures.md, "Measures", after Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to
/// structural similarity", IEEE TIP 13(4), 2004: luma 0.2126 R + 0.7152 G + 0.0722 B of sRGB-encoded values clipped to [0, 1],
/// Gaussian window 11 x 11 of sigma 1.5, K1 = 0.01, K2 = 0.03. The bits are the same on any number of threads. Throws InputError
/// unless both pictures have the same size.
std::vector<double> ssim(const Image& a, const Image& b, std::span<const Region> regions);

}  // namespace lfdsim
