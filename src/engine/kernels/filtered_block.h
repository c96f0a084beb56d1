// The filtered estimator: a block of pixels, in steps that CPU and GPU have in common.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_alone.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_bundles.h"
#include "engine/kernels/filtered_lens.h"
#include "engine/kernels/filtered_own.h"
#include "engine/kernels/filtered_parts.h"
#include "optics/bundle.h"
#include "optics/camera.h"
#include "optics/filtered_limits.h"
#include "optics/light.h"
#include "optics/strata.h"

namespace lfdsim {

namespace {

/// The light of a soft bundle, colour c, at (dx, dy), -1 .. 1 across the block: bilinear between its nodes.
LFDSIM_FN F soft_light(const SharedBundle& b, F dx, F dy, int c) {
    auto between = [](S low, S middle, S high, F at) {
        return F(middle) + F(high - middle) * optics::max(at, F(0)) + F(middle - low) * optics::min(at, F(0));
    };
    const int n = b.nodes;
    if (n == 1) return F(b.colour[0][c]);
    F row[optics::most_nodes];
    auto at = [&](int j, int i) { return b.colour[j * n + i][c]; };
    if (n == 2) {
        const F half = F(S(0.5)), s = half + half * dx, t = half + half * dy;
        for (int j = 0; j < 2; ++j) row[j] = F(at(j, 0)) + F(at(j, 1) - at(j, 0)) * s;
        return row[0] + (row[1] - row[0]) * t;
    }
    for (int j = 0; j < 3; ++j) row[j] = between(at(j, 0), at(j, 1), at(j, 2), dx);
    return row[1] + (row[2] - row[1]) * optics::max(dy, F(0)) + (row[1] - row[0]) * optics::min(dy, F(0));
}

/// The light that a packet of pixels, or of places, sees.
struct PacketLight {
    optics::Light<F> boxes;          // looked up on the panel
    F flat[3] = {F(0), F(0), F(0)};  // of soft bundles: R, G, B

    /// R, G, B and an unused number of each lane.
    LFDSIM_FN void store(S* to, bool with_flat) const {
        boxes.store(to);
        if (!with_flat) return;
        constexpr int lanes = optics::LaneTraits<F>::width;
        S colour[lanes];
        for (int c = 0; c < 3; ++c) {
            optics::store(flat[c], colour);
            for (int k = 0; k < lanes; ++k) to[4 * k + c] = to[4 * k + c] + colour[k];
        }
    }
};

/// Light that varies smoothly over a block is computed at its places, the corners of squares of place_step pixels, at most 5 x 5,
/// and interpolated between them, unless many strata ask for a finer picture.
constexpr int most_side = 16, place_step = FilteredLimits::place_step, most_places = most_side / place_step + 1, most_lanes = 32;

/// 0: none.
LFDSIM_FN int places_per_axis(const Tile& tile) {
    return tile.strata > few_strata || tile.block_side <= place_step ? 0 : tile.block_side / place_step + 1;
}

/// A sharp bundle, and the share of the light at each place that comes through it.
struct Sharp {
    const SharedBundle* bundle;
    S weight[most_lanes];
};
constexpr int most_sharps = 2 * (few_strata + 8) * (few_strata + 8);

/// The results of a block's steps. The arrays belong to the caller.
struct BlockState {
    std::int32_t x0, y0;  // first pixel
    optics::PixelBlock<S> block;
    Grids grids;       // none where the block is not alive: its pixels share nothing
    int per_axis;      // places along an axis; 0: none
    int sharps;        // sharp bundles, where there are places
    bool any_soft;     // bundles
    bool any_alone;    // strata that each pixel looks up by itself
    Bundles* bundles;  // in the order of the grids, row after row
    Sharp* sharp;      // in the order of the bundles
    S (*light)[4];     // at places, of soft bundles
};

template <optics::Way through>
class BlockWork {
  public:
    using Packet = optics::Block<F>;

    LFDSIM_BOTH BlockWork(const Tile& t, BlockState& of) : tile(t), scene(*t.scene), at(of) {}

    /// First step: the block and its axes.
    LFDSIM_BOTH void begin(const EvenCuts& even, std::int32_t left, std::int32_t top) {
        at.x0 = left;
        at.y0 = top;
        constexpr double no_limit = 1e30;  // where nothing takes the two turns as independent
        const double misjudged = tile.square.exact_turns    ? no_limit
                                 : tile.strata > few_strata ? FilteredLimits::misjudged_fine
                                                            : FilteredLimits::misjudged;
        // Worked on before it is written where a GPU would have to wait for it.
        optics::PixelBlock<S> block = optics::pixel_block<S>(scene, *tile.view, tile.block_side, S(misjudged), left, top);
        if (scene.by_lens && block.alive) block.alive = LensCutter(tile, block, at.grids).cut();
        if (!block.alive) at.grids.count = at.grids.strata = 0;
        if (block.alive && !scene.by_lens) cut_square(block, even);
        at.block = block;
        at.per_axis = places_per_axis(tile);
    }

    /// Second step: all bundles of a block, or one.
    LFDSIM_BOTH void make_bundles() {
        if (at.block.alive) BundleMaker<through>(tile, at.block).make_all(at.grids, at.bundles);
    }
    LFDSIM_BOTH void make_bundle(int k) {
        int g = 0;
        while (g + 1 < at.grids.count && at.grids.grid[g + 1].first <= k) ++g;
        const Grid& grid = at.grids.grid[g];
        const int in = k - grid.first, i = in % grid.axis[0].strata, j = in / grid.axis[0].strata;
        BundleMaker<through>(tile, at.block).make(at.bundles[k], grid, i, j);
    }
    LFDSIM_BOTH int strata() const { return at.grids.strata; }

    /// Third step: lists the sharp bundles, and whether there are soft ones, and strata for each pixel alone.
    LFDSIM_BOTH void survey() {
        at.any_soft = false;
        at.any_alone = at.per_axis == 0 || !at.block.alive;
        at.sharps = 0;
        for (int k = 0; k < strata(); ++k) {
            const Bundles& b = at.bundles[k];
            const bool broken = b.through.state == SharedBundle::State::broken;
            at.any_alone = at.any_alone || broken || b.beside.state == SharedBundle::State::broken;
            if (at.per_axis == 0 || broken) continue;
            note(b.through);
            note(b.beside);
        }
    }

    /// Fourth step: for a packet of places from number k on, the light of soft bundles and the weights of the sharp ones.
    template <int most_strata>
    LFDSIM_BOTH void look_at_places(int k) {
        constexpr int lanes = Packet::lanes;
        const int per_axis = at.per_axis, reach = at.block.reach;
        const S per_reach = S(1) / S(reach);
        S right[lanes], down[lanes];
        for (int n = 0; n < lanes; ++n) {
            right[n] = S((k + n) % per_axis * place_step - reach);
            down[n] = S(optics::min((k + n) / per_axis, per_axis - 1) * place_step - reach);
        }
        F flat[3] = {F(0), F(0), F(0)};
        Sharp* next = at.sharp;
        const F dx = optics::load<F>(right) * F(per_reach), dy = optics::load<F>(down) * F(per_reach);
        for_strata<most_strata>(dx, dy, [&](const Seen& seen) {
            const Bundles& b = *seen.bundles;
            auto weigh = [&](const SharedBundle& bundle, F weight) {
                weight = weight * F(bundle.weight);
                if (bundle.state == SharedBundle::State::soft)
                    for (int c = 0; c < 3; ++c) flat[c] = flat[c] + weight * soft_light(bundle, dx, dy, c);
                if (bundle.state == SharedBundle::State::sharp) optics::store(weight, next++->weight + k);
            };
            if (b.through.state == SharedBundle::State::broken) return;
            const F share = seen.share(), cover = cover_of(seen, share);
            weigh(b.through, share * cover);
            weigh(b.beside, share * (F(1) - cover));
        });
        S colour[3][lanes];
        for (int c = 0; c < 3; ++c) optics::store(flat[c], colour[c]);
        for (int n = 0; n < lanes; ++n)
            for (int c = 0; c < 3; ++c) at.light[k + n][c] = colour[c][n];
    }

    /// Last step, of a block that is alive (else light_alone()): the light that is looked up for each pixel of the packet at (x, y)
    /// of the frame.
    template <int most_strata>
    LFDSIM_BOTH PacketLight look_from(std::int32_t x, std::int32_t y) const {
        S right_of[Packet::lanes], below[Packet::lanes];  // of the packet's first pixel
        for (int k = 0; k < Packet::lanes; ++k) {
            right_of[k] = S(k % Packet::width) + S(0.5);
            below[k] = S(k / Packet::width) + S(0.5);
        }
        const F right = optics::load<F>(right_of), down = optics::load<F>(below);
        const F dx = right + F(S(x - at.x0 - at.block.reach)), dy = down + F(S(y - at.y0 - at.block.reach));
        PacketLight light;
        if (at.sharps > 0) add_sharp(x - at.x0, y - at.y0, right, down, dx, dy, light);
        if (at.any_alone) add_alone<most_strata>(x, y, dx, dy, light);
        return light;
    }

  private:
    /// May each pixel cut a stratum at the lenses' borders? If it sees little of a lens through it, and no light beside the holes.
    LFDSIM_BOTH bool cut_by_pixels(const Axis (&axis)[2], int i, int j) const {
        return !scene.leaky && axis[0].moving && axis[1].moving && within_a_pitch(scene, axis[0], 0, i) &&
               within_a_pitch(scene, axis[1], 1, j);
    }

    /// One grid for the whole square of angles.
    LFDSIM_BOTH void cut_square(const optics::PixelBlock<S>& block, const EvenCuts& even) {
        Grid& grid = at.grids.grid[0];
        grid.first = grid.corners = 0;
        grid.narrow = false;
        grid.raised = 0;
        grid.strip = -1;
        const int most = Room(tile.strata, false).an_axis;
        for (int a = 0; a < 2; ++a) {
            grid.axis[a].cut = at.grids.cut + a * (most + 1);
            grid.axis[a].stratum = at.grids.stratum + a * (most + 1);
            cut_axis(scene, block.sweep[a], tile.square.weak, a, even, grid.axis[a]);
        }
        at.grids.count = 1;
        at.grids.strata = grid.strata();
    }

    /// The share of a stratum that the lens's hole covers; `share`: that of the stratum.
    LFDSIM_BOTH F cover_of(const Seen& seen, F share) const {
        if (scene.hole_radius == 0) return F(1);
        const Axis(&axis)[2] = seen.grid->axis;
        const F cover = axis[0].moving || axis[1].moving ? optics::hole_cover_alone(*seen.across, *seen.up)
                                                         : optics::hole_cover(*seen.across, *seen.up);
        if (seen.corners->count == 0) return cover;
        // Only a part of the stratum is the lens's.
        const F whole = seen.across->share * seen.up->share * cover;
        return optics::min(whole / optics::max(share, F(1e-12f)), F(1));
    }

    /// Does no pixel of the packet see the lens from its centre, through the middle of the pupil, where that is all that counts?
    LFDSIM_BOTH bool unseen(const Seen& seen) const {
        if (seen.corners->count == 0 || (camera_spreads(scene) && tile.square.parts > 1)) return false;
        return optics::none(reaches(*seen.corners, {seen.across->low, seen.across->high, seen.up->low, seen.up->high}));
    }

    LFDSIM_BOTH void note(const SharedBundle& b) {
        at.any_soft = at.any_soft || b.state == SharedBundle::State::soft;
        if (b.state == SharedBundle::State::sharp) at.sharp[at.sharps++].bundle = &b;
    }

    /// Adds the light of sharp bundles for the packet whose first pixel is (x, y) of the block.
    LFDSIM_BOTH void add_sharp(int x, int y, F right, F down, F dx, F dy, PacketLight& to) const {
        const int corner = y / place_step * at.per_axis + x / place_step;
        const F per = F(S(1) / S(place_step)), s = (right + F(S(x % place_step))) * per, t = (down + F(S(y % place_step))) * per;
        optics::Light<F> sum = to.boxes;
        for (const Sharp* k = at.sharp; k < at.sharp + at.sharps; ++k) {
            const S *const upper = k->weight + corner, *const lower = upper + at.per_axis;
            if (!(upper[0] + upper[1] + lower[0] + lower[1] > S(0))) continue;
            const F above = F(upper[0]) + F(upper[1] - upper[0]) * s, beneath = F(lower[0]) + F(lower[1] - lower[0]) * s;
            add_box(*k->bundle, dx, dy, above + (beneath - above) * t, sum);
        }
        to.boxes = sum;
    }

    LFDSIM_FN void add_box(const SharedBundle& b, F dx, F dy, F weight, optics::Light<F>& light) const {
        const F column = F(b.column) + F(b.column_right) * dx + F(b.column_down) * dy,
                row = F(b.row) + F(b.row_right) * dx + F(b.row_down) * dy;
        const optics::Boxes<F> box{column, row, F(optics::max(b.width, S(optics::least_box))),
                                   F(optics::max(b.height, S(optics::least_box))), weight};
        if (scene.emission.whole && optics::max(b.width, b.height) <= S(1))
            return optics::add_small_boxes(tile.panel.plane[0], at.block.lens.panel, box, light);
        optics::Light<F> sum = light;  // the function below wants an address: `light` itself stays in registers
        add_other_box(box, sum);
        light = sum;
    }
    LFDSIM_APART void add_other_box(const optics::Boxes<F>& box, optics::Light<F>& light) const {
        optics::add_light(tile.panel, at.block.lens.panel, box, light);
    }

    /// Adds what each pixel of the packet at (x, y) of the frame computes by itself: all strata where there are no places, else the
    /// broken ones.
    template <int most_strata>
    LFDSIM_BOTH void add_alone(std::int32_t x, std::int32_t y, F dx, F dy, PacketLight& to) const {
        bool own_ready = false;
        optics::PixelRays<F> pixels;
        WaitingRays<through> waiting(tile, pixels, scene.by_lens && at.grids.clear, to.boxes);
        const optics::Uint<F> numbers = pixel_numbers(tile, x, y);
        const S reach = S(at.block.reach), per_reach = S(1) / reach;
        dx = dx * F(per_reach);
        dy = dy * F(per_reach);
        const int squares = blurs_an_axis(tile), in_square = tile.block_side / squares,
                  square = (y - at.y0) / in_square * squares + (x - at.x0) / in_square;
        for_strata<most_strata>(dx, dy, [&](const Seen& seen) {
            const Bundles& b = *seen.bundles;
            const Span<F>&across = *seen.across, &up = *seen.up;
            auto ready = [&] {
                if (!own_ready) pixels = optics::pixel_rays<F>(*tile.view, x, y);
                own_ready = true;
            };
            auto add_own = [&](Own part, F weight) {
                ready();
                waiting.trace();
                add_own_rays<through>(tile, pixels, across, up, *seen.corners, part, weight,
                                      own_sampler(tile, numbers, seen.number), to.boxes);
            };
            const bool own_beside = b.beside.state == SharedBundle::State::broken,
                       own = b.through.state == SharedBundle::State::broken;
            if (at.per_axis > 0 && !own && !own_beside) return;
            if (own && scene.by_lens) {
                if (unseen(seen)) return;
                ready();
                const OwnPixels own_pixels{pixels, numbers, dx, dy, per_reach, square};
                if (scene.leaky && scene.hole_radius > 0) return add_random_parts<through>(tile, own_pixels, seen, to.boxes);
                return add_parts(tile, at.grids, own_pixels, seen, waiting);
            }
            const F share = optics::max(seen.share(), F(0));
            if (optics::none(share > F(0))) return;  // what only other pixels of the block see
            const Axis(&axis)[2] = seen.grid->axis;
            if (own && cut_by_pixels(axis, seen.i, seen.j)) {
                Span<F> x_parts[2], y_parts[2];
                cut_at_border(scene, axis[0], 0, seen.i, dx, dy, x_parts);
                cut_at_border(scene, axis[1], 1, seen.j, dx, dy, y_parts);
                for (const Span<F>& part_y : y_parts) {
                    for (const Span<F>& part_x : x_parts) {
                        const F part = part_x.share * part_y.share;
                        if (optics::none(part > F(0))) continue;
                        ready();
                        add_own_probes(scene, part_x, part_y, part, Spread(), waiting);
                    }
                }
                return;
            }
            if (own && !b.straddles && fine_alone(tile, scene)) {
                ready();
                return add_own_probes(scene, across, up, share, Spread(), waiting);
            }
            if (own) {
                const bool covered = scene.hole_radius > 0 && !scene.leaky && !b.straddles;
                return add_own(covered ? Own::covered : Own::all, share);
            }
            const F cover = cover_of(seen, share);
            auto add = [&](const SharedBundle& bundle, F weight) {
                if (bundle.state == SharedBundle::State::dark) return;
                weight = weight * F(bundle.weight);
                if (bundle.state == SharedBundle::State::soft) {
                    for (int c = 0; c < 3; ++c) to.flat[c] = to.flat[c] + weight * soft_light(bundle, dx, dy, c);
                } else {
                    waiting.trace();
                    add_box(bundle, dx * F(reach), dy * F(reach), weight, to.boxes);
                }
            };
            if (at.per_axis == 0) add(b.through, share * cover);
            if (own_beside) {
                // Decided for each pixel, so that none depends on the others of its packet.
                const optics::Mask<F> shows = cover < F(0.9999f);
                if (optics::any(shows)) add_own(Own::beside, optics::select(shows, share * (F(1) - cover), F(0)));
            } else if (at.per_axis == 0) {
                add(b.beside, share * (F(1) - cover));
            }
        });
        waiting.trace();
    }

    /// f(Seen) for each stratum, with the spans of the lanes at (dx, dy) of the block, -1 .. 1. An axis has at most `most` strata.
    template <int most, class Do>
    LFDSIM_BOTH void for_strata(F dx, F dy, Do f) const {
        Span<F> across[most];
        for (int g = 0; g < at.grids.count; ++g) {
            const Grid& grid = at.grids.grid[g];
            Spans columns(scene, grid, 0, dx, dy), rows(scene, grid, 1, dx, dy);
            for (int i = 0; i < grid.axis[0].strata; ++i) across[i] = columns.next();
            const optics::Corners<F> cell = corners_at(grid, dx, dy);
            optics::Corners<F> part;
            const Bundles* next = at.bundles + grid.first;
            for (int j = 0; j < grid.axis[1].strata; ++j) {
                const Span<F> up = rows.next();
                for (int i = 0; i < grid.axis[0].strata; ++i) {
                    const bool split = grid.strip >= 0 && grid.axis[1 - grid.strip].strata > 1;
                    if (split) part = part_of_strip(cell, grid, grid.strip == 1 ? i : j);
                    f(Seen{next++, &grid, &across[i], &up, split ? &part : &cell, i, j,
                           std::uint32_t(grid.first + j * max_strata + i)});
                }
            }
        }
    }

    const Tile& tile;
    const optics::Scene<S>& scene;
    BlockState& at;
};

/// Interpolates the light between two places.
LFDSIM_FN S between_places(S a, S b, S share) { return a + (b - a) * share; }

}  // namespace

}  // namespace lfdsim
