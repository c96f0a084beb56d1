// Measures of how alike two pictures are. Floor 0, public.
#pragma once
#include "image/image.h"

#include <optional>

namespace lfdsim {

/// The figures of docs/measures.md, "Measures".
struct Comparison {
    double ssim;                           // Wang et al. 2004, luma of sRGB-encoded values; 1 for equal images
    double psnr_db;                        // -20 log10(rmse): linear light, peak 1; infinite for equal images
    double rmse;                           // linear light, over all channels
    double max_difference;                 // linear light, of one channel; not negative
    int max_column, max_row, max_channel;  // of the first pixel, row by row, with that difference
};

/// Calls put(name, value) for each figure, by the name that it has in JSON and in Python.
template <class Put>
void visit_figures(const Comparison& c, const Put& put) {
    put("ssim", c.ssim);
    put("psnr_db", c.psnr_db);
    put("rmse", c.rmse);
    put("max_difference", c.max_difference);
    put("max_column", c.max_column);
    put("max_row", c.max_row);
    put("max_channel", c.max_channel);
}

/// Compares two pictures, or one region of both. Throws InputError unless both have the same size and the region is at least 11 x
/// 11 pixels and within them.
Comparison compare(const Image& a, const Image& b, std::optional<Rect> region = {});

}  // namespace lfdsim
