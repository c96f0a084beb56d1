// The filtered estimator: what a block of pixels sees of a plane of holes, and with which of the square's numbers its rays go to a
// place there.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "optics/bundle.h"
#include "optics/filtered_limits.h"

namespace lfdsim {

namespace {

/// Positions are in the display's frame, mm from the axis of the block's base lens.
class SeenPlane {
  public:
    LFDSIM_BOTH SeenPlane(const Tile& t, const optics::PixelBlock<S>& of) : tile(t), scene(*t.scene), block(of) {}

    /// The plane so far above that of the holes, mm, in which a lens that is raised has its hole.
    LFDSIM_BOTH void look_at(S above) {
        raised = above;
        for (int a = 0; a < 2; ++a) {
            const S tangent = tile.square.of_pixel ? S(0) : optics::diffuser_tangent(scene, a, S(1));
            first[a] = place_of(a, -tangent);
            last[a] = place_of(a, tangent);
            span[a] = optics::abs(last[a].middle - first[a].middle);
            rising[a] = S(optics::sense(a));
            // Not from positions, which may be much larger than what the diffuser moves them by.
            const optics::Sweep<S>& sweep = block.sweep[a][0];
            const auto moved = [&](S by) { return (sweep.height - raised) * (sweep.turned(by) - sweep.slope); };
            const S half = tile.square.of_pixel ? S(0) : optics::diffuser_tangent(scene, a, S(0.5));
            square[a] = S(0.5) * (moved(tangent) + moved(-tangent));
            cube[a] = S(2.0 / 3) * (moved(tangent) - moved(-tangent) - S(2) * (moved(half) - moved(-half)));
            const S reach = first[a].reach() + (turns() ? optics::abs(aside(1 - a, a)) : S(0));
            low[a] = optics::min(first[a].middle, last[a].middle) - reach - beside[a];
            high[a] = optics::max(first[a].middle, last[a].middle) + reach + beside[a];
            // Where the diffuser turns rays by less than a pixel sees, numbers are those of a diffuser of a part of a pixel.
            const S least =
                S(scene.box_filter ? FilteredLimits::least_span : FilteredLimits::least_span_sharp) * reach / S(block.reach);
            linear[a] = !(span[a] > reach);
            per[a] = rising[a] / optics::max(S(0.5) * optics::max(span[a], least), S(1e-12));
        }
        if (!turns()) return;
        const S to[2][2] = {{S(1) / per[0], aside(0, 1)}, {aside(1, 0), S(1) / per[1]}};
        moved_by(to);
    }

    /// Where the square is that of the pixel's area, numbers are half pixels to the right and upwards from its centre: so far they
    /// move light along x and y, mm.
    LFDSIM_BOTH void of_pixel(S (&to)[2][2]) {
        const S half = S(0.5) / S(block.reach);
        for (int a = 0; a < 2; ++a) {
            to[0][a] = first[a].right * half;
            to[1][a] = -first[a].down * half;
        }
        moved_by(to);
    }
    /// Are both numbers linear in the place? Lines are lines in them then.
    LFDSIM_BOTH bool flat() const { return tile.square.of_pixel || tile.square.exact_turns; }

    /// Sees so much more to each side, besides what the square's numbers move light by.
    LFDSIM_BOTH void widen(const S (&by)[2]) {
        for (int a = 0; a < 2; ++a) {
            beside[a] = by[a];
            low[a] = low[a] - by[a];
            high[a] = high[a] + by[a];
        }
    }

    /// The middle of what is seen, in the array's frame.
    LFDSIM_BOTH optics::Place<S> middle() const {
        return optics::to_array(scene.lattice, S(0.5) * (low[0] + high[0]), S(0.5) * (low[1] + high[1]));
    }

    LFDSIM_BOTH Gradient place_of(int a, S tangent) const {
        const optics::Sweep<S>* const sweep = block.sweep[a];
        return Gradient::of(sweep[0].place(tangent, raised), sweep[1].place(tangent, raised), sweep[2].place(tangent, raised));
    }

    /// How the numbers change over a distance (x, y), near the middle of the square.
    LFDSIM_BOTH void numbers_for(S x, S y, S (&number)[2]) const {
        if (flat()) {
            for (int a = 0; a < 2; ++a) number[a] = numbers[a][0] * x + numbers[a][1] * y;
            return;
        }
        const S by[2] = {x, y};
        for (int a = 0; a < 2; ++a) number[a] = by[a] * per[a];
    }

    /// The diffuser's number of a ray of the block that passes a place, and the place where it goes with a number.
    LFDSIM_BOTH S number_at(int a, int ray, S place) const {
        const optics::Sweep<S>& sweep = block.sweep[a][ray];
        return linear[a] ? (place - sweep.place(S(0), raised)) * per[a]
                         : optics::diffuser_uniform(scene, a, sweep.tangent(place, raised));
    }
    LFDSIM_BOTH S place_at(int a, int ray, S number) const {
        const optics::Sweep<S>& sweep = block.sweep[a][ray];
        return linear[a] ? sweep.place(S(0), raised) + number / per[a]
                         : sweep.place(optics::diffuser_tangent(scene, a, number), raised);
    }
    LFDSIM_BOTH Number number_of(int a, S place) const {
        return bent(a, place, {number_at(a, 0, place), number_at(a, 1, place), number_at(a, 2, place)});
    }
    /// Those of the block's three rays: turns to slopes u = (place - at) / height, over the diffuser's half angle w. Such a
    /// number's second derivative is -2 u w times the square of the first.
    LFDSIM_BOTH Number bent(int a, S place, const S (&number)[3]) const {
        const optics::Sweep<S>& sweep = block.sweep[a][0];
        const S curve = linear[a] ? S(0) : -sweep.sense * scene.half_angle[a] * (place - sweep.at) / (sweep.height - raised);
        return {Gradient::of(number[0], number[1], number[2]), curve};
    }
    /// Both numbers of a place.
    LFDSIM_BOTH void numbers_of(const S (&place)[2], Number (&number)[2]) const {
        if (!flat()) {
            for (int a = 0; a < 2; ++a) number[a] = number_of(a, place[a]);
            return;
        }
        S of[3][2];
        for (int ray = 0; ray < 3; ++ray)
            numbers_for(place[0] - block.sweep[0][ray].place(S(0), raised), place[1] - block.sweep[1][ray].place(S(0), raised),
                        of[ray]);
        for (int a = 0; a < 2; ++a) number[a] = {Gradient::of(of[0][a], of[1][a], of[2][a]), 0};
    }

    S raised = 0;                // mm above the plane of the holes
    Gradient first[2], last[2];  // where the square begins and ends
    S low[2], high[2];           // what the block sees
    S span[2], rising[2];        // what the middle sees; +1: numbers rise with the position, else -1
    S square[2], cube[2];        // an axis's

  private:
    LFDSIM_BOTH bool turns() const { return tile.square.exact_turns && !tile.square.of_pixel; }
    /// By how much the diffuser's largest turn along an axis moves light along the other one, mm.
    LFDSIM_BOTH S aside(int axis, int along) const {
        return (scene.holes_below[along] - raised) * optics::turned_aside(block.sweep[0][0].slope, block.sweep[1][0].slope, axis,
                                                                          optics::diffuser_tangent(scene, axis, S(1)));
    }
    /// The numbers of places, where number k moves light by to[k][a] along axis a.
    LFDSIM_BOTH void moved_by(const S (&to)[2][2]) {
        const S area = to[0][0] * to[1][1] - to[0][1] * to[1][0], per_area = area == S(0) ? S(0) : S(1) / area;
        numbers[0][0] = to[1][1] * per_area;
        numbers[0][1] = -to[1][0] * per_area;
        numbers[1][0] = -to[0][1] * per_area;
        numbers[1][1] = to[0][0] * per_area;
    }

    const Tile& tile;
    const optics::Scene<S>& scene;
    const optics::PixelBlock<S>& block;
    S beside[2] = {0, 0};  // of what the block sees, what the camera and the diffuser add to the square's numbers
    bool linear[2];
    S per[2];
    S numbers[2][2];  // where they are linear: number a's change per mm along x and y
};

}  // namespace

}  // namespace lfdsim
