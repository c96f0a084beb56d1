// The filtered estimator: the strata of a block of pixels along one axis of the sample domain.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/estimator/limits.h"
#include "engine/estimator/strata.h"
#include "optics/diffuser.h"
#include "optics/lattice.h"

namespace lfdsim {

namespace {

using S = float;

/// A value at the middle of a block, and how much it changes to the block's right and lower border.
struct Gradient {
    S middle, right, down;

    static Gradient of(S at_middle, S at_right, S at_bottom) { return {at_middle, at_right - at_middle, at_bottom - at_middle}; }
    /// Returns the value at (dx, dy) of the block, -1 .. 1 across it, right and down.
    template <class G>
    LFDSIM_FN G at(G dx, G dy) const {
        return G(middle) + G(right) * dx + G(down) * dy;
    }
    /// Returns the most by which a value in the block differs from that at its middle.
    S reach() const { return optics::abs(right) + optics::abs(down); }
};

/// A cut of the sample domain along one axis.
struct Cut {
    Gradient u;  // the domain's coordinate, exact at the block's middle, right and lower border
    S place;     // the position in the plane of the holes, mm from the base lens's axis, for rays from the block's middle
};

/// The part of the domain between two cuts.
struct Stratum {
    S axis;        // of its lens, mm from that of the base lens
    S from, to;    // ends within that lens's cell, mm from its axis, for rays from the middle of the block
    bool at_edge;  // an end of the domain, whose position moves from pixel to pixel, lies in it for some pixels
};

/// An axis of the sample domain as a block cuts it into strata. Inner cuts have fixed positions on the lenses, so their u changes
/// from pixel to pixel; the ends have the fixed u = -1 and 1, and their positions move.
struct Axis {
    int strata;
    Gradient first, last;  // the positions of the ends
    Cut cut[max_strata + 1];
    Stratum stratum[max_strata];
};

/// Evenly spaced cuts, common to all blocks: their u, and the tangents of the diffuser's angles there.
struct EvenCuts {
    int strata;
    S u[max_strata + 1], tangent[2][max_strata + 1];

    EvenCuts(const optics::TracedDisplay<S>& display, int count) : strata(count) {
        for (int k = 0; k <= strata; ++k) {
            u[k] = S(2 * k - strata) / S(strata);
            for (int a = 0; a < 2; ++a) tangent[a][k] = optics::diffuser_tangent(display, a, u[k]);
        }
    }
};

/// Cuts one axis, 0 or 1, for a block. `sweep`: those of the block's four points along that axis. False: the ends of the domain
/// move too far over the block, or a stratum looks through several lenses.
bool cut_axis(const optics::TracedDisplay<S>& display, const optics::Sweep<S>* sweep, int axis, const EvenCuts& even, Axis& a) {
    const Lattice<S>& lattice = display.lattice;
    const S pitch = lattice.pitch[axis], per_pitch = lattice.per_pitch[axis], half = lattice.half_pitch[axis],
            step = S(1) / S(even.strata);
    const auto place_of = [&](int even_cut) {
        const S tangent = even.tangent[axis][even_cut];
        return Gradient::of(sweep[0].place(tangent), sweep[1].place(tangent), sweep[2].place(tangent));
    };
    const auto cut_at = [&](S place) {
        S u[3];
        for (int k = 0; k < 3; ++k) u[k] = optics::diffuser_uniform(display, axis, sweep[k].tangent(place));
        return Cut{Gradient::of(u[0], u[1], u[2]), place};
    };
    // The ends of the domain in the plane of the holes; u may run against the axis (`along`).
    const Gradient start = place_of(0), end = place_of(even.strata);
    const S reach = start.reach(), along = end.middle > start.middle ? S(1) : S(-1);
    if (!(along * (end.middle - start.middle) > reach)) return false;

    // The first and the last border between lenses within the domain of some pixel of the block, in pitches
    const S low = optics::min(start.middle, end.middle) - reach, high = optics::max(start.middle, end.middle) + reach;
    const S first = optics::floor(low * per_pitch + S(0.5)) + S(0.5), last = optics::floor(high * per_pitch - S(0.5)) + S(0.5);
    const S borders = last - first + S(1);
    // Where there are one or two borders more than cuts, each gets a cut: a block near a lens's border may see the next one too.
    const bool at_borders = borders >= S(even.strata) && borders <= S(even.strata + 1) && even.strata + 2 < max_strata;
    const int strata = at_borders ? int(borders) + 1 : even.strata;  // at most more_strata more
    // Cut j: on a border between lenses if one is less than a step away, else evenly spaced
    const auto cut_of = [&](int j) {
        if (j == 0) return Cut{{-1, 0, 0}, start.middle};
        if (j == strata) return Cut{{1, 0, 0}, end.middle};
        if (at_borders) return cut_at((along > 0 ? first + S(j - 1) : last - S(j - 1)) * pitch);
        const S even_place = sweep[0].place(even.tangent[axis][j]);
        const Cut at_border = cut_at((optics::floor(even_place * per_pitch) + S(0.5)) * pitch);  // the nearest one
        // The outermost cuts also take borders that only some pixels of the block see.
        const Gradient& u = at_border.u;
        const S spread = u.reach();
        const bool snaps =
            u.middle >= (j == 1 ? -1 - spread : even.u[j] - step) && u.middle < (j == strata - 1 ? 1 + spread : even.u[j] + step);
        return snaps ? at_border : cut_at(even_place);
    };
    // The cuts and the strata between them, each within the cell of the lens at its middle
    a.strata = strata;
    a.first = start;
    a.last = end;
    for (int j = 0; j <= strata; ++j) a.cut[j] = cut_of(j);
    for (int j = 0; j < strata; ++j) {
        S from = a.cut[j].place * along, to = a.cut[j + 1].place * along;
        // The outermost strata reach as far as any pixel of the block sees.
        if (j == 0) from = optics::min(from, to) - reach;
        if (j == strata - 1) to = optics::max(from, to) + reach;
        const S axis_at = optics::cell_along(lattice, axis, S(0.5) * (from + to) * along) * pitch;
        const S low_end = optics::min(from * along, to * along) - axis_at,
                high_end = optics::max(from * along, to * along) - axis_at;
        constexpr S most = S(FilteredLimits::cell_margin);
        if (low_end < -most * half || high_end > most * half) return false;
        a.stratum[j] = {axis_at, optics::max(low_end, -half), optics::min(high_end, half), j == 0 || j == strata - 1};
    }
    return true;
}

/// The strata of an axis, x' (0) or y' (1), one after another, for each pixel of a packet; dx and dy: its position in the block,
/// -1 .. 1.
class Spans {
  public:
    Spans(const optics::TracedDisplay<S>& of, const Axis& direction, int number_of_axis, F right, F down)
        : display(of),
          axis(direction),
          along(number_of_axis),
          dx(right),
          dy(down),
          start(axis.first.at(dx, dy)),
          end(axis.last.at(dx, dy)),
          least(optics::min(start, end)),
          most(optics::max(start, end)),
          place(start) {}

    /// Returns the next stratum: its share of the axis is half its extent in u, as u runs from -1 to 1. For pixels that do not see
    /// it the share is 0.
    optics::Span<F> next() {
        optics::Span<F> span;
        F next_u = F(1), next_place = end;
        if (stratum + 1 < axis.strata) {
            const Cut& cut = axis.cut[stratum + 1];
            next_u = optics::min(optics::max(cut.u.at(dx, dy), u), F(1));
            next_place = optics::min(optics::max(F(cut.place), least), most);
        }
        span.share = F(0.5f) * (next_u - u);
        if (display.hole_radius > 0) span_hole(span, optics::min(place, next_place), optics::max(place, next_place));
        u = next_u;
        place = next_place;
        ++stratum;
        return span;
    }

  private:
    /// Sets the part of the hole that a stratum spans.
    LFDSIM_FN void span_hole(optics::Span<F>& span, F from, F to) const {
        const F per = F(1 / display.hole_radius), at = F(axis.stratum[stratum].axis), half = F(display.lattice.half_pitch[along]);
        span.from = optics::max(from - at, -half) * per;
        span.to = optics::min(to - at, half) * per;
        span.integral_from = optics::circle_integral(span.from);
        span.integral_to = optics::circle_integral(span.to);
    }

    const optics::TracedDisplay<S>& display;
    const Axis& axis;
    const int along;
    const F dx, dy, start, end, least, most;
    F u = F(-1), place;
    int stratum = 0;
};

}  // namespace

}  // namespace lfdsim
