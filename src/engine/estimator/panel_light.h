// The mean light of a panel over boxes, whether its pixels emit over their whole area or in subpixels. Floor 2.
//
// A rectangle that emits in each cell of pixels is a function of column times one of row. So its light in a box is that of a box in
// coordinates of cumulative light over the picture in which the rectangle fills the cell: docs/model.md, "Black matrix and
// subpixels".
#pragma once
#include "engine/estimator/box_means.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Limits of the gaps' exact share of two spreads: where the spreads' product, in cells squared, is less, a difference of
/// differences would lose its digits; where one is a smaller share of the other, it does not matter.
constexpr float least_product = 5e-4f, least_share = 1.0f / 16;

/// A side of a box of the panel, as that of a box of the plane in which a subpixel's part repeats.
template <class F>
struct PlaneSide {
    std::uint32_t base;  // number of the plane's cell that holds the panel's base
    F middle, width;     // in cells of the plane, the middle from the cell `base`
    F light;             // after to_cumulative_light(): the mapped side's width over the side's, by which the mean is multiplied

    PlaneSide() = default;

    /// Takes the side about `place`, panel pixels from the base pixel `number`, `size` pixels wide.
    LFDSIM_FN PlaneSide(const SubpixelPart<Scalar<F>>& part, int axis, std::uint32_t number, F place, F size) {
        const std::int32_t cell = part.cell[axis], at = std::int32_t(number), rest = cell == 1 ? 0 : InCell<F>::rest_of(at, cell);
        base = std::uint32_t(cell == 1 ? at : (at - rest) / cell);
        middle = (place + F(Scalar<F>(rest))) * F(part.per_cell[axis]);
        width = size * F(part.per_cell[axis]);
    }
    /// Maps the side to the cumulative light before its ends, s(x) of docs/model.md: the side of a box over the plane with the same
    /// light.
    LFDSIM_FN void to_cumulative_light(const SubpixelPart<Scalar<F>>& part, int axis) {
        using S = Scalar<F>;
        const F wide = max(width, F(S(1.0 / 4096))), half = F(S(0.5)) * wide, pixel = floor(middle), place = middle - pixel;
        const F first = light_before(part, axis, place - half), last = light_before(part, axis, place + half);
        middle = pixel + F(S(0.5)) * (first + last);
        width = last - first;
        light = width / wide;
    }
    /// Maps a side of the variance of two uniform spreads of `one` and `other` panel pixels. `light` is that of both spreads, where
    /// they are not too small: with B the integral of s(x), and l and s the longer and the shorter of them in cells, it is the
    /// second difference (B(x + (l+s)/2) - B(x + (l-s)/2) - B(x - (l-s)/2) + B(x - (l+s)/2))/(l s).
    LFDSIM_FN void to_cumulative_light(const SubpixelPart<Scalar<F>>& part, int axis, F one, F other) {
        using S = Scalar<F>;
        const F per_cell = F(part.per_cell[axis]), half = F(S(0.5)), place = middle - floor(middle),
                longer = max(one, other) * per_cell, shorter = min(one, other) * per_cell, product = longer * shorter,
                least = F(S(least_product));
        const auto before = [&](F at) { return sum_before(part, axis, place + half * at); };
        to_cumulative_light(part, axis);
        const F both = before(longer + shorter) - before(longer - shorter) - (before(shorter - longer) - before(-longer - shorter));
        const Mask<F> significant = (product > least) && (shorter > F(S(least_share)) * longer);
        light = select(significant, max(quotient(both, max(product, least)), F(0)), light);
    }

  private:
    /// Returns the cumulative light before a place, s(x), in cells.
    LFDSIM_FN static F light_before(const SubpixelPart<Scalar<F>>& part, int axis, F place) {
        const F whole = floor(place);
        return whole + min(max((place - whole - F(part.from[axis])) * F(part.per[axis]), F(0)), F(1));
    }
    /// Returns the integral of light_before() from 0: over whole cells, each k + 1 - (from + to)/2, and over a part of the last.
    LFDSIM_FN static F sum_before(const SubpixelPart<Scalar<F>>& part, int axis, F place) {
        using S = Scalar<F>;
        const F half = F(S(0.5)), whole = floor(place), in = place - whole, from = F(part.from[axis]), to = F(part.to[axis]),
                lit = min(max(in - from, F(0)), to - from), after = max(in - to, F(0));
        return whole * (half * (whole - F(1)) + (F(1) - half * (from + to))) + whole * in + half * lit * lit * F(part.per[axis]) +
               after;
    }
};

/// Returns whether two parts have the same extent along an axis, so that a side mapped for one serves the other.
template <class S>
LFDSIM_FN bool alike(const SubpixelPart<S>& a, const SubpixelPart<S>& b, int axis) {
    return a.cell[axis] == b.cell[axis] && a.from[axis] == b.from[axis] && a.to[axis] == b.to[axis];
}

/// Adds `weight` times the mean of a part of a panel with subpixels over boxes with these mapped sides.
template <class F>
LFDSIM_FN void add_part(const PanelLight& panel, PanelBase<Scalar<F>> base, const SubpixelPart<Scalar<F>>& part,
                        const PlaneSide<F> (&side)[2], F weight, Light<F>& light) {
    base.column = side[0].base;
    base.row = side[1].base;
    weight = weight * F(part.share) * side[0].light * side[1].light;
    if (none(weight > F(0))) return;
    Light<F> of_part;
    add_boxes(panel.plane[part.plane], base, Boxes<F>{side[0].middle, side[1].middle, side[0].width, side[1].width, weight},
              of_part);
    light.add(of_part, part.channel);
}

/// Adds the mean over boxes of a panel with subpixels: a sum over parts. to_cumulative_light(side, part, axis) maps the sides.
template <class F, class Squeeze>
LFDSIM_FN void add_subpixels(const PanelLight& panel, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, Light<F>& light,
                             Squeeze to_cumulative_light) {
    using S = Scalar<F>;
    const Emission<S>& emission = *panel.emission;
    const std::uint32_t number[2] = {base.column, base.row};
    const F place[2] = {box.column, box.row}, size[2] = {box.wide, box.high};
    const auto side_of = [&](const SubpixelPart<S>& part, int axis) {
        PlaneSide<F> side(part, axis, number[axis], place[axis], size[axis]);
        to_cumulative_light(side, part, axis);
        return side;
    };
    PlaneSide<F> side[2] = {side_of(emission.part[0], 0), side_of(emission.part[0], 1)};
    for (int k = 0; k < emission.count; ++k) {
        const SubpixelPart<S>& part = emission.part[k];
        for (int axis = 0; axis < 2 && k > 0; ++axis)
            if (!alike(part, emission.part[k - 1], axis)) side[axis] = side_of(part, axis);
        add_part(panel, base, part, side, box.weight, light);
    }
}
/// Adds the mean over boxes of a panel with subpixels, each box being one uniform spread.
template <class F>
LFDSIM_LARGE void add_subpixels(const PanelLight& panel, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, Light<F>& light) {
    add_subpixels(panel, base, box, light,
                  [](PlaneSide<F>& side, const SubpixelPart<Scalar<F>>& part, int axis) { side.to_cumulative_light(part, axis); });
}

/// Adds the light of boxes of any panel.
template <class F>
LFDSIM_FN void add_light(const PanelLight& panel, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, Light<F>& light) {
    if (panel.whole)
        add_boxes(panel.plane[0], base, box, light);
    else
        add_subpixels(panel, base, box, light);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
