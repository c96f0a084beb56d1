// The filtered estimator: where lenses are that stand by themselves (optics/placed.h), and what of their cells is theirs.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "optics/bundle.h"
#include "optics/outline.h"

namespace lfdsim {

namespace {

/// Seen by a block of pixels.
class StandingLenses {
  public:
    LFDSIM_BOTH StandingLenses(const Tile& t, const optics::PixelBlock<S>& of) : tile(t), scene(*t.scene), block(of) {}

    /// How far from the lattice's place the hole of a lens that stands by itself is, in the array's frame, and `up`: above the
    /// plane of the holes. To pixels that look straight on it appears in that plane. y: of any point of a strip's axis.
    LFDSIM_BOTH optics::Place<S> off(optics::Cell<S> lens, S y, S& up) const {
        const S below = scene.placement.vertex_z - (S(tile.view->start_z) - scene.holes_below[0]);  // the vertex
        const optics::Vec3<S> hole = optics::middle_of_hole(scene, block.lens.extent, lens, y, below);
        up = hole.z + below + block.lens.panel.raised;
        optics::Place<S> place = optics::to_display(scene.lattice, hole.x, hole.y);
        if (tile.square.of_pixel) {
            place = {place.x + up * block.sweep[0][0].slope, place.y + up * block.sweep[1][0].slope};
            up = 0;
        }
        const optics::Place<S> at = optics::to_array(scene.lattice, place.x, place.y), axis = optics::axis_of(scene.lattice, lens);
        return {at.x - axis.x, at.y - (scene.lattice.strips ? y : axis.y)};
    }

    /// Half of the width that both a lens, which stands so far off, and its neighbour beyond a border cover: surfaces alike meet in
    /// the middle. Where light goes on between lenses they share that too, and it may be negative. `pair` and `side` of borders as
    /// optics::cell_beyond has them; a brick's neighbours above and below are two.
    LFDSIM_BOTH S overlap(optics::Cell<S> lens, optics::Place<S> off_place, S y, int pair, S side) const {
        const Lattice<S>& lattice = scene.lattice;
        const optics::Borders<S> border = optics::borders(lattice, pair);
        const int neighbours = lattice.staggered && !lattice.hexagonal && pair == 1 ? 2 : 1;
        S sum = 0;
        for (int n = 0; n < neighbours; ++n) {
            const S place = optics::axis_of(lattice, lens).x + S(n == 0 ? 0.5 : -0.5) * lattice.half_pitch[0];
            const optics::Cell<S> other = optics::cell_beyond(lattice, lens, S(pair), side, place);
            if (!scene.leaky && !block.lens.extent.holds(other)) continue;
            S up;
            const optics::Place<S> theirs = off(other, y, up);
            const S nearer = side * ((off_place.x - theirs.x) * border.x + (off_place.y - theirs.y) * border.y);
            sum = sum + S(0.5) * (scene.leaky ? nearer : optics::max(nearer, S(0)));
        }
        return sum / S(neighbours);
    }

    /// A lens's cell as far as light enters it, `beyond` its borders, less its neighbours' halves of what both cover where they
    /// `meet`.
    LFDSIM_BOTH optics::Outline<S> own_cell(optics::Cell<S> lens, optics::Place<S> off_place, S y, bool meet,
                                            const S (&beyond)[optics::most_corners]) const {
        const Lattice<S>& lattice = scene.lattice;
        const int pairs = optics::border_pairs(lattice);
        optics::Borders<S> edge[optics::most_corners];
        for (int k = 0; k < 2 * pairs; ++k) {
            const S side = k < pairs ? S(1) : S(-1);
            const optics::Borders<S> border = optics::borders(lattice, k % pairs);
            const S covered = meet ? overlap(lens, off_place, y, k % pairs, side) : S(0);
            edge[k] = {side * border.x, side * border.y, border.half - covered + beyond[k]};
        }
        return optics::outline_between(lattice, edge);
    }

    /// How far beyond each border light enters a lens, seen from the block's middle, mm; false: that is not known.
    LFDSIM_BOTH bool clear_beyond(S (&beyond)[optics::most_corners]) const {
        const Lattice<S>& lattice = scene.lattice;
        const optics::Place<S> slope = optics::to_array(lattice, block.sweep[0][0].slope, block.sweep[1][0].slope);
        const int pairs = lattice.strips ? 1 : optics::border_pairs(lattice);
        bool known = scene.clear_borders.most > S(0);
        for (int k = 0; k < 2 * pairs && known; ++k) {
            const optics::Borders<S> border = optics::borders(lattice, k % pairs);
            const S towards = border.x * slope.x + border.y * slope.y, along = border.x * slope.y - border.y * slope.x;
            beyond[k] = optics::clear_beyond(scene.clear_borders, lattice.hexagonal ? 0 : k % pairs, k < pairs ? towards : -towards,
                                             optics::abs(along));
            known = beyond[k] > S(-1) * lattice.half_pitch[0];  // no node at hand is unknown
        }
        return known;
    }

  private:
    const Tile& tile;
    const optics::Scene<S>& scene;
    const optics::PixelBlock<S>& block;
};

}  // namespace

}  // namespace lfdsim
