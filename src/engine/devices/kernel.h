// A kernel's work, and the kernels compiled in. Plain data, common to all instruction sets. Floor 2.
#pragma once
#include "optics/traced_display.h"

#include <cstddef>

namespace lfdsim {

/// Where a ray ends: a panel pixel, row x columns + column (on a panel with subpixels four times that, plus the channel of which
/// alone there is light, 3: all), and the share of its light that the ray carries. share 0: the ray ends on none.
struct PanelRay {
    std::uint32_t place;
    float share;
};

/// A tile of the picture: pixels x0 .. x1-1, y0 .. y1-1 of the whole frame. Pixel (x, y) goes to
/// out[((y - crop_y) crop_width + x - crop_x) 3].
struct Tile {
    const optics::TracedDisplay<float>* display;
    const optics::RayOrigin* view;
    const optics::DirectionNumbers* directions;
    const float* texels;  // 4 floats a panel pixel
    optics::PanelLight panel;
    float* out;
    PanelRay* rays = nullptr;  // points: kept here, `samples` for each of the crop's pixels, in place of their light in `out`
    std::int32_t crop_x, crop_y, crop_width;
    std::int32_t x0, y0, x1, y1;
    std::uint32_t samples;
    int strata;         // rows and columns of strata, 1 .. max_strata - more_strata; 0: point samples
    bool lens_by_lens;  // else by blocks that share rays
    int block_side;     // of these: pixels, 16, 8 or 4
    bool cuts_pixel;    // lens by lens: outlines of lenses cut the pixel's area, not the diffuser's angles
    Sampling sampling;
    int dimensions;  // of the sampler, those in use
};

/// Errors are estimated for squares of the frame of this many pixels a side (refine.h).
constexpr int refined_side = 16;

/// How far the work on a picture got.
struct Done {
    std::int64_t samples;
    bool complete;  // false: the job was cancelled on the way
};

constexpr int max_strata = 64;  // rows or columns of them, those at borders of lenses included
constexpr int more_strata = 2;  // at most, at borders of lenses
constexpr int few_strata = 8;   // up to so many the filtered estimator prefers speed, above that accuracy

/// Memory for what a block of the filtered estimator works on, some megabytes, which is too much for a thread's stack. It belongs
/// to the calling thread, until that ends, and is not cleared; the next call returns the same. Throws std::bad_alloc.
void* block_memory(std::size_t bytes);

using Kernel = void (*)(const Tile&);

void render_tile_scalar(const Tile&);
void render_tile_baseline(const Tile&);
void render_tile_avx2(const Tile&);
void render_tile_avx512(const Tile&);

}  // namespace lfdsim
