// The items of a picture, with one lane per thread. The work itself is that of the CPU's kernels: engine/kernels, optics. Floor 2.
// Compiled as CUDA (engine/cuda) and, to test it anywhere, for the host.
#pragma once
#ifndef LFDSIM_LANES
#define LFDSIM_LANES 1
#endif
#include "engine/wide/frame.h"
#include "simd/lane.h"

namespace lfdsim {
namespace {
using F = float;
}
}  // namespace lfdsim

#include "engine/kernels/points.h"
#include "optics/camera.h"
#include "optics/light.h"
#include "optics/trace.h"

namespace lfdsim::wide {

namespace {

/// Stands for Cancelling in a machine's threads, which cannot ask the job.
struct Uncancellable {
    LFDSIM_FN static bool ends_before(std::int64_t) { return false; }
};

/// A pixel of the frame, or of a square.
struct Pixel {
    std::int32_t x, y;
};

/// Returns the first pixel of a square of the frame, `square` being its number among those rendered.
LFDSIM_FN Pixel corner_of(const Frame& frame, std::uint32_t square) {
    if (frame.listed) return {frame.listed[square].x, frame.listed[square].y};
    const auto number = std::uint32_t(frame.first_square) + square, columns = std::uint32_t(frame.columns);
    return {(frame.first_column + std::int32_t(number % columns)) * refined_side,
            (frame.first_row + std::int32_t(number / columns)) * refined_side};
}

/// Returns pixel `number` of a square, counted from the square's first. Those of 32 threads that run together lie in 8 x 4 pixels.
LFDSIM_FN Pixel pixel_of_square(std::uint32_t number) {
    static_assert(refined_side == 16);
    const int part = int(number) >> 5, within = int(number) & 31;
    return {((part & 1) << 3) + (within & 7), (part >> 1 << 2) + (within >> 3)};
}

/// Returns where the light of the frame's pixel (x, y), in a square, is written; nullptr if the pixel lies outside the tile.
LFDSIM_FN float* output(const Frame& frame, std::uint32_t square, std::int32_t x, std::int32_t y) {
    const Tile& tile = frame.tile;
    const bool wanted = x >= tile.x0 && x < tile.x1 && y >= tile.y0 && y < tile.y1;
    if (!wanted) return nullptr;
    if (!frame.listed) return tile.out + (std::int64_t(y - tile.crop_y) * tile.crop_width + (x - tile.crop_x)) * 3;
    return tile.out + ((std::int64_t(square) * refined_side + y % refined_side) * refined_side + x % refined_side) * 3;
}

/// Computes item i: the mean of all samples of a pixel. There are fewer than 2^32 items (render.cpp); a GPU divides 64-bit numbers
/// by a hundred instructions.
template <optics::Facts facts, bool sobol>
LFDSIM_FN void point_item(const Frame& frame, std::int64_t i) {
    Tile tile = frame.tile;
    tile.display = &frame.display;
    tile.view = &frame.view;
    tile.directions = &frame.directions;
    constexpr std::uint32_t each = refined_side * refined_side;
    const std::uint32_t square = std::uint32_t(i) / each;
    const Pixel corner = corner_of(frame, square), in = pixel_of_square(std::uint32_t(i) % each);
    const std::int32_t x = corner.x + in.x, y = corner.y + in.y;
    float* const out = output(frame, square, x, y);
    if (!out) return;
    const std::uint32_t number = std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x);
    Uncancellable to_the_end;
    const optics::Light<F> light = gather_one<facts, sobol>(tile, optics::pixel_rays<F>(*tile.view, x, y), number, to_the_end);
    for (int c = 0; c < 3; ++c) out[c] = light(0, c) / float(tile.samples);
}

}  // namespace

}  // namespace lfdsim::wide
