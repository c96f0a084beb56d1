// The mean light of the panel over a footprint, from a pyramid of panel images, each half as fine as the last. Floor 1.
//
// A level's cell is the mean of 2 x 2 cells of the level below; level 0 is the panel. A footprint is read at the level at which it
// is at most one cell wide and high: it then overlaps 2 x 2 cells, weighted with how much of it lies in each. At level 0 this is
// exact.
#pragma once
#include "optics/light.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

// R, G, B and an unused number
#ifdef __CUDACC__
struct alignas(16) Texel {
    float v[4];
    LFDSIM_FN friend Texel operator*(Texel a, float b) { return {{a.v[0] * b, a.v[1] * b, a.v[2] * b, a.v[3] * b}}; }
    LFDSIM_FN void operator+=(Texel b) {
        for (int c = 0; c < 4; ++c) v[c] += b.v[c];
    }
};
// As one load of 16 bytes; a copy by memcpy would be 16 of one byte.
LFDSIM_FN Texel load_texel(const float* from) {
    const float4 v = *reinterpret_cast<const float4*>(from);
    return {{v.x, v.y, v.z, v.w}};
}
LFDSIM_FN void store_texel(Texel texel, float (&to)[4]) {
    for (int c = 0; c < 4; ++c) to[c] = texel.v[c];
}
LFDSIM_FN Texel texel_of(const float (&from)[4]) { return {{from[0], from[1], from[2], from[3]}}; }
#else
typedef float Texel __attribute__((vector_size(16)));
LFDSIM_FN Texel load_texel(const float* from) {
    Texel texel;
    __builtin_memcpy(&texel, from, sizeof texel);
    return texel;
}
LFDSIM_FN void store_texel(Texel texel, float (&to)[4]) { __builtin_memcpy(to, &texel, sizeof texel); }
LFDSIM_FN Texel texel_of(const float (&from)[4]) { return load_texel(from); }
#endif

/// A level's texels. A GPU's compiler is told that nothing changes the level, so that a loop need not look again.
LFDSIM_FN const float* texels_of(const PanelLevel& level) {
#ifdef __CUDA_ARCH__
    return reinterpret_cast<const float*>(__ldg(reinterpret_cast<const unsigned long long*>(&level.texels)));
#else
    return level.texels;
#endif
}

/// A level of the pyramid as the rays from one base lens read it.
template <class S>
struct LevelReader {
    const float* texels;
    std::uint32_t columns, rows;          // cells
    std::uint32_t base_column, base_row;  // the cell of the base
    S rest_column, rest_row;              // panel pixels from that cell's first to the base
    S cells_per_pixel;

    LevelReader() = default;
    LFDSIM_FN LevelReader(const PanelLevels& levels, int level, const PanelBase<S>& base) {
        const PanelLevel& of = levels.level[level];
        texels = of.texels;
        columns = of.columns;
        rows = of.rows;
        base_column = std::uint32_t(std::int32_t(base.column) >> level);  // the base may lie outside of the panel
        base_row = std::uint32_t(std::int32_t(base.row) >> level);
        rest_column = S(std::int32_t(base.column - (base_column << level)));
        rest_row = S(std::int32_t(base.row - (base_row << level)));
        cells_per_pixel = S(1) / S(1u << level);
    }

    /// Adds weight x the light at (column, row), panel pixels from the base.
    template <class F>
    LFDSIM_FN void add_point(Light<F>& light, F column, F row, F weight) const {
        add_cell(light, to_int(floor(cells(rest_column, column))), to_int(floor(cells(rest_row, row))), weight);
    }

    /// Adds weight x the mean over a box centred there, width x height cells, at most one each; per_width = 1 / width.
    template <class F>
    LFDSIM_FN void add_box(Light<F>& light, F column, F row, F weight, F width, F height, F per_width, F per_height) const {
        const F half = F(S(0.5)), c = cells(rest_column, column) - half * width, r = cells(rest_row, row) - half * height;
        const F whole_c = floor(c), whole_r = floor(r);
        const F right = max(F(1) - (whole_c + F(1) - c) * per_width, F(0)),
                below = max(F(1) - (whole_r + F(1) - r) * per_height, F(0));
        const Uint<F> i = to_int(whole_c), j = to_int(whole_r);
        const F upper = weight * (F(1) - below), lower = weight * below, left = F(1) - right;
        Light<F> sum = light;  // in registers
        add_cell(sum, i, j, upper * left);
        add_cell(sum, i + Uint<F>(1u), j, upper * right);
        add_cell(sum, i, j + Uint<F>(1u), lower * left);
        add_cell(sum, i + Uint<F>(1u), j + Uint<F>(1u), lower * right);
        light = sum;
    }

  private:
    template <class F>
    LFDSIM_FN F cells(S rest, F pixels) const {
        return (F(rest) + pixels) * F(cells_per_pixel);
    }
    template <class F>
    LFDSIM_FN void add_cell(Light<F>& light, Uint<F> i, Uint<F> j, F weight) const {
        const Uint<F> column = Uint<F>(base_column) + i, row = Uint<F>(base_row) + j;
        const Mask<F> lit = (column < Uint<F>(columns)) && (row < Uint<F>(rows));
        light.add(texels, Fetch<F>(PanelHit<F>{row * Uint<F>(columns) + column, weight, lit}));
    }
};

/// A box wider or narrower than this, in cells, is read as if it were as wide.
constexpr float least_box = 1.0f / 64, most_box = 1;
/// Of two spreads together: where their product, in cells squared, is less, a difference of differences would lose its digits;
/// where one is a smaller share of the other it does not matter.
constexpr float least_product = 5e-4f, least_share = 1.0f / 16;

/// A side of a box of the panel, as that of a box of the plane in which a subpixel's part repeats.
template <class F>
struct PlaneSide {
    std::uint32_t base;  // the plane's cell that holds the panel's base
    F middle, width;     // in cells of the plane, the middle from the base
    F light;             // after squeeze(): that in the squeezed side over that in the side

    PlaneSide() = default;

    /// Of a side about `place`, panel pixels from the base pixel `number`, `size` pixels wide.
    LFDSIM_FN PlaneSide(const SubpixelPart<Scalar<F>>& part, int axis, std::uint32_t number, F place, F size) {
        const std::int32_t cell = part.cell[axis], at = std::int32_t(number), rest = cell == 1 ? 0 : InCell<F>::rest_of(at, cell);
        base = std::uint32_t(cell == 1 ? at : (at - rest) / cell);
        middle = (place + F(Scalar<F>(rest))) * F(part.per_cell[axis]);
        width = size * F(part.per_cell[axis]);
    }
    /// Turns the side into that of a box over the plane with the same light. A point's place is then the light before it: it stands
    /// still in the dark between two parts and moves faster where they shine.
    LFDSIM_FN void squeeze(const SubpixelPart<Scalar<F>>& part, int axis) {
        using S = Scalar<F>;
        const F wide = max(width, F(S(1.0 / 4096))), half = F(S(0.5)) * wide, pixel = floor(middle), place = middle - pixel;
        const F first = light_before(part, axis, place - half), last = light_before(part, axis, place + half);
        middle = pixel + F(S(0.5)) * (first + last);
        width = last - first;
        light = width / wide;
    }
    /// The same of light that two spreads move, each evenly, so many panel pixels: `light` is that of both, where they are not too
    /// small. The side is that of a box of the same variance.
    LFDSIM_FN void squeeze(const SubpixelPart<Scalar<F>>& part, int axis, F one, F other) {
        using S = Scalar<F>;
        const F per_cell = F(part.per_cell[axis]), half = F(S(0.5)), place = middle - floor(middle),
                longer = max(one, other) * per_cell, shorter = min(one, other) * per_cell, product = longer * shorter,
                least = F(S(least_product));
        const auto before = [&](F at) { return sum_before(part, axis, place + half * at); };
        squeeze(part, axis);
        const F both = before(longer + shorter) - before(longer - shorter) - (before(shorter - longer) - before(-longer - shorter));
        const Mask<F> told = (product > least) && (shorter > F(S(least_share)) * longer);
        light = select(told, max(quotient(both, max(product, least)), F(0)), light);
    }

  private:
    LFDSIM_FN static F light_before(const SubpixelPart<Scalar<F>>& part, int axis, F place) {
        const F whole = floor(place);
        return whole + min(max((place - whole - F(part.from[axis])) * F(part.per[axis]), F(0)), F(1));
    }
    /// The integral of light_before() from 0.
    LFDSIM_FN static F sum_before(const SubpixelPart<Scalar<F>>& part, int axis, F place) {
        using S = Scalar<F>;
        const F half = F(S(0.5)), whole = floor(place), in = place - whole, from = F(part.from[axis]), to = F(part.to[axis]),
                lit = min(max(in - from, F(0)), to - from), after = max(in - to, F(0));
        return whole * (half * (whole - F(1)) + (F(1) - half * (from + to))) + whole * in + half * lit * lit * F(part.per[axis]) +
               after;
    }
};

/// Do two parts lie alike along an axis?
template <class S>
LFDSIM_FN bool alike(const SubpixelPart<S>& a, const SubpixelPart<S>& b, int axis) {
    return a.cell[axis] == b.cell[axis] && a.from[axis] == b.from[axis] && a.to[axis] == b.to[axis];
}

/// The levels of a plane.
LFDSIM_FN PanelLevels plane_of(PanelLevels levels, int plane) {
    levels.level += plane * levels.count * (levels.sums ? 2 : 1);
    levels.columns = levels.level->columns;
    levels.rows = levels.level->rows;
    return levels;
}

/// A box on the level that suits its size, the same for all pixels of a block except for its position.
template <class S>
struct Footprint {
    LevelReader<S> level;
    S width, height, per_width, per_height;  // cells
    bool point;                              // too small to matter: one cell is read

    Footprint() = default;
    /// wide x high cells of the finest level.
    LFDSIM_FN Footprint(const PanelLevels& levels, const PanelBase<S>& base, S wide, S high) {
        int l = 0;
        for (S most = max(wide, high); most > S(most_box) && l + 1 < levels.count; most = most * S(0.5)) ++l;
        level = LevelReader<S>(levels, l, base);
        width = min(max(wide * level.cells_per_pixel, S(least_box)), S(most_box));
        height = min(max(high * level.cells_per_pixel, S(least_box)), S(most_box));
        per_width = S(1) / width;
        per_height = S(1) / height;
        point = max(wide, high) < S(least_box);
    }
    template <class F>
    LFDSIM_FN void add(Light<F>& light, F column, F row, F weight) const {
        if (point)
            level.add_point(light, column, row, weight);
        else
            level.add_box(light, column, row, weight, F(width), F(height), F(per_width), F(per_height));
    }
};

/// The same on a panel with subpixels: a box of wide x high panel pixels.
template <class F>
LFDSIM_APART void add_subpixels(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, Scalar<F> wide, Scalar<F> high,
                                F column, F row, F weight, Light<F>& light) {
    using S = Scalar<F>;
    for (int k = 0; k < levels.emission->count; ++k) {
        const SubpixelPart<S>& part = levels.emission->part[k];
        PlaneSide<F> across(part, 0, base.column, column, F(wide)), down(part, 1, base.row, row, F(high));
        PanelBase<S> from = base;
        from.column = across.base;
        from.row = down.base;
        const Footprint<S> footprint(plane_of(levels, part.plane), from, wide * part.per_cell[0], high * part.per_cell[1]);
        const LevelReader<S>& level = footprint.level;
        const F pixels_per_cell = F(S(1) / level.cells_per_pixel), per_pixel = F(level.cells_per_pixel), least = F(S(least_box));
        across.width = F(footprint.width) * pixels_per_cell;
        down.width = F(footprint.height) * pixels_per_cell;
        across.squeeze(part, 0);
        down.squeeze(part, 1);
        const F w = max(across.width * per_pixel, least), h = max(down.width * per_pixel, least);
        Light<F> of_part;
        level.add_box(of_part, across.middle, down.middle, weight * F(part.share) * across.light * down.light, w, h, F(1) / w,
                      F(1) / h);
        light.add(of_part, part.channel);
    }
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
