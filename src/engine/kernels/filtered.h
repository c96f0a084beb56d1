// The filtered estimator on the CPU: blocks of pixels that share footprints.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/estimator/limits.h"
#include "engine/estimator/panel_light.h"
#include "engine/estimator/shared_footprint.h"
#include "engine/estimator/strata.h"
#include "engine/kernels/cancelling.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_footprints.h"
#include "engine/kernels/lens_by_lens.h"
#include "optics/camera.h"
#include "optics/light.h"

#include <cstddef>

namespace lfdsim {

namespace {

/// Light that varies smoothly over a block is computed at its places, the corners of squares of place_step pixels, at most 5 x 5,
/// and interpolated between them, unless there are many strata, for a finer picture.
constexpr int most_side = 16, place_step = FilteredLimits::place_step, most_places = most_side / place_step + 1, most_lanes = 32;

/// A narrow footprint, and the share of the light at each place that comes through it.
struct NarrowFootprint {
    const LitFootprint* footprint;
    S weight[most_lanes];
};
constexpr int most_narrow = 2 * (few_strata + more_strata) * (few_strata + more_strata);  // two for each stratum

/// The memory of a thread, too large for its stack.
struct FilteredMemory {
    Axis axis[2];
    SharedFootprints footprints[max_strata * max_strata];  // row after row
    NarrowFootprint narrow[most_narrow];                   // where there are places, in the order of the footprints
    S light[most_lanes][4];                                // of wide footprints at places
    S picture[most_side][most_side][4];                    // of the block
    LensByLensMemory lenses;

    /// Placement new, whose header of the standard library kernels do not include.
    static void* operator new(std::size_t, void* at) noexcept { return at; }
};

/// Renders a block of pixels.
class FilteredBlock {
  public:
    FilteredBlock(const Tile& t, FilteredMemory& m, int side_pixels, std::int32_t x, std::int32_t y)
        : tile(t),
          display(*t.display),
          memory(m),
          side(side_pixels),
          per_axis(t.strata > few_strata || side <= place_step ? 0 : side / place_step + 1),
          x0(x),
          y0(y),
          block(optics::pixel_block<S>(display, *t.view, side,
                                       S(t.strata > few_strata ? FilteredLimits::misjudged_fine : FilteredLimits::misjudged), x,
                                       y)) {}

    /// Returns false if the pixels cannot share all footprints; then nothing is rendered.
    bool render(const EvenCuts& even) {
        if (!block.alive) return false;
        for (int a = 0; a < 2; ++a)
            if (!cut_axis(display, block.sweep[a], a, even, memory.axis[a])) return false;
        if (!FootprintMaker(tile, block, memory.axis).make_all(memory.footprints)) return false;
        if (per_axis > 0) {
            list_footprints();
            for (int k = 0; k < per_axis * per_axis; k += Packet::lanes) look_at_places(k);
        }
        if (any_wide)
            interpolate();
        else
            __builtin_memset(memory.picture, 0, sizeof memory.picture);
        if (narrow_count > 0 || per_axis == 0) look_up_pixels();
        write();
        return true;
    }

  private:
    using Packet = optics::Block<F>;
    using State = LitFootprint::State;

    /// Lists the narrow footprints, and finds out whether there are wide ones.
    void list_footprints() {
        for (int k = 0; k < memory.axis[0].strata * memory.axis[1].strata; ++k)
            for (const LitFootprint* b : {&memory.footprints[k].through, &memory.footprints[k].beside}) {
                any_wide = any_wide || b->state == State::wide;
                if (b->state == State::narrow) memory.narrow[narrow_count++].footprint = b;
            }
    }

    /// Computes, for a packet of places from number k on, row by row, the light of wide footprints and the weights of narrow ones.
    /// Places beyond the last one repeat its row; nothing reads them.
    void look_at_places(int k) {
        constexpr int lanes = Packet::lanes;
        const S per_reach = S(1) / S(block.reach);
        S right[lanes], down[lanes];  // picture pixels from the block's middle
        for (int n = 0; n < lanes; ++n) {
            right[n] = S((k + n) % per_axis * place_step - block.reach);
            down[n] = S(optics::min((k + n) / per_axis, per_axis - 1) * place_step - block.reach);
        }
        F flat[3] = {F(0), F(0), F(0)};
        NarrowFootprint* next = memory.narrow;
        const F dx = optics::load<F>(right) * F(per_reach), dy = optics::load<F>(down) * F(per_reach);
        for_footprints(dx, dy, [&](const LitFootprint& b, F weight) {
            if (b.state == State::wide) add_wide(b, dx, dy, weight, flat);
            if (b.state == State::narrow) optics::store(weight, next++->weight + k);
        });
        S colour[3][lanes];
        for (int c = 0; c < 3; ++c) optics::store(flat[c], colour[c]);
        for (int n = 0; n < lanes; ++n)
            for (int c = 0; c < 3; ++c) memory.light[k + n][c] = colour[c][n];
    }

    /// Interpolates the light at places bilinearly for the pixels between them, whose centres are half a pixel from the corners.
    void interpolate() {
        const S per = S(1) / S(place_step);
        const auto between = [](S a, S b, S share) { return a + (b - a) * share; };
        for (int y = 0; y < side; ++y) {
            const S t = (S(y % place_step) + S(0.5)) * per;
            const S(*const upper)[4] = memory.light + y / place_step * per_axis;
            S row[most_places][4];
            for (int i = 0; i < per_axis; ++i)
                for (int c = 0; c < 4; ++c) row[i][c] = between(upper[i][c], upper[per_axis + i][c], t);
            for (int i = 0; i + 1 < per_axis; ++i)
                for (int k = 0; k < place_step; ++k)
                    for (int c = 0; c < 4; ++c)
                        memory.picture[y][i * place_step + k][c] = between(row[i][c], row[i + 1][c], (S(k) + S(0.5)) * per);
        }
    }

    /// Adds the light that is looked up for each pixel.
    void look_up_pixels() {
        for (std::int32_t y = y0; y < y0 + side; y += Packet::height) {
            for (std::int32_t x = x0; x < x0 + side; x += Packet::width) {
                if (x >= tile.x1 || y >= tile.y1 || x + Packet::width <= tile.x0 || y + Packet::height <= tile.y0) continue;
                S found[Packet::height][Packet::width * 4];
                look_from(x, y, found[0]);
                for (int row = 0; row < Packet::height; ++row) {
                    S* const to = memory.picture[y - y0 + row][x - x0];
                    for (int k = 0; k < Packet::width * 4; ++k) to[k] = to[k] + found[row][k];
                }
            }
        }
    }

    /// Looks up the light of the packet at (x, y) of the frame: R, G, B and an unused number of each pixel.
    void look_from(std::int32_t x, std::int32_t y, S* found) const {
        S right_of[Packet::lanes], below[Packet::lanes];  // of the packet's first pixel
        for (int k = 0; k < Packet::lanes; ++k) {
            right_of[k] = S(k % Packet::width) + S(0.5);
            below[k] = S(k / Packet::width) + S(0.5);
        }
        const F right = optics::load<F>(right_of), down = optics::load<F>(below);
        const F dx = right + F(S(x - x0 - block.reach)), dy = down + F(S(y - y0 - block.reach));  // from the block's middle
        optics::Light<F> boxes;
        if (per_axis > 0) {
            add_narrow(x - x0, y - y0, right, down, dx, dy, boxes);
            return boxes.store(found);
        }
        F flat[3] = {F(0), F(0), F(0)};
        add_all(dx, dy, boxes, flat);
        boxes.store(found);
        for (int c = 0; c < 3; ++c) {
            S colour[Packet::lanes];
            optics::store(flat[c], colour);
            for (int k = 0; k < Packet::lanes; ++k) found[4 * k + c] = found[4 * k + c] + colour[k];
        }
    }

    /// Adds the light of narrow footprints for the packet whose first pixel is (x, y) of the block; their weights are interpolated
    /// bilinearly between the four places around the packet.
    void add_narrow(int x, int y, F right, F down, F dx, F dy, optics::Light<F>& to) const {
        const int corner = y / place_step * per_axis + x / place_step;
        const F per = F(S(1) / S(place_step)), s = (right + F(S(x % place_step))) * per, t = (down + F(S(y % place_step))) * per;
        optics::Light<F> sum = to;
        for (const NarrowFootprint* k = memory.narrow; k < memory.narrow + narrow_count; ++k) {
            const S *const upper = k->weight + corner, *const lower = upper + per_axis;
            if (!(upper[0] + upper[1] + lower[0] + lower[1] > S(0))) continue;
            const F above = F(upper[0]) + F(upper[1] - upper[0]) * s, beneath = F(lower[0]) + F(lower[1] - lower[0]) * s;
            add_box(*k->footprint, dx, dy, above + (beneath - above) * t, sum);
        }
        to = sum;
    }

    /// Adds the light of all footprints for the pixels at (dx, dy) picture pixels from the block's middle: of narrow ones to
    /// `boxes`, of wide ones to `flat`.
    void add_all(F dx, F dy, optics::Light<F>& boxes, F (&flat)[3]) const {
        const S reach = S(block.reach), per_reach = S(1) / reach;
        const F right = dx * F(per_reach), down = dy * F(per_reach);
        for_footprints(right, down, [&](const LitFootprint& b, F weight) {
            if (b.state == State::unlit || optics::none(weight > F(0))) return;
            if (b.state == State::wide) add_wide(b, right, down, weight, flat);
            if (b.state == State::narrow) add_box(b, right * F(reach), down * F(reach), weight, boxes);
        });
    }

    /// Adds `weight` times the light of a wide footprint at (dx, dy), -1 .. 1 across the block: bilinear between its nodes.
    LFDSIM_FN static void add_wide(const LitFootprint& b, F dx, F dy, F weight, F (&to)[3]) {
        for (int c = 0; c < 3; ++c) to[c] = to[c] + weight * wide_light(b, dx, dy, c);
    }
    /// Returns colour c of that light. Nodes are at the ends of the block and, if there are three, in its middle.
    LFDSIM_FN static F wide_light(const LitFootprint& b, F dx, F dy, int c) {
        const auto between = [](S low, S middle, S high, F at) {
            return F(middle) + F(high - middle) * optics::max(at, F(0)) + F(middle - low) * optics::min(at, F(0));
        };
        const int n = b.nodes;
        if (n == 1) return F(b.colour[0][c]);
        F row[optics::most_nodes];
        const auto at = [&](int j, int i) { return b.colour[j * n + i][c]; };
        if (n == 2) {
            const F half = F(S(0.5)), s = half + half * dx, t = half + half * dy;
            for (int j = 0; j < 2; ++j) row[j] = F(at(j, 0)) + F(at(j, 1) - at(j, 0)) * s;
            return row[0] + (row[1] - row[0]) * t;
        }
        for (int j = 0; j < 3; ++j) row[j] = between(at(j, 0), at(j, 1), at(j, 2), dx);
        return row[1] + (row[2] - row[1]) * optics::max(dy, F(0)) + (row[1] - row[0]) * optics::min(dy, F(0));
    }

    /// Adds `weight` times the light of a narrow footprint, one box, for the pixels at (dx, dy) picture pixels from the block's
    /// middle. Its position moves linearly over the block.
    LFDSIM_FN void add_box(const LitFootprint& b, F dx, F dy, F weight, optics::Light<F>& light) const {
        const F column = F(b.column) + F(b.column_right) * dx + F(b.column_down) * dy,
                row = F(b.row) + F(b.row_right) * dx + F(b.row_down) * dy;
        const optics::Boxes<F> box{column, row, F(optics::max(b.width, S(optics::least_box))),
                                   F(optics::max(b.height, S(optics::least_box))), weight};
        if (display.emission.whole && optics::max(b.width, b.height) <= S(1))
            return optics::add_small_boxes(tile.panel.plane[0], block.lens.panel, box, light);
        optics::Light<F> sum = light;  // the function below takes an address: `light` itself stays in registers
        add_other_box(box, sum);
        light = sum;
    }
    LFDSIM_APART void add_other_box(const optics::Boxes<F>& box, optics::Light<F>& light) const {
        optics::add_light(tile.panel, block.lens.panel, box, light);
    }

    /// Calls f(footprint, its share of the light) for each footprint, in their order, with the shares of the lanes at (dx, dy) of
    /// the block, -1 .. 1: share of the domain x share of it that the hole covers, or does not cover, x transmittance. Footprints
    /// that no lane sees are passed with the share 0, as f() counts them.
    template <class Do>
    LFDSIM_FN void for_footprints(F dx, F dy, const Do& f) const {
        optics::Span<F> across[max_strata];
        const Axis(&axis)[2] = memory.axis;
        Spans columns(display, axis[0], 0, dx, dy), rows(display, axis[1], 1, dx, dy);
        for (int i = 0; i < axis[0].strata; ++i) across[i] = columns.next();
        const SharedFootprints* next = memory.footprints;
        for (int j = 0; j < axis[1].strata; ++j) {
            const optics::Span<F> up = rows.next();
            for (int i = 0; i < axis[0].strata; ++i, ++next) {
                const F share = across[i].share * up.share;
                if (optics::none(share > F(0))) {  // only other pixels of the block see it
                    f(next->through, F(0));
                    f(next->beside, F(0));
                    continue;
                }
                const F cover = display.hole_radius == 0 ? F(1) : optics::hole_coverage(across[i], up);
                f(next->through, share * cover * F(next->through.weight));
                f(next->beside, share * (F(1) - cover) * F(next->beside.weight));
            }
        }
    }

    /// Writes those pixels of the block that belong to the tile.
    void write() const {
        const int from = optics::max(int(tile.x0 - x0), 0), to = optics::min(int(tile.x1 - x0), side);
        for (int y = optics::max(int(tile.y0 - y0), 0); y < optics::min(int(tile.y1 - y0), side); ++y) {
            S* out = tile.out + (std::int64_t(y0 + y - tile.crop_y) * tile.crop_width + (x0 + from - tile.crop_x)) * 3;
            for (int x = from; x < to; ++x, out += 3) __builtin_memcpy(out, memory.picture[y][x], 3 * sizeof(S));
        }
    }

    const Tile& tile;
    const optics::TracedDisplay<S>& display;
    FilteredMemory& memory;
    const int side, per_axis;   // places along an axis; 0: none
    const std::int32_t x0, y0;  // first pixel
    const optics::PixelBlock<S> block;
    int narrow_count = 0;   // narrow footprints, where there are places
    bool any_wide = false;  // footprints, where there are places
};

/// Renders a tile block by block.
class FilteredEstimator {
  public:
    explicit FilteredEstimator(const Tile& t)
        : tile(t),
          even(*t.display, t.strata),
          memory(*new (block_memory(sizeof(FilteredMemory))) FilteredMemory),
          lens_by_lens(t, memory.lenses) {}

    /// Renders a block, or its quarters where its pixels cannot share all footprints; the smallest blocks lens by lens.
    void render(int side, std::int32_t x, std::int32_t y) {
        if (x >= tile.x1 || y >= tile.y1 || x + side <= tile.x0 || y + side <= tile.y0) return;
        const int least = tile.strata > few_strata ? 8 : 4;
        if (side >= least && FilteredBlock(tile, memory, side, x, y).render(even)) return;
        if (side == optics::shared_width) return lens_by_lens.render(x, y);
        for (int k = 0; k < 4; ++k) render(side / 2, x + k % 2 * (side / 2), y + k / 2 * (side / 2));
    }

  private:
    const Tile& tile;
    const EvenCuts even;
    FilteredMemory& memory;
    LensByLens lens_by_lens;
};

/// Renders a tile by the filtered estimator. Not inlined, so that its stack frame is separate.
__attribute__((noinline)) bool render_filtered(const Tile& tile) {
    FilteredEstimator estimator(tile);
    Cancelling cancelling(tile);
    const std::int32_t side = tile.block_side;
    for (std::int32_t y = tile.y0 / side * side; y < tile.y1; y += side)
        for (std::int32_t x = tile.x0 / side * side; x < tile.x1; x += side) {
            if (cancelling.ends_before(std::int64_t(tile.strata) * tile.strata * side * side)) return false;
            estimator.render(side, x, y);
        }
    return true;
}

}  // namespace

}  // namespace lfdsim
