// The mean light of the panel over a ray's footprint: the spread by the two coordinates of the sample domain, and by the others.
// Floor 2.
#pragma once
#include "engine/estimator/limits.h"
#include "engine/estimator/panel_light.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The second moments of a footprint on the panel: twelve times the variances W^2, H^2 of column and row and their covariance C.
/// Those of an upright box are its width squared, its height squared and 0.
template <class F>
struct PanelCovariance {
    F w2, h2, c;

    /// Adds a uniform spread along (columns, rows).
    LFDSIM_FN void add(F columns, F rows) {
        w2 = w2 + columns * columns;
        h2 = h2 + rows * rows;
        c = c + columns * rows;
    }
};

/// Light that two uniform spreads move along one axis, by t and h: its density over t + h is a trapezium (docs/model.md, "Black
/// matrix and subpixels").
template <class F>
struct TwoSpreads {
    F one, other;  // full widths, neither much less than the other

    /// Returns the share of all light between 0 and the position `place`, in it: odd. The density is 1/longer up to |one - other|/2
    /// from the middle; beyond, what is missing from 1/2 is rest^2/(2 one other), `rest` from the trapezium's end.
    LFDSIM_FN F share(F place) const {
        using S = Scalar<F>;
        const F half = F(S(0.5)), longer = max(one, other), at = abs(place), rest = max(half * (one + other) - at, F(0));
        const F some = select(at > half * abs(one - other), half - quotient(half * rest * rest, one * other), quotient(at, longer));
        return select(place < F(0), -some, some);
    }
    /// Returns the integral of t, the distance by which the first spread has moved light, over the light between 0 and the
    /// position: even. moved_by_other() is that of h.
    LFDSIM_FN F moved(F place) const { return moved(one, other, place); }
    LFDSIM_FN F moved_by_other(F place) const { return moved(other, one, place); }

  private:
    /// Returns G(place) - G(0), G the integral over light up to a position of the distance by which the spread `by` has moved it.
    LFDSIM_FN static F moved(F by, F more, F place) {
        using S = Scalar<F>;
        const F half = F(S(0.5)), even = half * abs(by - more), at = min(abs(place), half * (by + more)), in = min(at, even);
        // Where the trapezium is flat, the mean of t is the position itself, or 0 if `by` is the shorter spread.
        const F inner = select(by > more, quotient(half * in * in, by), F(0)), from = in - half * more, to = at - half * more;
        // At a position p farther out t is between q = p - more/2 and by/2, so its integral is (by^2/4 - q^2)/2 times the density
        // 1/(by more), and over q from `from` to `to` (to - from) (by^2/4 - (to^2 + to from + from^2)/3)/2 times that.
        const F third = F(S(1.0 / 3)), end2 = F(S(0.25)) * by * by;
        const F outer = (to - from) * (end2 - third * (to * to + to * from + from * from));
        return inner + quotient(half * outer, by * more);
    }
};

/// Oblique lines on the panel: light that two spreads move, each uniformly over `along` pixels along an axis and by `slope` pixels
/// across for each of them; both together spread it by `across` pixels across the line, too.
template <class F>
struct ObliqueLines {
    struct ObliqueLine {
        F along, slope;
    };
    F place[2];  // column, row of the middle, from a base
    ObliqueLine one, other;
    F across, weight;
};

/// Pieces of oblique lines along `axis`, 0 for columns and 1 for rows: one for each cell of a part of the panel, between the ends
/// of what emits there. Within a piece the panel emits uniformly along the line, and the line's slope only widens it. Of long lines
/// a piece is several cells.
template <int axis, class F>
class Pieces {
    using S = Scalar<F>;

  public:
    LFDSIM_FN explicit Pieces(const ObliqueLines<F>& of)
        : line(of),
          one2(of.one.along * of.one.along),
          other2(of.other.along * of.other.along),
          least(max(F(S(1.0 / 64)) * max(of.one.along, of.other.along), F(S(1e-6)))),
          spreads{max(of.one.along, least), max(of.other.along, least)} {}

    /// Computes the n-th piece; false: no lane has one.
    LFDSIM_FN bool make(const SubpixelPart<S>& part, const PanelBase<S>& base, int n) {
        const F zero = F(0), one = F(1), half = F(S(0.5));
        const std::uint32_t number = axis == 0 ? base.column : base.row;
        along = PlaneSide<F>(part, axis, number, line.place[axis], spreads.one + spreads.other);
        // The cells of this piece, and the ends of what emits in them
        const F pixels = F(S(part.cell[axis])), all = along.middle, start = all - half * along.width,
                end = all + half * along.width, first = floor(start),
                step = max(one, F(0) - floor((first - end) * F(S(1.0 / FilteredLimits::most_pieces)))),
                from = first + F(S(n)) * step;
        if (none((line.weight > zero) && (from < end))) return false;
        const F low = max(from, start), high = min(from + step, end), last_cell = F(0) - floor(F(0) - high) - one;
        const F lit = max(low, floor(low) + F(part.from[axis])), dark = max(min(high, last_cell + F(part.to[axis])), lit);
        const F a = (lit - all) * pixels, b = (dark - all) * pixels;  // panel pixels from the middle
        // Its share of the light, and its middle across: that of the line plus slope_1 mean(t) + slope_2 mean(h)
        share = max(spreads.share(b) - spreads.share(a), zero);
        const F by_one = line.one.slope, by_other = line.other.slope;
        middle = line.place[1 - axis] + quotient(by_one * (spreads.moved(b) - spreads.moved(a)) +
                                                     by_other * (spreads.moved_by_other(b) - spreads.moved_by_other(a)),
                                                 max(share, F(S(1e-6))));
        // Twelve times the variances of what lies in the piece: of t + h, along it, and of t and h, taken as those of uniform
        // spreads cut to the piece. Across, with the slopes s1 and s2 of the two spreads,
        //     var(s1 t + s2 h) = (s1 - s2) (s1 var t - s2 var h) + s1 s2 var(t + h).
        const F reach = half * sqrt(one2 + other2), length = max(min(b, reach) - max(a, -reach), zero), in2 = length * length,
                moved2 = min(one2, in2 + other2), moved_by_other2 = min(other2, in2 + one2);
        aside = sqrt(max((by_one - by_other) * (by_one * moved2 - by_other * moved_by_other2) + by_one * by_other * in2, zero));
        along.middle = half * (lit + dark);
        along.width = dark - lit;
        along.to_cumulative_light(part, axis);
        return true;
    }

    PlaneSide<F> along;      // mapped to cumulative light
    F share, middle, aside;  // share of the light; middle across, panel pixels; spread across by the slopes, besides line.across

  private:
    const ObliqueLines<F>& line;
    const F one2, other2, least;
    const TwoSpreads<F> spreads;
};

/// Adds the mean light over oblique lines of a panel with subpixels: the sum over pieces and parts, of which each is read as a box.
template <int axis, class F>
LFDSIM_LARGE void add_lines(const PanelLight& panel, const PanelBase<Scalar<F>>& base, const ObliqueLines<F>& line,
                            Light<F>& light) {
    using S = Scalar<F>;
    constexpr int other = 1 - axis;
    const Emission<S>& emission = *panel.emission;
    const std::uint32_t number = axis == 0 ? base.row : base.column;
    Pieces<axis, F> piece(line);
    bool found = true;
    for (int n = 0; n < FilteredLimits::most_pieces && found; ++n) {
        found = false;
        bool made = false;
        for (int k = 0; k < emission.count; ++k) {
            const SubpixelPart<S>& part = emission.part[k];
            if (k == 0 || !alike(part, emission.part[k - 1], axis)) made = piece.make(part, base, n);
            if (!made) continue;
            found = true;
            PlaneSide<F> side[2] = {piece.along, piece.along};
            side[other] =
                PlaneSide<F>(part, other, number, piece.middle, sqrt(line.across * line.across + piece.aside * piece.aside));
            side[other].to_cumulative_light(part, other, line.across, piece.aside);
            add_part(panel, base, part, side, line.weight * piece.share, light);
        }
    }
}

/// Adds `weight` times the mean light of a footprint about (column, row) with the second moments `domain` and `others`, of a panel
/// with a black matrix or subpixels. Gaps between pixels distinguish an oblique line from an upright box of the same variances, and
/// two spreads from one: light is read along the line, or gaps take their exact share of two upright spreads. docs/model.md, "Black
/// matrix and subpixels".
template <class F>
LFDSIM_FN void add_spread(const PanelLight& panel, const PanelBase<Scalar<F>>& base, F column, F row,
                          const PanelCovariance<F>& domain, const PanelCovariance<F>& others, F weight, Light<F>& light) {
    using S = Scalar<F>;
    const F zero = F(0), tiny = F(S(1e-6)), least = F(S(1.0 / 64)), least_oblique = F(S(FilteredLimits::oblique_line));
    const Boxes<F> all{column, row, sqrt(domain.w2 + others.w2), sqrt(domain.h2 + others.h2), weight};
    const F wider = least_oblique * max(all.wide, least), higher = least_oblique * max(all.high, least);
    const Mask<F> down = !(all.wide > all.high), oblique = least_oblique * (abs(domain.c) + abs(others.c)) > wider * higher;
    // Along `axis` each spread has the width sqrt(w2) and the slope c/w2; the rest, h2 - c^2/w2, is across (columns as axis).
    const auto add_oblique = [&]<int axis>(Mask<F> some) {
        if (none(some)) return;
        F across2 = zero;  // the spread across the line
        const auto line_of = [&](const PanelCovariance<F>& spread) {
            const F along = sqrt(axis == 0 ? spread.w2 : spread.h2), skew = quotient(spread.c, max(along, tiny));
            across2 = across2 + max((axis == 0 ? spread.h2 : spread.w2) - skew * skew, zero);
            return typename ObliqueLines<F>::ObliqueLine{along, quotient(skew, max(along, tiny))};
        };
        ObliqueLines<F> lines{{column, row}, line_of(domain), line_of(others), zero, select(some, weight, zero)};
        lines.across = sqrt(across2);
        add_lines<axis>(panel, base, lines, light);
    };
    add_oblique.template operator()<0>(oblique && !down);
    add_oblique.template operator()<1>(oblique && down);
    if (!any(!oblique)) return;
    const F one[2] = {sqrt(domain.w2), sqrt(domain.h2)}, other[2] = {sqrt(others.w2), sqrt(others.h2)};
    Boxes<F> box = all;
    box.weight = select(oblique, zero, weight);
    add_subpixels(panel, base, box, light, [&](PlaneSide<F>& side, const SubpixelPart<S>& part, int axis) {
        side.to_cumulative_light(part, axis, one[axis], other[axis]);
    });
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
