// The comparison of a view with a photograph on a wide machine. Plain data. Floor 2.
#pragma once
#include "image/compare/likeness.h"
#include "image/compare/ssim_window.h"

#include <cstdint>

namespace lfdsim::wide {

/// The steps of a comparison, in order; each says what an item is, and what it computes. Moments and values are computed for a band
/// of rows at a time. The order of all sums is that of the CPU (image/compare/likeness.cpp), so that the bits are the same.
enum class LikenessStep {
    photograph,  // a pixel of the photograph: its lumas
    view,        // a pixel of the view: its luma
    moments,     // moment_rows pixels below each other in the band: the sums of their windows down the column
    values,      // a pixel of the band: SSIM of its window
    windows,     // a group of a row's columns: sums of SSIM
    cover,       // a group of a row's columns: sums for the covered share
    rows         // one of the sums, of a row: the sum over its groups
};

/// Pixels of an item of LikenessStep::moments.
constexpr int moment_rows = 4;

/// Numbers of regions and of sums: SSIM over both regions (screen and content), then the sums for the covered share.
constexpr int likeness_regions = 2, likeness_sums = likeness_regions + cover_sums;

/// The input of every item of every step. Pointers are to the machine's memory.
struct LikenessFrame {
    std::int32_t width, height;  // pixels
    const SrgbLine* srgb;        // the table of the sRGB curve
    SsimWeights weights;
    float gain;                                             // factor of the view's light
    const float* picture;                                   // light, 3 floats a pixel, of the photograph or the view
    float *photograph_code, *photograph_light, *view_code;  // luma of sRGB codes and of light
    // The range of columns in each row, [3][height]: where windows' middles may lie in the screen and in the content; the screen.
    const Region::Row* columns;
    std::int32_t first_row, row_count;  // the band of rows
    double* moments;                    // [moments][row_count][width]
    double* values;                     // [height][width]
    double *parts, *sums;               // [likeness_sums][height][column_groups]; [likeness_sums][height]
};

}  // namespace lfdsim::wide
