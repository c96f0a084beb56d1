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

/// A cut of the diffuser's angles along one axis.
struct Cut {
    Gradient number, place;  // the diffuser's number; the position in the plane of the holes, mm from the base lens's axis
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
    Cut* cut;              // strata + 1 of them
    Stratum* stratum;
};

/// A grid of strata. Rows and columns of lenses share one, whose cuts lie on the borders between them. Of other lattices each lens
/// that the block sees has one of its own (filtered_lens.h); what its strata hold is the part of them inside the lens's cell.
struct Grid {
    Axis axis[2];
    int first;                                 // number of its first bundle; the others follow row after row
    int corners = 0;                           // of the lens's cell; 0: each stratum as a whole is the lens's
    Gradient corner[optics::most_corners][2];  // the diffuser's numbers of the rays to them
    bool narrow = false;                       // pixels see little of a stratum
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
    auto cut_at = [&](int j, S place) {
        S number[3];
        for (int k = 0; k < 3; ++k) number[k] = optics::diffuser_uniform(scene, axis, sweep[k].tangent(place));
        a.cut[j] = {Gradient::of(number[0], number[1], number[2]), {place, 0, 0}};
    };
    const Gradient start = place_of(0), end = place_of(even.strata);
    a.first = start;
    a.last = end;
    const S reach = start.reach(), along = end.middle > start.middle ? S(1) : S(-1);
    a.moving = moves || !(along * (end.middle - start.middle) > reach);

    // The first and the last border between lenses that some pixel of the block sees, in pitches
    const S low = optics::min(start.middle, end.middle) - reach, high = optics::max(start.middle, end.middle) + reach;
    const S first = optics::floor(low * per_pitch + S(0.5)) + S(0.5), last = optics::floor(high * per_pitch - S(0.5)) + S(0.5);
    const S borders = last - first + S(1);
    // Where there are one or two borders more than cuts, each gets a cut: a block near a lens's border may see the next one too.
    const bool at_borders = !a.moving && borders >= S(even.strata) && borders <= S(even.strata + 1) && even.strata + 2 < max_strata;
    a.strata = at_borders ? int(borders) + 1 : even.strata;  // at most more_strata more
    a.cut[0] = {{-1, 0, 0}, start};
    for (int j = 1; j < a.strata; ++j) {
        if (at_borders) {
            cut_at(j, (along > 0 ? first + S(j - 1) : last - S(j - 1)) * pitch);
            continue;
        }
        a.cut[j] = {{even.number[j], 0, 0}, place_of(j)};
        if (a.moving) continue;
        const S even_place = a.cut[j].place.middle;
        cut_at(j, (optics::floor(even_place * per_pitch) + S(0.5)) * pitch);  // the nearest border
        // The outermost cuts also take borders that only some pixels of the block see.
        const Gradient& number = a.cut[j].number;
        const S spread = number.reach();
        const bool snaps = number.middle >= (j == 1 ? -1 - spread : even.number[j] - step) &&
                           number.middle < (j == a.strata - 1 ? 1 + spread : even.number[j] + step);
        if (!snaps) cut_at(j, even_place);
    }
    a.cut[a.strata] = {{1, 0, 0}, end};
    for (int j = 0; j < a.strata; ++j) {
        S from = a.cut[j].place.middle * along, to = a.cut[j + 1].place.middle * along;
        // The outermost strata reach as far as any pixel of the block sees.
        if (j == 0 && !a.moving) from = optics::min(from, to) - reach;
        if (j == a.strata - 1 && !a.moving) to = optics::max(from, to) + reach;
        const S cell = optics::cell_along(lattice, axis, S(0.5) * (from + to) * along), axis_at = cell * pitch;
        const S low_end = optics::min(from * along, to * along) - axis_at,
                high_end = optics::max(from * along, to * along) - axis_at;
        const S beside = moves ? reach : S(0);  // how far the other pixels' strata lie from this one
        a.stratum[j] = {
            axis_at, optics::max(low_end, -half), optics::min(high_end, half),
            low_end - beside < S(-FilteredLimits::straddling) * half || high_end + beside > S(FilteredLimits::straddling) * half,
            !a.moving && (j == 0 || j == a.strata - 1)};
    }
}

/// The strata of an axis, x' (0) or y' (1), for each pixel of a packet; dx and dy: its position in the block, -1 .. 1. Of moving
/// strata parts of the circle are left out.
LFDSIM_BOTH void spans_of(const optics::Scene<S>& scene, const Axis& axis, int along, F dx, F dy, Span<F>* spans) {
    const Lattice<S>& lattice = scene.lattice;
    const int strata = axis.strata;
    const F start = axis.first.at(dx, dy), end = axis.last.at(dx, dy);
    const F least = optics::min(start, end), most = optics::max(start, end);
    F number = F(-1), place = start;
    for (int j = 0; j < strata; ++j) {
        const bool last = j + 1 == strata;
        const Cut& cut = axis.cut[j + 1];
        const F next_number = last ? F(1) : optics::min(optics::max(cut.number.at(dx, dy), number), F(1));
        const F next_place = last ? end : optics::min(optics::max(cut.place.at(dx, dy), least), most);
        Span<F>& span = spans[j];
        span.low = number;
        span.high = next_number;
        span.share = F(0.5f) * (next_number - number);
        if (scene.hole_radius > 0) {
            // A moving stratum may lie on another lens than for the middle of the block.
            const F at = axis.moving ? F(lattice.pitch[along]) * optics::cell_along(lattice, along, F(0.5f) * (place + next_place))
                                     : F(axis.stratum[j].axis);
            const F half = F(lattice.half_pitch[along]), per = F(1 / scene.hole_radius);
            span.from = optics::max(optics::min(place, next_place) - at, -half) * per;
            span.to = optics::min(optics::max(place, next_place) - at, half) * per;
            if (!axis.moving) {
                span.part_from = optics::circle_part(span.from);
                span.part_to = optics::circle_part(span.to);
            }
        }
        number = next_number;
        place = next_place;
    }
}

/// The same for an axis of a lens's own grid, of which each pixel sees a part.
LFDSIM_BOTH void spans_on_lens(const optics::Scene<S>& scene, const Grid& grid, int along, F dx, F dy, Span<F>* spans) {
    const Axis& axis = grid.axis[along];
    if (grid.strip == 1 - along) {  // its parts are polygons alone
        for (int j = 0; j < axis.strata; ++j) spans[j].low = F(-1), spans[j].high = F(1);
        return;
    }
    const F start = axis.first.at(dx, dy), end = axis.last.at(dx, dy);
    const F least = optics::min(start, end), most = optics::max(start, end);
    auto number_at = [&](int cut) { return optics::min(optics::max(axis.cut[cut].number.at(dx, dy), F(-1)), F(1)); };
    auto place_at = [&](int cut) { return optics::min(optics::max(F(axis.cut[cut].place.middle), least), most); };
    F number = number_at(0), place = place_at(0);
    for (int j = 0; j < axis.strata; ++j) {
        const F next_number = number_at(j + 1), next_place = place_at(j + 1);
        Span<F>& span = spans[j];
        span.low = number;
        span.high = next_number;
        span.share = F(0.5f) * (next_number - number);
        if (scene.hole_radius > 0) {
            const F at = F(axis.stratum[j].axis), per = F(1 / scene.hole_radius);
            span.from = (optics::min(place, next_place) - at) * per;
            span.to = (optics::max(place, next_place) - at) * per;
            span.part_from = optics::circle_part(span.from);
            span.part_to = optics::circle_part(span.to);
        }
        number = next_number;
        place = next_place;
    }
}

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
    const F low = F(first.number.middle), high = F(last.number.middle);
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
