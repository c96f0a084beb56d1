// How alike are two pictures? Floor 0.
#pragma once
#include "image/image.h"

#include <optional>

namespace lfdsim {

struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // columns x0 .. x1-1, rows y0 .. y1-1
};

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
