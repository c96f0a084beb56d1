// The items of each step, with one lane per thread. The work itself is that of the CPU's kernels: engine/kernels, optics. Floor 2.
// Compiled as CUDA (engine/cuda) and, to test it anywhere, for the host.
#pragma once
#ifndef LFDSIM_LANES
#define LFDSIM_LANES 1
#endif
#define LFDSIM_PLAIN_WAYS  // worth their code there (optics/trace.h)
#include "engine/wide/frame.h"
#include "optics/lane.h"

namespace lfdsim {
namespace {
using F = float;
}
}  // namespace lfdsim

#include "engine/kernels/filtered_block.h"
#include "engine/kernels/points.h"

namespace lfdsim::wide {

namespace {

LFDSIM_FN Tile tile_of(const Frame& frame) {
    Tile tile = frame.tile;
    tile.scene = &frame.scene;
    tile.view = &frame.view;
    tile.directions = &frame.directions;
    tile.panel.emission = &frame.scene.emission;
    return tile;
}

struct Pixel {
    std::int32_t x, y;
};

/// Of items, blocks, workers. A step has fewer than 2^32 (render.cpp); a GPU divides 64-bit numbers by a hundred instructions.
using Number = std::uint32_t;

LFDSIM_FN Pixel corner_of(const Frame& frame, Number block) {
    const Number number = Number(frame.first_block) + block, columns = Number(frame.columns);
    if (frame.listed) return {frame.listed[number].x, frame.listed[number].y};
    return {(frame.first_column + std::int32_t(number % columns)) * frame.tile.block_side,
            (frame.first_row + std::int32_t(number / columns)) * frame.tile.block_side};
}

/// A pixel of a step that works on the pixels of blocks, one after another. Blocks are 4, 8 or 16 pixels wide, so that this needs
/// no division.
struct BlockPixel {
    Number block;
    Pixel in;  // those of 32 threads that run together lie in 8 x 4 pixels (4 x 4 in the smallest blocks)

    LFDSIM_FN BlockPixel(const Tile& tile, Number i) {
        const int bits = tile.block_side == 4 ? 2 : tile.block_side == 8 ? 3 : 4, wide = bits < 3 ? 2 : 3, across = bits - wide;
        block = i >> (2 * bits);
        const int k = int(i) & ((1 << 2 * bits) - 1), part = k >> (wide + 2), within = k & ((4 << wide) - 1);
        in.x = ((part & ((1 << across) - 1)) << wide) + (within & ((1 << wide) - 1));
        in.y = (part >> across << 2) + (within >> wide);
    }
};

/// Where the light of the frame's pixel (x, y), in the block, is written; nullptr: it is not needed.
LFDSIM_FN float* output(const Frame& frame, Number block, std::int32_t x, std::int32_t y) {
    const Tile& tile = frame.tile;
    const bool wanted = x >= tile.x0 && x < tile.x1 && y >= tile.y0 && y < tile.y1;
    if (!wanted) return nullptr;
    if (!frame.listed) return tile.out + (std::int64_t(y - tile.crop_y) * tile.crop_width + (x - tile.crop_x)) * 3;
    const std::int64_t square = frame.listed[Number(frame.first_block) + block].square;
    return tile.out + ((square * refined_side + y % refined_side) * refined_side + x % refined_side) * 3;
}

/// The memory of a block.
struct BlockLayout {
    std::size_t light, sharp, grid, cut, stratum, bundles, end;

    LFDSIM_FN explicit BlockLayout(int across, const Room& room) {
        light = (sizeof(BlockState) + 15) / 16 * 16;
        sharp = light + sizeof(S[most_lanes][4]);
        grid = sharp + (across <= few_strata ? std::size_t(2 * room.strata) : 0) * sizeof(Sharp);
        cut = grid + std::size_t(room.grids) * sizeof(Grid);
        stratum = cut + std::size_t(room.cuts) * sizeof(Cut);
        bundles = (stratum + std::size_t(room.cuts) * sizeof(Stratum) + 15) / 16 * 16;
        end = (bundles + std::size_t(room.strata) * sizeof(Bundles) + 127) / 128 * 128;
    }
};

LFDSIM_FN Room room_of(const Frame& frame) { return Room(frame.tile.strata, frame.scene.by_lens); }

LFDSIM_FN BlockState& state_of(const Frame& frame, Number block) {
    return *reinterpret_cast<BlockState*>(frame.memory + std::size_t(block) * frame.bytes_per_block);
}

/// Adds first, first + 1, ... to a list.
LFDSIM_FN void append(const WorkList& list, std::uint32_t first, std::uint32_t count) {
#ifdef __CUDA_ARCH__
    std::uint32_t* to = list.number + atomicAdd(list.count, count);
#else
    std::uint32_t* to = list.number + __atomic_fetch_add(list.count, count, __ATOMIC_RELAXED);
#endif
    for (std::uint32_t k = 0; k < count; ++k) to[k] = first + k;
}

template <optics::Way through, bool sobol>
LFDSIM_FN void point_item(const Frame& frame, Number i) {
    const Tile tile = tile_of(frame);
    const BlockPixel pixel(tile, i);
    const Pixel corner = corner_of(frame, pixel.block);
    const std::int32_t x = corner.x + pixel.in.x, y = corner.y + pixel.in.y;
    float* const out = output(frame, pixel.block, x, y);
    if (!out) return;
    const std::uint32_t number = std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x);
    const optics::Light<F> light = gather_one<through, sobol>(tile, optics::pixel_rays<F>(*tile.view, x, y), number);
    for (int c = 0; c < 3; ++c) out[c] = light(0, c) / float(tile.samples);
}

LFDSIM_FN void even_item(const Frame& frame, Number i) {
    EvenCuts& even = *static_cast<EvenCuts*>(frame.even);
    even.strata = frame.tile.strata;
    even.set(frame.scene, int(i));
}

template <optics::Way through>
LFDSIM_FN void block_item(const Frame& frame, Number i) {
    const Tile tile = tile_of(frame);
    BlockState& state = state_of(frame, i);
    std::byte* const at = reinterpret_cast<std::byte*>(&state);
    const BlockLayout layout(tile.strata, room_of(frame));
    state.light = reinterpret_cast<S(*)[4]>(at + layout.light);
    state.sharp = reinterpret_cast<Sharp*>(at + layout.sharp);
    state.grids.grid = reinterpret_cast<Grid*>(at + layout.grid);
    state.grids.cut = reinterpret_cast<Cut*>(at + layout.cut);
    state.grids.stratum = reinterpret_cast<Stratum*>(at + layout.stratum);
    state.bundles = reinterpret_cast<Bundles*>(at + layout.bundles);
    const Pixel corner = corner_of(frame, i);
    BlockWork<through> work(tile, state);
    work.begin(*static_cast<const EvenCuts*>(frame.even), corner.x, corner.y);
    append(frame.bundles, i * Number(room_of(frame).strata), Number(work.strata()));
}

template <optics::Way through>
LFDSIM_FN void bundle_worker(const Frame& frame, Number worker) {
    const Tile tile = tile_of(frame);
    const std::uint32_t each = std::uint32_t(room_of(frame).strata), count = *frame.bundles.count;
    constexpr int team = optics::probe_threads;
    for (Number k = worker / team; k < count; k += Number(frame.workers) / team) {
        const std::uint32_t number = frame.bundles.number[k];
        BlockWork<through>(tile, state_of(frame, number / each)).make_bundle(int(number % each));
    }
}

/// Do its pixels look for light by themselves?
LFDSIM_FN bool is_busy(const BlockState& block) { return block.sharps > 0 || block.any_alone; }

template <optics::Way through>
LFDSIM_FN void survey_item(const Frame& frame, Number i) {
    const Tile tile = tile_of(frame);
    BlockState& state = state_of(frame, i);
    BlockWork<through>(tile, state).survey();
    if (is_busy(state)) append(state.block.alive ? frame.busy : frame.alone, i, 1);
}

template <optics::Way through>
LFDSIM_FN void place_item(const Frame& frame, Number i) {
    const Tile tile = tile_of(frame);
    const Number each = Number(places_per_axis(tile) * places_per_axis(tile));
    BlockWork<through>(tile, state_of(frame, i / each)).template look_at_places<few_strata + more_strata>(int(i % each));
}

/// The light of soft bundles at a pixel of a block.
LFDSIM_FN void soft_light_at(const BlockState& state, Pixel in, S (&light)[3]) {
    if (!state.any_soft) return;
    const S per = S(1) / S(place_step), s = (S(in.x % place_step) + S(0.5)) * per, t = (S(in.y % place_step) + S(0.5)) * per;
    // Aligned so that a row of it is one load.
    const auto* const all = static_cast<const S(*)[4]>(__builtin_assume_aligned(state.light, 16));
    const S(*const upper)[4] = all + in.y / place_step * state.per_axis + in.x / place_step;
    const S(*const lower)[4] = upper + state.per_axis;
    for (int c = 0; c < 3; ++c)
        light[c] = between_places(between_places(upper[0][c], lower[0][c], t), between_places(upper[1][c], lower[1][c], t), s);
}

LFDSIM_FN void soft_item(const Frame& frame, Number i) {
    const BlockPixel pixel(frame.tile, i);
    const BlockState& state = state_of(frame, pixel.block);
    if (is_busy(state)) return;
    float* const out = output(frame, pixel.block, state.x0 + pixel.in.x, state.y0 + pixel.in.y);
    if (!out) return;
    S light[3] = {};
    soft_light_at(state, pixel.in, light);
    for (int c = 0; c < 3; ++c) out[c] = light[c];
}

#ifdef __CUDA_ARCH__
LFDSIM_FN Number thread_in_block() { return threadIdx.x; }
/// The threads of a thread block wait for each other, so that they find in the cache the instructions that the first of them had to
/// wait for: a pixel runs through more code than it holds. All must call it equally often.
LFDSIM_FN void keep_in_step() { __syncthreads(); }
#else
LFDSIM_FN Number thread_in_block() { return 0; }
LFDSIM_FN void keep_in_step() {}
#endif

/// look(block, pixel of the block, its place (x, y) in the frame, where its light is written) for a worker's pixels of listed
/// blocks.
template <class Look>
LFDSIM_FN void for_listed_pixels(const Frame& frame, const WorkList& blocks, Number worker, Look look) {
    const Number count = *blocks.count * Number(frame.tile.block_side * frame.tile.block_side), thread = thread_in_block();
    for (Number first = worker - thread; first < count; first += Number(frame.workers)) {
        keep_in_step();
        const Number k = first + thread;
        if (k >= count) continue;
        const BlockPixel pixel(frame.tile, k);
        const Number block = blocks.number[pixel.block];
        BlockState& state = state_of(frame, block);
        const std::int32_t x = state.x0 + pixel.in.x, y = state.y0 + pixel.in.y;
        if (float* const out = output(frame, block, x, y)) look(state, pixel.in, x, y, out);
    }
}

template <optics::Way through, int most>
LFDSIM_FN void pixel_worker(const Frame& frame, Number worker) {
    const Tile tile = tile_of(frame);
    for_listed_pixels(frame, frame.busy, worker, [&](BlockState& state, Pixel in, std::int32_t x, std::int32_t y, float* out) {
        S light[3] = {}, found[4];
        soft_light_at(state, in, light);
        BlockWork<through>(tile, state).template look_from<most>(x, y).store(found, state.per_axis == 0);
        for (int c = 0; c < 3; ++c) out[c] = light[c] + found[c];
    });
}

template <optics::Way through>
LFDSIM_FN void alone_worker(const Frame& frame, Number worker) {
    const Tile tile = tile_of(frame);
    const EvenCuts& even = *static_cast<const EvenCuts*>(frame.even);
    for_listed_pixels(frame, frame.alone, worker, [&](const BlockState&, Pixel, std::int32_t x, std::int32_t y, float* out) {
        S light[4];
        light_alone<through>(tile, even, x, y).store(light);
        for (int c = 0; c < 3; ++c) out[c] = light[c];
    });
}

/// Item i of a step. `simple`: for points, Sobol points; for pixels, few strata.
template <Step step, optics::Way through, bool simple>
LFDSIM_FN void item(const Frame& frame, std::int64_t number) {
    const Number i = Number(number);
    if constexpr (step == Step::points) point_item<through, simple>(frame, i);
    if constexpr (step == Step::even) even_item(frame, i);
    if constexpr (step == Step::blocks) block_item<through>(frame, i);
    if constexpr (step == Step::bundles) bundle_worker<through>(frame, i);
    if constexpr (step == Step::survey) survey_item<through>(frame, i);
    if constexpr (step == Step::places) place_item<through>(frame, i);
    if constexpr (step == Step::soft) soft_item(frame, i);
    if constexpr (step == Step::pixels) pixel_worker<through, simple ? few_strata + more_strata : max_strata>(frame, i);
    if constexpr (step == Step::alone) alone_worker<through>(frame, i);
}

/// do_it.operator()<way>() for the way through the frame's display that a step is compiled for: any of them where a step traces
/// many rays; a general one where it traces few; `ideal`, which stands for all, where it traces none.
template <Step step, class Do>
void with_way_of_step(const Frame& frame, const Do& do_it) {
    if constexpr (step == Step::points || step == Step::alone)
        optics::with_way(frame.scene, do_it);
    else if constexpr (step == Step::bundles || step == Step::pixels)
        optics::with_way(frame.scene, [&]<optics::Way way>() { do_it.template operator()<optics::for_few_rays(way)>(); });
    else
        do_it.template operator()<optics::Way::ideal>();
}

/// do_it.operator()<way>() for all ways that a step is compiled for (some several times).
template <Step step, class Do>
void for_all_ways_of_step(const Do& do_it) {
    if constexpr (step == Step::points || step == Step::alone)
        optics::for_all_ways(do_it);
    else if constexpr (step == Step::bundles || step == Step::pixels)
        optics::for_all_ways([&]<optics::Way way>() { do_it.template operator()<optics::for_few_rays(way)>(); });
    else
        do_it.template operator()<optics::Way::ideal>();
}

/// do_it.operator()<step, simple>() for a step of the frame.
template <class Do>
void choose_step(Step step, const Frame& frame, const Do& do_it) {
    switch (step) {
        case Step::points:
            return frame.tile.sampling == Sampling::sobol ? do_it.template operator()<Step::points, true>()
                                                          : do_it.template operator()<Step::points, false>();
        case Step::even:
            return do_it.template operator()<Step::even, true>();
        case Step::blocks:
            return do_it.template operator()<Step::blocks, true>();
        case Step::bundles:
            return do_it.template operator()<Step::bundles, true>();
        case Step::survey:
            return do_it.template operator()<Step::survey, true>();
        case Step::places:
            return do_it.template operator()<Step::places, true>();
        case Step::soft:
            return do_it.template operator()<Step::soft, true>();
        case Step::pixels:
            return frame.tile.strata <= few_strata ? do_it.template operator()<Step::pixels, true>()
                                                   : do_it.template operator()<Step::pixels, false>();
        case Step::alone:
            return do_it.template operator()<Step::alone, true>();
    }
}

}  // namespace

}  // namespace lfdsim::wide
