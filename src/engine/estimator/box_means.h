// The mean light of an image of the panel over boxes that differ from pixel to pixel. Floor 2.
//
// A box at most one pixel wide and high lies over 2 x 2 pixels, whose texels are added. Any other box is read from the image's
// summed-area table (Crow 1984), which takes the same time whatever the size. Both are exact: each pixel counts with the part of it
// that lies in the box, and beside the image it is black.
#pragma once
#include "optics/light.h"
#include "simd/texel.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A box for each lane, wide x high pixels about the place (column, row), pixels from the base's whole pixel; `weight` times the
/// mean light in it counts.
template <class F>
struct Boxes {
    F column, row, wide, high, weight;
};

/// The least width and height of a box, pixels: a narrower one is read as if it had them.
constexpr float least_box = 1.0f / 4096;

/// The pixels that the side of a box at most one pixel long covers: `cell` and the next one, and how much of the side lies in each.
template <class F>
struct ShortSide {
    Uint<F> cell;
    F in_cell, in_next;

    /// `middle` is in pixels from the pixel `base`.
    LFDSIM_FN ShortSide(std::uint32_t base, F middle, F size) {
        const F one = F(1), start = middle - F(Scalar<F>(0.5)) * size, whole = floor(start);
        in_next = max(one - quotient(whole + one - start, size), F(0));  // (start + size - (whole + 1)) / size
        in_cell = one - in_next;
        cell = Uint<F>(base) + to_int(whole);
    }
};

/// Adds the light of boxes at most one pixel wide and high.
template <class F>
LFDSIM_FN void add_small_boxes(const SummedImage& image, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, Light<F>& light) {
    const ShortSide<F> across(base.column, box.column, box.wide), down(base.row, box.row, box.high);
    Light<F> sum = light;  // in registers
    for (int k = 0; k < 4; ++k) {
        const bool right = k % 2 == 1, below = k >= 2;
        const Uint<F> column = right ? across.cell + Uint<F>(1u) : across.cell, row = below ? down.cell + Uint<F>(1u) : down.cell;
        const F share = (below ? down.in_next : down.in_cell) * (right ? across.in_next : across.in_cell);
        const Mask<F> there = (column < Uint<F>(image.columns)) && (row < Uint<F>(image.rows));
        sum.add(image.texels, Fetch<F>(PanelHit<F>{row * Uint<F>(image.columns) + column, box.weight * share, there}));
    }
    light = sum;
}

/// The pixels that the side of any box covers, from `first` to `last`, and how much of those two lies in it, and of each between
/// them. If the side lies within one pixel, that is `first` alone.
template <class F>
struct LongSide {
    Uint<F> first, last;
    F in_first, in_middle, in_last;
    Mask<F> there;  // numbers are those of pixels of the image

    /// Takes the side from `start` to `end`, pixels from the pixel `base` of `count`, cut off at the image's ends.
    LFDSIM_FN LongSide(std::uint32_t base, std::uint32_t count, F start, F end) {
        using S = Scalar<F>;
        const F one = F(1), low = F(0) - F(S(std::int32_t(base))), high = F(S(std::int32_t(count - base)));
        const F from = min(max(start, low), high), to = min(max(end, low), high);
        const F first_cell = min(floor(from), high - one), last_cell = min(floor(to), high - one);
        const Mask<F> within = first_cell == last_cell;
        in_first = select(within, to - from, one - (from - first_cell));
        in_middle = select(within, F(0), one);
        in_last = select(within, F(0), to - last_cell);
        first = Uint<F>(base) + to_int(first_cell);
        last = Uint<F>(base) + to_int(last_cell);
        there = (first < Uint<F>(count)) && (last < Uint<F>(count));
    }
};

/// Adds `weight` times the integral of an image over boxes with these sides. The table holds, at each corner of pixels, the sum of
/// all light above and to the left of it, modulo 2^32. The difference of those at the four corners of a rectangle of whole pixels
/// is the sum over it, exactly, as long as that is below 2^31. So a box is nine such rectangles: its corners, sides and middle,
/// which count by the part of their pixels that lies in the box.
template <class F>
LFDSIM_LARGE void add_integrals(const SummedImage& image, const LongSide<F>& across, const LongSide<F>& down, F weight,
                                Light<F>& light) {
    using S = Scalar<F>;
    constexpr int lanes = LaneTraits<F>::width;
    std::uint32_t left[lanes], right[lanes], top[lanes], bottom[lanes];
    S of_column[3][lanes], of_row[3][lanes], per_unit[lanes], sum[lanes][4];
    store(across.first, left);
    store(across.last, right);
    store(down.first, top);
    store(down.last, bottom);
    const auto store_parts = [](const LongSide<F>& side, S(&of)[3][lanes]) {
        store(side.in_first, of[0]);
        store(side.in_middle, of[1]);
        store(side.in_last, of[2]);
    };
    store_parts(across, of_column);
    store_parts(down, of_row);
    store(select(across.there && down.there, weight * F(image.light_per_unit), F(0)), per_unit);
    const std::size_t pitch = std::size_t(image.columns) + 1;
    // In each lane: rows of corners above and below the first, the middle and the last row of rectangles, and in each row of
    // corners the differences of sums across the first, the middle and the last column.
    for (int k = 0; k < lanes; ++k) {
        Texel box{};
        if (per_unit[k] != S(0)) {
            const auto differences = [&](std::size_t row, LightSums(&along)[3]) {
                const std::uint32_t* const line = image.sums + row * pitch * 4;
                const LightSums a = load_sums(line + left[k] * 4), b = load_sums(line + left[k] * 4 + 4),
                                c = load_sums(line + right[k] * 4), d = load_sums(line + right[k] * 4 + 4);
                along[0] = b - a;
                along[1] = c - b;
                along[2] = d - c;
            };
            LightSums above[3], below[3];
            differences(top[k], above);
            const std::size_t next[3] = {std::size_t(top[k]) + 1, bottom[k], std::size_t(bottom[k]) + 1};
            for (int r = 0; r < 3; ++r) {
                differences(next[r], below);
                Texel line{};
                for (int c = 0; c < 3; ++c) line += texel_of(below[c] - above[c]) * of_column[c][k];
                box += line * of_row[r][k];
                for (int c = 0; c < 3; ++c) above[c] = below[c];
            }
        }
        store_texel(box * per_unit[k], sum[k]);
    }
    light.add(sum);
}

/// A side of a box, cut off at the image's ends and into equal pieces of at most `most_size` pixels. Of more than `most` pieces,
/// `most` evenly spaced ones represent all.
template <class F>
struct CutSide {
    static constexpr int most = 16;
    F start, step, size, count,
        share;  // of the first; from piece to piece; a piece's size; their number; each one's share of the side

    /// Takes the side about `middle`, pixels from the pixel `base` of `pixels`.
    LFDSIM_FN CutSide(std::uint32_t base, std::uint32_t pixels, F middle, F whole_size, F most_size) {
        using S = Scalar<F>;
        const F half = F(S(0.5)), low = F(0) - F(S(std::int32_t(base))), high = F(S(std::int32_t(pixels - base)));
        const F from = middle - half * whole_size, to = middle + half * whole_size;
        start = min(max(from, low), high);
        const F length = min(max(to, low), high) - start;
        count = max(min(F(0) - floor(F(0) - length / most_size), F(S(most))), F(1));
        step = length / count;
        size = min(step, most_size);
        share = step / max(to - from, F(least_box));  // as the ends are rounded, so that white is white
        start = start + half * (step - size);
    }
    LFDSIM_FN F from(F piece) const { return start + piece * step; }
};

/// Adds the light of boxes of any size, in pieces of at most SummedImage::most_pixels, for which sums are exact.
template <class F>
LFDSIM_FN void add_large_boxes(const SummedImage& image, const PanelBase<Scalar<F>>& base, const Boxes<F>& box, Light<F>& light) {
    using S = Scalar<F>;
    constexpr S most = SummedImage::most_pixels, side = 64;
    static_assert(side * side == most);
    const F one = F(1), zero = F(0), least = F(S(1e-30));
    // A piece is at most 64 x 64 pixels; where the box is narrower one way, it may be longer the other way.
    const CutSide<F> across(base.column, image.columns, box.column, box.wide, max(F(side), F(most) / max(box.high, one)));
    const CutSide<F> down(base.row, image.rows, box.row, box.high, F(most) / max(across.size, one));
    const F pieces = across.count * down.count, weight = box.weight * across.share * down.share;
    F column = zero, row = zero;  // number of the piece
    for (F number = zero; any(number < pieces); number = number + one) {
        const F left = across.from(column), right = left + across.size, top = down.from(row), bottom = top + down.size;
        const F per_area = one / max((right - left) * (bottom - top), least);
        add_integrals(image, LongSide<F>(base.column, image.columns, left, right), LongSide<F>(base.row, image.rows, top, bottom),
                      select(number < pieces, weight * per_area, zero), light);
        const Mask<F> line_ends = column + one >= across.count;
        column = select(line_ends, zero, column + one);
        row = select(line_ends, row + one, row);
    }
}

/// Adds the light of boxes of any size, in each lane by the faster way that serves it.
template <class F>
LFDSIM_FN void add_boxes(const SummedImage& image, const PanelBase<Scalar<F>>& base, Boxes<F> box, Light<F>& light) {
    const F one = F(1), zero = F(0), weight = box.weight;
    box.wide = max(box.wide, F(least_box));
    box.high = max(box.high, F(least_box));
    const Mask<F> counts = weight > zero, small = !(box.wide > one) && !(box.high > one);
    if (any(counts && small)) {
        box.weight = select(small, weight, zero);
        add_small_boxes(image, base, box, light);
    }
    if (any(counts && !small)) {
        box.weight = select(small, zero, weight);
        add_large_boxes(image, base, box, light);
    }
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
