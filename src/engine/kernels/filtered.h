// The filtered estimator on the CPU: block after block, its pixels in packets.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_block.h"
#include "engine/kernels/lens_by_lens.h"
#include "optics/camera.h"
#include "optics/trace.h"

namespace lfdsim {

namespace {

/// The arrays of a BlockState, and the block's picture.
struct BlockMemory {
    S picture[most_side][most_side][4];
    S light[most_lanes][4];
    Sharp sharp[most_sharps];
    Grid grid[most_grids];
    Cut cut[most_cuts];
    Stratum stratum[most_cuts];
    Bundles bundles[max_strata * max_strata];

    /// Placement new, whose header of the standard library kernels do not include.
    static void* operator new(std::size_t, void* at) noexcept { return at; }
};

template <optics::Way through>
class BlockRenderer {
  public:
    BlockRenderer(const Tile& t, const EvenCuts& cuts, void* at, std::int32_t left, std::int32_t top)
        : tile(t), even(cuts), work(t, state), memory(*new (at) BlockMemory), picture(memory.picture) {
        state.grids.grid = memory.grid;
        state.grids.cut = memory.cut;
        state.grids.stratum = memory.stratum;
        state.bundles = memory.bundles;
        state.sharp = memory.sharp;
        state.light = memory.light;
        work.begin(even, left, top);
        work.make_bundles();
        work.survey();
    }

    /// Do the pixels share all rays?
    bool shares() const {
        if (!state.block.alive) return false;
        for (int k = 0; k < work.strata(); ++k)
            if (state.bundles[k].through.state == SharedBundle::State::broken ||
                state.bundles[k].beside.state == SharedBundle::State::broken)
                return false;
        return true;
    }

    void render() {
        for (int k = 0; k < state.per_axis * state.per_axis; k += Packet::lanes)
            work.template look_at_places<few_strata + more_strata>(k);
        if (state.any_soft) interpolate();
        if (state.sharps > 0 || state.any_alone)
            look_up_pixels();
        else if (!state.any_soft)
            __builtin_memset(picture, 0, sizeof(BlockMemory::picture));
        write();
    }

  private:
    using Packet = optics::Block<F>;

    /// Interpolates the light at places for the pixels between them.
    void interpolate() {
        const S per = S(1) / S(place_step);
        const int per_axis = state.per_axis;
        for (int y = 0; y < tile.block_side; ++y) {
            const S t = (S(y % place_step) + S(0.5)) * per;
            const S(*const upper)[4] = state.light + y / place_step * per_axis;
            S row[most_places][4];
            for (int i = 0; i < per_axis; ++i)
                for (int c = 0; c < 4; ++c) row[i][c] = between_places(upper[i][c], upper[per_axis + i][c], t);
            for (int i = 0; i + 1 < per_axis; ++i)
                for (int k = 0; k < place_step; ++k)
                    for (int c = 0; c < 4; ++c)
                        picture[y][i * place_step + k][c] = between_places(row[i][c], row[i + 1][c], (S(k) + S(0.5)) * per);
        }
    }

    /// Light that is looked up for each pixel; it comes on top of what is interpolated.
    void look_up_pixels() {
        const std::int32_t x0 = state.x0, y0 = state.y0;
        for (std::int32_t y = y0; y < y0 + tile.block_side; y += Packet::height) {
            for (std::int32_t x = x0; x < x0 + tile.block_side; x += Packet::width) {
                if (x >= tile.x1 || y >= tile.y1 || x + Packet::width <= tile.x0 || y + Packet::height <= tile.y0) continue;
                S found[Packet::height][Packet::width * 4];
                work.template look_from<max_strata>(x, y).store(found[0], state.per_axis == 0);
                for (int row = 0; row < Packet::height; ++row) {
                    S* const to = picture[y - y0 + row][x - x0];
                    if (state.any_soft)
                        for (int k = 0; k < Packet::width * 4; ++k) to[k] = to[k] + found[row][k];
                    else
                        __builtin_memcpy(to, found[row], sizeof found[row]);
                }
            }
        }
    }

    /// Writes those pixels of the block that belong to the tile.
    void write() const {
        const std::int32_t x0 = state.x0, y0 = state.y0;
        const int from = optics::max(int(tile.x0 - x0), 0), to = optics::min(int(tile.x1 - x0), tile.block_side);
        for (int y = optics::max(int(tile.y0 - y0), 0); y < optics::min(int(tile.y1 - y0), tile.block_side); ++y) {
            S* out = tile.out + (std::int64_t(y0 + y - tile.crop_y) * tile.crop_width + (x0 + from - tile.crop_x)) * 3;
            for (int x = from; x < to; ++x, out += 3) __builtin_memcpy(out, picture[y][x], 3 * sizeof(S));
        }
    }

    const Tile& tile;
    const EvenCuts& even;
    BlockState state;
    BlockWork<through> work;
    BlockMemory& memory;
    S (*const picture)[most_side][4];  // of the block
};

/// Not inlined, so that it has a stack frame of its own. False: pixels cannot share all of the block's rays, and nothing is
/// rendered.
template <optics::Way through>
__attribute__((noinline)) bool render_block(const Tile& tile, const EvenCuts& even, void* memory, std::int32_t x, std::int32_t y) {
    BlockRenderer<through> block(tile, even, memory, x, y);
    if (!block.shares()) return false;
    block.render();
    return true;
}

/// What a thread works on.
struct FilteredMemory {
    BlockMemory block;
    LensByLensMemory lenses;

    static void* operator new(std::size_t, void* at) noexcept { return at; }
};

/// Renders a block; where its pixels cannot share all rays, its quarters, and the smallest of these lens by lens.
template <optics::Way through>
void render_square(Tile tile, const EvenCuts& even, FilteredMemory& memory, LensByLens& lens_by_lens, std::int32_t x,
                   std::int32_t y) {
    if (render_block<through>(tile, even, &memory.block, x, y)) return;
    const int half = tile.block_side / 2;
    for (std::int32_t row = y; row < y + 2 * half; row += half)
        for (std::int32_t column = x; column < x + 2 * half; column += half)
            if (half > 4) {
                tile.block_side = half;
                render_square<through>(tile, even, memory, lens_by_lens, column, row);
            } else {
                lens_by_lens.render(column, row);
            }
}

/// Blocks of pixels whose rays are shared; where that does not hold for a whole block, its pixels are rendered lens by lens.
template <optics::Way through>
void render_filtered(const Tile& tile) {
    const EvenCuts even(*tile.scene, tile.strata);
    FilteredMemory& memory = *new (block_memory(sizeof(FilteredMemory))) FilteredMemory;
    LensByLens lens_by_lens(tile, memory.lenses);
    const std::int32_t side = tile.block_side;
    for (std::int32_t y = tile.y0 / side * side; y < tile.y1; y += side)
        for (std::int32_t x = tile.x0 / side * side; x < tile.x1; x += side) {
            render_square<through>(tile, even, memory, lens_by_lens, x, y);
        }
}

}  // namespace

}  // namespace lfdsim
