// Measures of how alike two pictures are. Floor 0, public.
#pragma once
#include "image/image.h"

#include <optional>

namespace lfdsim {

struct Comparison {
    double ssim;            // Wang et al. 2004, luma of sRGB-encoded values: see docs/model.md
    double psnr_db;         // linear light, peak 1; infinite for equal images
    double rmse;            // linear light, over all channels
    double max_difference;  // linear light
    int max_column, max_row, max_channel;
};

/// Throws InputError unless both have the same size, at least 11 x 11. `region` restricts all figures.
Comparison compare(const Image& a, const Image& b, std::optional<Rect> region = {});

}  // namespace lfdsim
