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

    /// A lens's cell less its neighbours' halves of what both cover, as optics::outline_of has cells.
    LFDSIM_BOTH optics::Outline<S> own_cell(optics::Cell<S> lens, optics::Place<S> off_place, S y) const {
        const Lattice<S>& lattice = scene.lattice;
        const int pairs = optics::border_pairs(lattice);
        optics::Borders<S> edge[optics::most_corners];
        for (int k = 0; k < 2 * pairs; ++k) {
            const S side = k < pairs ? S(1) : S(-1);
            const optics::Borders<S> border = optics::borders(lattice, k % pairs);
            edge[k] = {side * border.x, side * border.y, border.half - overlap(lens, off_place, y, k % pairs, side)};
        }
        optics::Outline<S> of;
        of.corners = 2 * pairs;
        for (int k = 0; k < of.corners; ++k) {  // where an edge meets the one before it
            const optics::Borders<S>&e = edge[k > 0 ? k - 1 : of.corners - 1], &f = edge[k];
            const S per = S(1) / (e.x * f.y - e.y * f.x);
            of.corner[k] = optics::to_display(lattice, (e.half * f.y - f.half * e.y) * per, (f.half * e.x - e.half * f.x) * per);
        }
        return of;
    }

  private:
    const Tile& tile;
    const optics::Scene<S>& scene;
    const optics::PixelBlock<S>& block;
};

}  // namespace

}  // namespace lfdsim
