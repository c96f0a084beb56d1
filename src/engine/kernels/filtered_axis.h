// The filtered estimator: how a block of pixels cuts the diffuser's angles along one axis.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "optics/bundle.h"
#include "optics/diffuser.h"
#include "optics/filtered_limits.h"
#include "optics/outline.h"
#include "optics/strata.h"

namespace lfdsim {

namespace {

using optics::Span;
using S = float;

/// A value at the middle of a block, and how much it changes to the block's right and lower border.
struct Gradient {
    S middle, right, down;

    LFDSIM_BOTH static Gradient of(S at_middle, S at_right, S at_bottom) {
        return {at_middle, at_right - at_middle, at_bottom - at_middle};
    }
    LFDSIM_FN F at(F dx, F dy) const { return F(middle) + F(right) * dx + F(down) * dy; }  // -1 .. 1: across the block
    LFDSIM_BOTH S reach() const { return optics::abs(right) + optics::abs(down); }
};

/// The diffuser's number of a ray to a fixed place: its change over the block bends by `curve` times its square.
struct Number {
    Gradient linear;  // exact at the middle, the right and the lower border
    S curve;          // known on a lens's own grid

    LFDSIM_FN F at(F dx, F dy) const {
        const F right = F(linear.right) * dx, down = F(linear.down) * dy, change = right + down;
        return linear.at(dx, dy) + F(curve) * (change * change - F(linear.right) * right - F(linear.down) * down);
    }
};

/// A cut of the diffuser's angles along one axis.
struct Cut {
    Number number;
    Gradient place;  // the position in the plane of the holes, mm from the base lens's axis
};

/// What lies between two cuts.
struct Stratum {
    S axis;          // of its lens, mm from that of the base lens
    S from, to;      // ends within that lens's cell, mm from its axis, seen from the middle of the block
    bool straddles;  // it sees other lenses too
    bool cut_off;    // an end of the square, which moves with the pixels, lies in it for some of them
};

/// One axis of the square of angles as a block cuts it. Cuts have fixed positions on the lenses, so their numbers change from pixel
/// to pixel; the ends have the fixed numbers -1 and 1, and their positions move. But where the block is wide compared with what a
/// pixel sees of a lens, all cuts have fixed numbers, and the strata move with the pixels.
struct Axis {
    int strata;
    bool moving;
    Gradient first, last;  // the positions of the ends
    // Of a lens's own grid: the square and the cubic term of positions as a function of the number, mm.
    S square, cube;
    Cut* cut;  // strata + 1 of them
    Stratum* stratum;
};

/// A grid of strata. Rows and columns of lenses share one, whose cuts lie on the borders between them. Of other lattices each lens
/// that the block sees has one of its own (filtered_lens.h); what its strata hold is the part of them inside the lens's cell.
struct Grid {
    Axis axis[2];
    int first;                               // number of its first bundle; the others follow row after row
    int corners = 0;                         // of the lens's cell; 0: each stratum as a whole is the lens's
    Number corner[optics::most_corners][2];  // of the rays to them
    bool narrow = false;                     // pixels see little of a stratum
    S raised = 0;                            // mm: its lens's hole, and all positions, lie so far above the plane of the holes
    // A strip's strata are parallelograms: positions across it are from its axis, which leans by so much, mm per mm, along the axis
    // of this number. Along it strata have fixed numbers.
    int strip = -1;
    S lean = 0;
    bool against = false;  // positions across it run against the array's x'
    LFDSIM_BOTH int strata() const { return axis[0].strata * axis[1].strata; }
};

/// Evenly spaced cuts, common to all blocks: their numbers, and the tangents of the diffuser's angles there.
struct EvenCuts {
    int strata;
    S number[max_strata + 1], tangent[2][max_strata + 1];

    EvenCuts() = default;
    EvenCuts(const optics::Scene<S>& scene, int count) : strata(count) {
        for (int k = 0; k <= strata; ++k) set(scene, k);
    }
    LFDSIM_BOTH void set(const optics::Scene<S>& scene, int k) {
        number[k] = S(2 * k - strata) / S(strata);
        for (int a = 0; a < 2; ++a) tangent[a][k] = optics::diffuser_tangent(scene, a, number[k]);
    }
};

/// Cuts one axis for a block. Needs room for even.strata + more_strata strata in `a`. `moves`: strata shall move with the pixels.
LFDSIM_BOTH void cut_axis(const optics::Scene<S>& scene, const optics::Sweep<S>* sweep, bool moves, int axis, const EvenCuts& even,
                          Axis& a) {
    const Lattice<S>& lattice = scene.lattice;
    const S pitch = lattice.pitch[axis], per_pitch = lattice.per_pitch[axis], half = lattice.half_pitch[axis],
            step = S(1) / S(even.strata);
    auto place_of = [&](int even_cut) {
        const S tangent = even.tangent[axis][even_cut];
        return Gradient::of(sweep[0].place(tangent), sweep[1].place(tangent), sweep[2].place(tangent));
    };
    auto cut_at = [&](S place) {
        S number[3];
        for (int k = 0; k < 3; ++k) number[k] = optics::diffuser_uniform(scene, axis, sweep[k].tangent(place));
        return Cut{{Gradient::of(number[0], number[1], number[2]), 0}, {place, 0, 0}};
    };
    const Gradient start = place_of(0), end = place_of(even.strata);
    const S reach = start.reach(), along = end.middle > start.middle ? S(1) : S(-1);
    const bool moving = moves || !(along * (end.middle - start.middle) > reach);

    // The first and the last border between lenses that some pixel of the block sees, in pitches
    const S low = optics::min(start.middle, end.middle) - reach, high = optics::max(start.middle, end.middle) + reach;
    const S first = optics::floor(low * per_pitch + S(0.5)) + S(0.5), last = optics::floor(high * per_pitch - S(0.5)) + S(0.5);
    const S borders = last - first + S(1);
    // Where there are one or two borders more than cuts, each gets a cut: a block near a lens's border may see the next one too.
    const bool at_borders = !moving && borders >= S(even.strata) && borders <= S(even.strata + 1) && even.strata + 2 < max_strata;
    const int strata = at_borders ? int(borders) + 1 : even.strata;  // at most more_strata more
    auto cut_number = [&](int j) {
        if (j == 0) return Cut{{{-1, 0, 0}, 0}, start};
        if (j == strata) return Cut{{{1, 0, 0}, 0}, end};
        if (at_borders) return cut_at((along > 0 ? first + S(j - 1) : last - S(j - 1)) * pitch);
        const Cut even_cut{{{even.number[j], 0, 0}, 0}, place_of(j)};
        if (moving) return even_cut;
        const Cut at_border = cut_at((optics::floor(even_cut.place.middle * per_pitch) + S(0.5)) * pitch);  // the nearest one
        // The outermost cuts also take borders that only some pixels of the block see.
        const Gradient& number = at_border.number.linear;
        const S spread = number.reach();
        const bool snaps = number.middle >= (j == 1 ? -1 - spread : even.number[j] - step) &&
                           number.middle < (j == strata - 1 ? 1 + spread : even.number[j] + step);
        return snaps ? at_border : cut_at(even_cut.place.middle);
    };
    a.strata = strata;
    a.moving = moving;
    a.first = start;
    a.last = end;
    Cut cut = cut_number(0);
    a.cut[0] = cut;
    for (int j = 0; j < strata; ++j) {
        const Cut next = cut_number(j + 1);
        a.cut[j + 1] = next;
        S from = cut.place.middle * along, to = next.place.middle * along;
        // The outermost strata reach as far as any pixel of the block sees.
        if (j == 0 && !moving) from = optics::min(from, to) - reach;
        if (j == strata - 1 && !moving) to = optics::max(from, to) + reach;
        const S cell = optics::cell_along(lattice, axis, S(0.5) * (from + to) * along), axis_at = cell * pitch;
        const S low_end = optics::min(from * along, to * along) - axis_at,
                high_end = optics::max(from * along, to * along) - axis_at;
        const S beside = moves ? reach : S(0);  // how far the other pixels' strata lie from this one
        a.stratum[j] = {
            axis_at, optics::max(low_end, -half), optics::min(high_end, half),
            low_end - beside < S(-FilteredLimits::straddling) * half || high_end + beside > S(FilteredLimits::straddling) * half,
            !moving && (j == 0 || j == strata - 1)};
        cut = next;
    }
}

/// The strata of an axis, x' (0) or y' (1), one after another, for each pixel of a packet; dx and dy: its position in the block,
/// -1 .. 1. Of moving strata parts of the circle are left out. Of an axis of a lens's own grid each pixel sees a part.
class Spans {
  public:
    LFDSIM_BOTH Spans(const optics::Scene<S>& of, const Grid& grid, int direction, F right, F down)
        : scene(of),
          axis(grid.axis[direction]),
          along(direction),
          dx(right),
          dy(down),
          along_strip(of.by_lens && grid.strip == 1 - direction),
          start(axis.first.at(dx, dy)),
          end(axis.last.at(dx, dy)),
          least(optics::min(start, end)),
          most(optics::max(start, end)),
          number(of.by_lens ? number_on_lens(0) : F(-1)),
          place(of.by_lens ? place_on_lens(0) : start) {}

    LFDSIM_BOTH Span<F> next() {
        Span<F> span;
        span.low = F(-1);
        span.high = F(1);
        if (along_strip) return span;  // its parts are polygons alone
        const bool last = stratum + 1 == axis.strata;
        F next_number = F(1), next_place = end;
        if (scene.by_lens) {
            next_number = number_on_lens(stratum + 1);
            next_place = place_on_lens(stratum + 1);
        } else if (!last) {
            const Cut& cut = axis.cut[stratum + 1];
            next_number = optics::min(optics::max(cut.number.linear.at(dx, dy), number), F(1));
            next_place = optics::min(optics::max(cut.place.at(dx, dy), least), most);
        }
        span.low = number;
        span.high = next_number;
        span.share = F(0.5f) * (next_number - number);
        if (scene.hole_radius > 0) cover(span, optics::min(place, next_place), optics::max(place, next_place));
        number = next_number;
        place = next_place;
        ++stratum;
        return span;
    }

  private:
    LFDSIM_FN F number_on_lens(int cut) const { return optics::min(optics::max(axis.cut[cut].number.at(dx, dy), F(-1)), F(1)); }
    LFDSIM_FN F place_on_lens(int cut) const { return optics::min(optics::max(F(axis.cut[cut].place.middle), least), most); }

    /// What it spans of the hole.
    LFDSIM_FN void cover(Span<F>& span, F from, F to) const {
        const F per = F(1 / scene.hole_radius);
        if (scene.by_lens) {
            const F at = F(axis.stratum[stratum].axis);
            span.from = (from - at) * per;
            span.to = (to - at) * per;
        } else {
            // A moving stratum may lie on another lens than for the middle of the block.
            const Lattice<S>& lattice = scene.lattice;
            const F at = axis.moving ? F(lattice.pitch[along]) * optics::cell_along(lattice, along, F(0.5f) * (from + to))
                                     : F(axis.stratum[stratum].axis);
            const F half = F(lattice.half_pitch[along]);
            span.from = optics::max(from - at, -half) * per;
            span.to = optics::min(to - at, half) * per;
            if (axis.moving) return;
        }
        span.part_from = optics::circle_part(span.from);
        span.part_to = optics::circle_part(span.to);
    }

    const optics::Scene<S>& scene;
    const Axis& axis;
    const int along;
    const F dx, dy;
    const bool along_strip;
    const F start, end, least, most;
    F number, place;
    int stratum = 0;
};

/// Does a moving stratum span less than a lens?
LFDSIM_BOTH bool within_a_pitch(const optics::Scene<S>& scene, const Axis& axis, int along, int stratum) {
    return optics::abs(axis.cut[stratum + 1].place.middle - axis.cut[stratum].place.middle) < scene.lattice.pitch[along];
}

/// Such a stratum for each pixel of a packet, cut where the pixel sees the border of two lenses in it: the part in the cell of the
/// stratum's middle, and the part beyond, in the next cell. Over so little of a lens, position is taken as linear in the number.
/// Parts of the circle are left out.
LFDSIM_BOTH void cut_at_border(const optics::Scene<S>& scene, const Axis& axis, int along, int stratum, F dx, F dy,
                               Span<F> (&parts)[2]) {
    const Cut &first = axis.cut[stratum], &last = axis.cut[stratum + 1];
    const F low = F(first.number.linear.middle), high = F(last.number.linear.middle);
    const F start = first.place.at(dx, dy), end = last.place.at(dx, dy), way = end - start;
    const F pitch = F(scene.lattice.pitch[along]), half = F(scene.lattice.half_pitch[along]), none = F(0), one = F(1);
    const F lens = pitch * optics::cell_along(scene.lattice, along, F(0.5f) * (start + end));
    const optics::Mask<F> above = optics::max(start, end) - lens > half;
    const F border = optics::select(above, lens + half, lens - half);
    const F share = optics::min(optics::max((border - start) / optics::select(way == none, one, way), none), one);
    const F number = low + (high - low) * share, place = start + way * share;  // of the cut
    const F per = F(scene.hole_radius > 0 ? 1 / scene.hole_radius : 0);
    for (int k = 0; k < 2; ++k) {
        const optics::Mask<F> before = k == 0 ? share > F(0.5f) : share <= F(0.5f);  // does this part end at the cut?
        const F from = optics::select(before, start, place), to = optics::select(before, place, end);
        const F at = k == 0 ? lens : optics::select(above, lens + pitch, lens - pitch);
        Span<F>& span = parts[k];
        span.low = optics::select(before, low, number);
        span.high = optics::select(before, number, high);
        span.share = F(0.5f) * (span.high - span.low);
        span.from = (optics::min(from, to) - at) * per;
        span.to = (optics::max(from, to) - at) * per;
    }
}

}  // namespace

}  // namespace lfdsim
