// The mean light of the panel over boxes that differ from pixel to pixel. Floor 1.
#pragma once
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

/// Four texels make up a box's light, the n-th by its share; all lanes read one level.
template <class F>
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
    Fetch<F> cell_[4];
};

/// The same of `count` texels where each lane reads a level of its own. Eight are differences of sums, pair by pair.
template <class F, int count>
class TexelsOfLevels {
  public:
    LFDSIM_FN TexelsOfLevels(const PanelLevels& levels, Uint<F> level) {
        std::uint32_t number[lanes];
        store(level, number);
        for (int k = 0; k < lanes; ++k) texels_[k] = levels.level[number[k]].texels;
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
    static constexpr int lanes = LaneTraits<F>::width, step = count == 8 ? 2 : 1;
    LFDSIM_FN const float* texel(int lane, int n) const { return texels_[lane] + std::size_t(number_[n][lane]) * 4; }
    const float* texels_[lanes];
    std::uint32_t number_[count][lanes];
    Scalar<F> share_[count][lanes];
};

/// Of boxes that are long where there are sums: at the level at which a box is at most two cells wide, of which one is read, and
/// along its whole length. Between the sums before and after a cell the sum is linear.
template <class F>
LFDSIM_FN TexelsOfLevels<F, 8> long_boxes(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, const Boxes<F>& box) {
    using S = Scalar<F>;
    const bool tall = levels.tall;
    const Uint<F> level = level_of(F(S(0.5)) * (tall ? box.wide : box.high), levels.count), one = Uint<F>(1u);
    const F scale = bits_float<F>((Uint<F>(127u) - level) << 23), half = F(S(0.5));
    auto cells = [&](std::uint32_t of) { return F(0) - floor(F(0) - F(S(std::int32_t(of))) * scale); };
    const F columns = cells(levels.level[0].columns), rows = cells(levels.level[0].rows), last = tall ? rows : columns;
    const F c = (F(S(std::int32_t(base.column))) + box.column) * scale, r = (F(S(std::int32_t(base.row))) + box.row) * scale;
    const F across = min(max((tall ? box.wide : box.high) * scale, F(S(least_box))), F(1)),
            length = max((tall ? box.high : box.wide) * scale, F(S(most_box)));  // shorter ones would lose the sums' digits
    const F side = (tall ? c : r) - half * across, start = (tall ? r : c) - half * length;
    const F line = floor(side), beyond = max(F(1) - (line + F(1) - side) / across, F(0)), per = box.weight / length;
    const Uint<F> lines = to_int(tall ? columns : rows), pitch = to_int(tall ? columns : columns + F(1));
    TexelsOfLevels<F, 8> texels(levels, level + Uint<F>(std::uint32_t(levels.count)));
    for (int end = 0; end < 2; ++end) {
        const F to = min(max(end == 0 ? start : start + length, F(0)), last), cell = min(floor(to), last - F(1)), rest = to - cell;
        const Uint<F> k = to_int(cell);
        for (int n = 0; n < 4; ++n) {
            const Uint<F> number = to_int(line) + (n / 2 == 0 ? Uint<F>(0u) : one), sum = k + (n % 2 == 0 ? Uint<F>(0u) : one);
            const F part = (n / 2 == 0 ? F(1) - beyond : beyond) * (n % 2 == 0 ? F(1) - rest : rest);
            texels.set(2 * n + 1 - end, number < lines, tall ? sum * pitch + number : number * pitch + sum,
                       end == 0 ? F(0) - per * part : per * part);
        }
    }
    return texels;
}

/// Of other boxes: at a level of columns x rows cells, `scale` to a panel pixel, on which none is more than two cells wide, of
/// which one is read: the light that a coarser cell would add from outside a box is the larger error. Positions are measured from
/// the panel's corner in single precision: on a panel of 16384 columns accurate to 1/1000 of a pixel.
template <class F, class Texels>
LFDSIM_FN Texels short_boxes(Texels texels, Uint<F> columns, Uint<F> rows, F scale, const PanelBase<Scalar<F>>& base,
                             const Boxes<F>& box) {
    using S = Scalar<F>;
    const F half = F(S(0.5)), width = min(max(box.wide * scale, F(S(least_box))), F(1)),
            height = min(max(box.high * scale, F(S(least_box))), F(1));
    const F c = (F(S(std::int32_t(base.column))) + box.column) * scale - half * width,
            r = (F(S(std::int32_t(base.row))) + box.row) * scale - half * height;
    const F whole_c = floor(c), whole_r = floor(r);
    const F right = max(F(1) - (whole_c + F(1) - c) / width, F(0)), below = max(F(1) - (whole_r + F(1) - r) / height, F(0));
    const Uint<F> i = to_int(whole_c), j = to_int(whole_r), one = Uint<F>(1u);
    auto cell = [&](int n, Uint<F> across, Uint<F> down, F part) {
        texels.set(n, (across < columns) && (down < rows), down * columns + across, box.weight * part);
    };
    cell(0, i, j, (F(1) - below) * (F(1) - right));
    cell(1, i + one, j, (F(1) - below) * right);
    cell(2, i, j + one, below * (F(1) - right));
    cell(3, i + one, j + one, below * right);
    return texels;
}

/// add(texels) for those that make up the light of boxes of a plane, once or twice.
template <class F, class Add>
LFDSIM_FN void for_texels(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, Boxes<F> box, Add add) {
    using S = Scalar<F>;
    if (levels.sums && any((levels.tall ? box.high : box.wide) > F(S(most_box)))) {
        const F across = levels.tall ? box.wide : box.high, along = levels.tall ? box.high : box.wide;
        const Mask<F> lies_long = along > max(across, F(S(most_box)));
        add(long_boxes(levels, base, Boxes<F>{box.column, box.row, box.wide, box.high, select(lies_long, box.weight, F(0))}));
        box.weight = select(lies_long, F(0), box.weight);
    }
    const F size = F(S(0.5)) * max(box.wide, box.high);  // <= 2^level
    const PanelLevel& finest = levels.level[0];
    if (none(size > F(1)))  // most are so small
        return add(short_boxes(TexelsOfALevel<F>(finest), Uint<F>(finest.columns), Uint<F>(finest.rows), F(1), base, box));
    const Uint<F> level = level_of(size, levels.count);
    const F scale = bits_float<F>((Uint<F>(127u) - level) << 23);
    auto cells = [&](std::uint32_t of) { return to_int(F(0) - floor(F(0) - F(S(std::int32_t(of))) * scale)); };
    add(short_boxes(TexelsOfLevels<F, 4>(levels, level), cells(finest.columns), cells(finest.rows), scale, base, box));
}

/// The mean over boxes of the panel: of all that shines in them; R, G, B and an unused number of each lane.
template <class F>
LFDSIM_FN void light_of_boxes(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, const Boxes<F>& box,
                              Scalar<F> (*light)[4]) {
    using S = Scalar<F>;
    constexpr int lanes = LaneTraits<F>::width;
    const Emission<S>& emission = *levels.emission;
    if (emission.whole) {
        S more[lanes][4];
        S(*to)[4] = light;
        return for_texels(levels, base, box, [&](const auto& texels) {
            texels.light(to);
            for (int n = 0; n < lanes && to == more; ++n)
                for (int c = 0; c < 4; ++c) light[n][c] = light[n][c] + more[n][c];
            to = more;
        });
    }
    const std::uint32_t number[2] = {base.column, base.row};
    const F place[2] = {box.column, box.row}, size[2] = {box.wide, box.high};
    const auto side_of = [&](const SubpixelPart<S>& part, int axis) {
        PlaneSide<F> side(part, axis, number[axis], place[axis], size[axis]);
        side.squeeze(part, axis);
        return side;
    };
    PlaneSide<F> side[2] = {side_of(emission.part[0], 0), side_of(emission.part[0], 1)};
    F sum[3] = {F(0), F(0), F(0)};
    for (int k = 0; k < emission.count; ++k) {
        const SubpixelPart<S>& part = emission.part[k];
        for (int axis = 0; axis < 2 && k > 0; ++axis)
            if (!alike(part, emission.part[k - 1], axis)) side[axis] = side_of(part, axis);
        PanelBase<S> from = base;
        from.column = side[0].base;
        from.row = side[1].base;
        const F weight = box.weight * F(part.share) * side[0].light * side[1].light;
        for_texels(plane_of(levels, part.plane), from,
                   Boxes<F>{side[0].middle, side[1].middle, side[0].width, side[1].width, weight}, [&](const auto& texels) {
                       for (int c = 0; c < 3; ++c)
                           if (part.channel == 3 || part.channel == c) sum[c] = sum[c] + texels.light_of(c);
                   });
    }
    S colour[3][lanes];
    for (int c = 0; c < 3; ++c) store(sum[c], colour[c]);
    for (int n = 0; n < lanes; ++n)
        for (int c = 0; c < 4; ++c) light[n][c] = c < 3 ? colour[c][n] : S(0);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
