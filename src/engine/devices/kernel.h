// A kernel's work, and the kernels compiled in. Plain data, common to all instruction sets. Floor 2.
#pragma once
#include "optics/traced_display.h"

#include <cstddef>

namespace lfdsim {

class Job;

/// Where a ray ends on the panel.
struct PanelRay {
    std::uint32_t place;  // panel pixel, row x columns + column; with subpixels four times that plus the one lit channel (3: all)
    float share;          // of the pixel's light that the ray carries; 0: the ray ends on none

    std::uint32_t pixel(bool subpixels) const { return subpixels ? place >> 2 : place; }
    bool lights(std::uint32_t channel, bool subpixels) const { return !subpixels || (place & 3) == 3 || (place & 3) == channel; }
};

/// A tile of the picture and how it is rendered: pixels x0 .. x1-1, y0 .. y1-1 of the whole frame. The light of pixel (x, y) goes
/// to out[((y - crop_y) crop_width + x - crop_x) 3], three floats, linear light.
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
    std::uint32_t samples;  // a pixel, where it is rendered by points
    int strata;             // rows and columns of strata, 1 .. max_strata - more_strata; 0: point samples
    bool lens_by_lens;      // else by blocks that share rays
    int block_side;         // of these: pixels, 16, 8 or 4
    bool cuts_pixel;        // lens by lens: outlines of lenses cut the pixel's area, not the diffuser's angles
    Sampling sampling;
    int dimensions;            // number of the sampler's dimensions in use
    const Job* job = nullptr;  // if given, is asked on the way whether it was cancelled
};

/// The side, pixels, of the squares of the frame that are rendered until their error is small enough (refine.h).
constexpr int refined_side = 16;

/// How far the work on a picture got.
struct Done {
    std::int64_t samples;
    bool complete;  // false: the job was cancelled on the way
};

constexpr int max_strata = 64;  // most rows or columns of strata, those added at borders of lenses included
constexpr int more_strata = 2;  // most rows or columns that are added at borders of lenses
constexpr int few_strata = 8;   // up to this number along an axis the filtered estimator prefers speed, above it accuracy

/// Returns memory for what a block of the filtered estimator works on, some megabytes, which is too much for a thread's stack. It
/// belongs to the calling thread, until that ends, is aligned to 64 bytes and not cleared; the next call returns the same, or a
/// larger one if it needs more. Throws std::bad_alloc.
void* block_memory(std::size_t bytes);

/// Returns whether a job was cancelled: for kernels, which do not include the class.
bool is_cancelled(const Job&);

/// A function that renders a tile on the calling thread. All kernels give the same bits. Returns false where the tile's job was
/// cancelled on the way: pixels that were not finished are then as they were.
using Kernel = bool (*)(const Tile&);

// The kernels of the instruction sets; which are compiled in: kernels.cmake.
bool render_tile_scalar(const Tile&);
bool render_tile_baseline(const Tile&);
bool render_tile_avx2(const Tile&);
bool render_tile_avx512(const Tile&);

}  // namespace lfdsim
