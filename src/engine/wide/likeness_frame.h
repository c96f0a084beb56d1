// The comparison of a view with a photograph on a wide machine. Plain data. Floor 2.
#pragma once
#include "image/compare/likeness.h"
#include "image/compare/ssim_window.h"

#include <cstdint>

namespace lfdsim::wide {

enum class LikenessStep {
    photograph,  // a pixel of the photograph: its lumas
    view,        // a pixel of the view: its luma
    moments,     // moment_rows pixels of a column of the rows at hand: the windows' sums down it
    values,      // a pixel of the rows at hand: SSIM of its window
    windows,     // a group of a row's columns: sums of SSIM
    cover,       // a group of a row's columns: sums for the covered share
    rows         // one of the sums, of a row
};

constexpr int moment_rows = 4;

/// The sums: SSIM over both regions, then those for the covered share.
constexpr int likeness_regions = 2, likeness_sums = likeness_regions + cover_sums;

/// The input of every item of every step. Pointers are to the machine's memory.
struct LikenessFrame {
    std::int32_t width, height;
    const SrgbLine* srgb;
    SsimWeights weights;
    float gain;
    const float* picture;                                   // light, 3 floats a pixel, of the photograph or the view
    float *photograph_code, *photograph_light, *view_code;  // luma of sRGB codes and of light
    // Columns in each row, [height] of each: where the windows' middles may lie, for both regions; then the screen.
    const Region::Row* columns;
    std::int32_t first_row, row_count;  // the rows at hand
    double* moments;                    // [moments][row_count][width]
    double* values;                     // [height][width]
    double *parts, *sums;               // [likeness_sums][height][column_groups]; [likeness_sums][height]
};

}  // namespace lfdsim::wide
