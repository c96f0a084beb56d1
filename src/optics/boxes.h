// The mean light of the panel over boxes that differ from pixel to pixel. Floor 1.
#pragma once
#include "optics/filtered_limits.h"
#include "optics/footprint.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A box for each lane, wide x high panel pixels about a place (column, row) from a base; `weight` times the mean light in it
/// counts.
template <class F>
struct Boxes {
    F column, row, wide, high, weight;
};

/// The least level whose cells are at least `size` panel pixels wide, or the last one.
template <class F>
LFDSIM_FN Uint<F> level_of(F size, int count) {
    const Uint<F> above = ((float_bits(size) + Uint<F>(0x7fffffu)) >> 23) - Uint<F>(127u), top = Uint<F>(std::uint32_t(count - 1));
    const Uint<F> fitting = select(size > F(1), above, Uint<F>(0u));
    return select(fitting < top, fitting, top);
}

/// So many texels make up a box's light, the n-th by its share; all lanes read one level.
template <class F, int count>
class TexelsOfALevel {
  public:
    LFDSIM_FN explicit TexelsOfALevel(const PanelLevel& level) : texels_(level.texels) {}
    LFDSIM_FN void set(int n, Mask<F> lit, Uint<F> number, F share) { cell_[n] = Fetch<F>(PanelHit<F>{number, share, lit}); }
    /// The light of each lane: R, G, B and an unused number.
    LFDSIM_FN void light(Scalar<F> (*to)[4]) const {
        Light<F> sum;
        for (const Fetch<F>& cell : cell_) sum.add(texels_, cell);
        sum.store(to[0]);
    }
    /// One colour of it.
    LFDSIM_FN F light_of(int colour) const {
        F sum = F(0);
        for (const Fetch<F>& cell : cell_) sum = sum + cell.light_of(texels_, colour);
        return sum;
    }

  private:
    const float* texels_;
    Fetch<F> cell_[count];
};

/// The same where each lane reads a level of its own; `sums`: each texel less the one before it.
template <class F, int count, bool sums>
class TexelsOfLevels {
  public:
    LFDSIM_FN TexelsOfLevels(const PanelLevels& levels, Uint<F> level) {
        std::uint32_t number[lanes];
        store(level, number);
        for (int k = 0; k < lanes; ++k) texels_[k] = texels_of(levels.level[number[k]]);
    }
    LFDSIM_FN void set(int n, Mask<F> lit, Uint<F> number, F share) {
        store(select(lit, number, Uint<F>(0u)), number_[n]);
        store(select(lit, share, F(0)), share_[n]);
    }
    LFDSIM_FN void light(Scalar<F> (*to)[4]) const {
        for (int k = 0; k < lanes; ++k) {
            Texel sum{};
            for (int n = 0; n < count; n += step) {
                Texel part = load_texel(texel(k, n)) * share_[n][k];
                if (step == 2) part += load_texel(texel(k, n + 1)) * share_[n + 1][k];
                sum += part;
            }
            store_texel(sum, to[k]);
        }
    }
    LFDSIM_FN F light_of(int colour) const {
        Scalar<F> all[lanes];
        for (int k = 0; k < lanes; ++k) {
            Scalar<F> sum = 0;
            for (int n = 0; n < count; n += step) {
                Scalar<F> part = texel(k, n)[colour] * share_[n][k];
                if (step == 2) part = part + texel(k, n + 1)[colour] * share_[n + 1][k];
                sum = sum + part;
            }
            all[k] = sum;
        }
        return load<F>(all);
    }

  private:
    static constexpr int lanes = LaneTraits<F>::width, step = sums ? 2 : 1;
    LFDSIM_FN const float* texel(int lane, int n) const { return texels_[lane] + std::size_t(number_[n][lane]) * 4; }
    const float* texels_[lanes];
    std::uint32_t number_[count][lanes];
    Scalar<F> share_[count][lanes];
};

/// The cells of a level over which a box spreads along an axis, two for up to one cell, three for up to two: their numbers times
/// `pitch`, and how much of the box lies in each. Positions are measured from the panel's corner in single precision: on a panel of
/// 16384 columns accurate to 1/1000 of a pixel.
template <class F, int count>
struct BoxSide {
    Uint<F> at[count];
    Mask<F> lit[count];
    F share[count];

    /// About `place`, panel pixels from the pixel `base`, `size` wide, on a level with `scale` cells to a panel pixel. Of a wider
    /// box the middle `most` cells.
    LFDSIM_FN BoxSide(std::uint32_t base, F place, F size, F most, F scale, Uint<F> cells, Uint<F> pitch) {
        using S = Scalar<F>;
        const F width = min(max(size * scale, F(S(least_box))), most),
                first = (F(S(std::int32_t(base))) + place) * scale - F(S(0.5)) * width, whole = floor(first),
                in_first = quotient(whole + F(1) - first, width);
        const F beyond = max(F(1) - in_first, F(0));
        share[0] = F(1) - beyond;
        share[1] = count == 2 ? beyond : min(beyond, inverse(width));
        if constexpr (count == 3) share[2] = beyond - share[1];
        const Uint<F> cell = to_int(whole);
        for (int k = 0; k < count; ++k) {
            const Uint<F> number = cell + Uint<F>(std::uint32_t(k));
            lit[k] = number < cells;
            at[k] = number * pitch;
        }
    }
};

/// The cells of a box with these sides.
template <class F, int count, class Texels>
LFDSIM_FN Texels cells_of(Texels texels, const BoxSide<F, count>& across, const BoxSide<F, count>& down, F weight) {
    for (int n = 0; n < count * count; ++n) {
        const int i = n % count, j = n / count;
        texels.set(n, across.lit[i] && down.lit[j], down.at[j] + across.at[i], weight * (down.share[j] * across.share[i]));
    }
    return texels;
}

/// The level at which boxes so wide are at most two cells wide, and how many cells a panel pixel has there.
template <class F>
struct BoxLevel {
    Uint<F> level;
    F scale;
    LFDSIM_FN BoxLevel(const PanelLevels& levels, F size)
        : level(level_of(F(Scalar<F>(0.5)) * size, levels.count)), scale(bits_float<F>((Uint<F>(127u) - level) << 23)) {}
    /// Of so many panel pixels.
    LFDSIM_FN F cells(std::uint32_t pixels) const { return F(0) - floor(F(0) - F(Scalar<F>(std::int32_t(pixels))) * scale); }
};

/// Of boxes that are long where there are sums: along their whole length. Between the sums before and after a cell the sum is
/// linear.
template <int count, class F>
LFDSIM_FN auto long_boxes(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, F most) {
    using S = Scalar<F>;
    const bool tall = levels.tall;
    const BoxLevel<F> on(levels, tall ? box.wide : box.high);
    const F columns = on.cells(levels.columns), rows = on.cells(levels.rows), last = tall ? rows : columns;
    const Uint<F> pitch = to_int(tall ? columns : columns + F(1)), one = Uint<F>(1u);
    const BoxSide<F, count> lines = tall
                                        ? BoxSide<F, count>(base.column, box.column, box.wide, most, on.scale, to_int(columns), one)
                                        : BoxSide<F, count>(base.row, box.row, box.high, most, on.scale, to_int(rows), pitch);
    const F middle = (F(S(std::int32_t(tall ? base.row : base.column))) + (tall ? box.row : box.column)) * on.scale,
            length = max((tall ? box.high : box.wide) * on.scale, F(S(most_box)));  // shorter ones would lose the sums' digits
    const F start = middle - F(S(0.5)) * length, per = box.weight / length;
    TexelsOfLevels<F, 4 * count, true> texels(levels, on.level + Uint<F>(std::uint32_t(levels.count)));
    for (int end = 0; end < 2; ++end) {
        const F to = min(max(end == 0 ? start : start + length, F(0)), last), cell = min(floor(to), last - F(1)), rest = to - cell;
        for (int n = 0; n < 2 * count; ++n) {
            const Uint<F> sum = to_int(cell) + (n % 2 == 0 ? Uint<F>(0u) : one);
            const F part = lines.share[n / 2] * (n % 2 == 0 ? F(1) - rest : rest);
            texels.set(2 * n + 1 - end, lines.lit[n / 2], lines.at[n / 2] + (tall ? sum * pitch : sum),
                       end == 0 ? F(0) - per * part : per * part);
        }
    }
    return texels;
}

/// Their light, as if it were texels: out of line on a GPU, where most displays do without them.
template <class F>
struct FoundLight {
    Scalar<F> of[LaneTraits<F>::width][4];
    LFDSIM_FN void light(Scalar<F> (*to)[4]) const {
        for (int n = 0; n < LaneTraits<F>::width; ++n)
            for (int c = 0; c < 4; ++c) to[n][c] = of[n][c];
    }
    LFDSIM_FN F light_of(int colour) const {
        Scalar<F> all[LaneTraits<F>::width];
        for (int n = 0; n < LaneTraits<F>::width; ++n) all[n] = of[n][colour];
        return load<F>(all);
    }
};
template <int count, class F>
LFDSIM_LARGE FoundLight<F> light_of_long_boxes(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, Boxes<F> box, F most) {
    FoundLight<F> found;
    long_boxes<count>(levels, base, box, most).light(found.of);
    return found;
}

/// add(texels) for those of a level of its own for each lane: long boxes from sums, others from cells.
template <int count, class F, class Add>
LFDSIM_FN void for_levels(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, Boxes<F> box, F most, bool any_long,
                          Add add) {
    using S = Scalar<F>;
    if (any_long) {
        const F across = levels.tall ? box.wide : box.high, along = levels.tall ? box.high : box.wide;
        const Mask<F> lies_long = along > max(across, F(S(most_box)));
        const Boxes<F> long_ones{box.column, box.row, box.wide, box.high, select(lies_long, box.weight, F(0))};
        if constexpr (threads_apart)
            add(light_of_long_boxes<count>(levels, base, long_ones, most));
        else
            add(long_boxes<count>(levels, base, long_ones, most));
        box.weight = select(lies_long, F(0), box.weight);
    }
    const BoxLevel<F> on(levels, max(box.wide, box.high));
    const Uint<F> columns = to_int(on.cells(levels.columns)), rows = to_int(on.cells(levels.rows));
    add(cells_of(TexelsOfLevels<F, count * count, false>(levels, on.level),
                 BoxSide<F, count>(base.column, box.column, box.wide, most, on.scale, columns, Uint<F>(1u)),
                 BoxSide<F, count>(base.row, box.row, box.high, most, on.scale, rows, columns), box.weight));
}

/// The same of the finest level.
template <int count, class F>
LFDSIM_FN auto finest_cells(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, F most) {
    const Uint<F> columns = Uint<F>(levels.columns);
    return cells_of(TexelsOfALevel<F, count * count>(levels.level[0]),
                    BoxSide<F, count>(base.column, box.column, box.wide, most, F(1), columns, Uint<F>(1u)),
                    BoxSide<F, count>(base.row, box.row, box.high, most, F(1), Uint<F>(levels.rows), columns), box.weight);
}

/// add(texels) for those that make up the light of a plane's boxes, call by call. A box is read at the level at which it is at most
/// two cells wide: there its middle cell's width, since a coarser cell would add light from outside, and of boxes side by side,
/// each as wide as it is far to the next, the middles do. `fully`: all of it, by quarters where it is more than two panel pixels
/// wide.
template <class F, class Add>
LFDSIM_FN void for_texels(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, Mask<F> fully,
                          Add add) {
    using S = Scalar<F>;
    const F size = max(box.wide, box.high), one = F(1), zero = F(0);
    const bool any_long = levels.sums && any((levels.tall ? box.high : box.wide) > F(S(most_box)));
    if (none(fully && (size > one))) {
        if (!threads_apart && !any_long && none(size > F(2))) return add(finest_cells<2>(levels, base, box, one));
        return for_levels<2>(levels, base, box, one, any_long, add);
    }
    const F most = select(fully, F(2), one);
    if (!threads_apart && !any_long && none(size > F(2))) return add(finest_cells<3>(levels, base, box, most));
    const Mask<F> wide = fully && (size > F(2));
    const F half = select(wide, F(S(0.5)), one), quarter = select(wide, F(S(0.25)), zero);
    for (int k = 0; k < 4 && (k == 0 || any(wide)); ++k) {
        const F right = k % 2 == 0 ? -quarter : quarter, down = k < 2 ? -quarter : quarter,
                weight = select(wide, F(S(0.25)) * box.weight, k == 0 ? box.weight : zero);
        for_levels<3>(levels, base,
                      Boxes<F>{box.column + right * box.wide, box.row + down * box.high, half * box.wide, half * box.high, weight},
                      most, any_long, add);
    }
}

/// Red, green and blue of all lanes.
template <class F>
struct Colours {
    F of[3] = {F(0), F(0), F(0)};

    LFDSIM_FN void add(const Colours& more) {
        for (int c = 0; c < 3; ++c) of[c] = of[c] + more.of[c];
    }
    /// R, G, B and an unused number of each lane.
    LFDSIM_FN void by_lane(Scalar<F> (*light)[4]) const {
        using S = Scalar<F>;
        constexpr int lanes = LaneTraits<F>::width;
        S colour[3][lanes];
        for (int c = 0; c < 3; ++c) store(of[c], colour[c]);
        for (int n = 0; n < lanes; ++n)
            for (int c = 0; c < 4; ++c) light[n][c] = c < 3 ? colour[c][n] : S(0);
    }
};

/// Adds `weight` times the mean of a part of a panel with subpixels over boxes with these sides, which have been squeezed.
template <class F>
LFDSIM_FN void add_part(const PanelLevels& levels, PanelBase<Scalar<F>> base, const SubpixelPart<Scalar<F>>& part,
                        const PlaneSide<F> (&side)[2], F weight, Mask<F> fully, Colours<F>& sum) {
    base.column = side[0].base;
    base.row = side[1].base;
    weight = weight * F(part.share) * side[0].light * side[1].light;
    if (none(weight > F(0))) return;
    for_texels(plane_of(levels, part.plane), base, Boxes<F>{side[0].middle, side[1].middle, side[0].width, side[1].width, weight},
               fully, [&](const auto& texels) {
                   for (int c = 0; c < 3; ++c)
                       if (part.channel == 3 || part.channel == c) sum.of[c] = sum.of[c] + texels.light_of(c);
               });
}

/// Adds the mean over boxes of a panel with subpixels, of all that shines in them, by squeeze(side, part, axis).
template <class F, class Squeeze>
LFDSIM_FN void add_subpixels(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, Mask<F> fully,
                             Colours<F>& sum, Squeeze squeeze) {
    using S = Scalar<F>;
    const Emission<S>& emission = *levels.emission;
    const std::uint32_t number[2] = {base.column, base.row};
    const F place[2] = {box.column, box.row}, size[2] = {box.wide, box.high};
    const auto side_of = [&](const SubpixelPart<S>& part, int axis) {
        PlaneSide<F> side(part, axis, number[axis], place[axis], size[axis]);
        squeeze(side, part, axis);
        return side;
    };
    PlaneSide<F> side[2] = {side_of(emission.part[0], 0), side_of(emission.part[0], 1)};
    for (int k = 0; k < emission.count; ++k) {
        const SubpixelPart<S>& part = emission.part[k];
        for (int axis = 0; axis < 2 && k > 0; ++axis)
            if (!alike(part, emission.part[k - 1], axis)) side[axis] = side_of(part, axis);
        add_part(levels, base, part, side, box.weight, fully, sum);
    }
}

template <class F>
LFDSIM_LARGE Colours<F> subpixels_in(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, Boxes<F> box, Mask<F> fully) {
    Colours<F> sum;
    add_subpixels(levels, base, box, fully, sum,
                  [](PlaneSide<F>& side, const SubpixelPart<Scalar<F>>& part, int axis) { side.squeeze(part, axis); });
    return sum;
}

/// The light in boxes of the panel; R, G, B and an unused number of each lane.
template <class F>
LFDSIM_FN void light_of_boxes(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, const Boxes<F>& box,
                              Scalar<F> (*light)[4], Mask<F> fully = F(0) > F(0)) {
    using S = Scalar<F>;
    constexpr int lanes = LaneTraits<F>::width;
    if (!levels.whole) return subpixels_in(levels, base, box, fully).by_lane(light);
    bool first = true;
    for_texels(levels, base, box, fully, [&](const auto& texels) {
        if (first) {
            texels.light(light);
        } else {
            S more[lanes][4];
            texels.light(more);
            for (int n = 0; n < lanes; ++n)
                for (int c = 0; c < 4; ++c) light[n][c] = light[n][c] + more[n][c];
        }
        first = false;
    });
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
