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

/// A side of a box of the panel, as that of a box of the plane in which a subpixel's part repeats.
template <class F>
struct PlaneSide {
    std::uint32_t base;  // the plane's cell that holds the panel's base
    F middle, width;     // in cells of the plane, the middle from the base
    F light;             // after squeeze(): that in the squeezed side over that in the side

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
        const auto light_before = [&](F place) {
            const F whole = floor(place);
            return whole + min(max((place - whole - F(part.from[axis])) * F(part.per[axis]), F(0)), F(1));
        };
        const F wide = max(width, F(S(1.0 / 4096))), half = F(S(0.5)) * wide, pixel = floor(middle), place = middle - pixel;
        const F first = light_before(place - half), last = light_before(place + half);
        middle = pixel + F(S(0.5)) * (first + last);
        width = last - first;
        light = width / wide;
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
    return levels;
}

/// The least level whose cells are at least `size` panel pixels wide, or the last one.
template <class F>
LFDSIM_FN Uint<F> level_of(F size, int count) {
    const Uint<F> above = ((float_bits(size) + Uint<F>(0x7fffffu)) >> 23) - Uint<F>(127u), top = Uint<F>(std::uint32_t(count - 1));
    const Uint<F> fitting = select(size > F(1), above, Uint<F>(0u));
    return select(fitting < top, fitting, top);
}

/// light_of_plane() for boxes that are long where there are sums: at the level at which a box is at most two cells wide, of which
/// one is read, and along its whole length. Between the sums before and after a cell the sum is linear.
template <class F>
LFDSIM_FN void light_of_long_boxes(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, F column, F row, F wide, F high,
                                   F weight, Scalar<F> (*light)[4]) {
    using S = Scalar<F>;
    constexpr int lanes = LaneTraits<F>::width, corners = 8;  // of sums: two lines, two ends, before and after a cell
    const bool tall = levels.tall;
    const Uint<F> level = level_of(F(S(0.5)) * (tall ? wide : high), levels.count), one = Uint<F>(1u);
    const F scale = bits_float<F>((Uint<F>(127u) - level) << 23), half = F(S(0.5));
    auto cells = [&](std::uint32_t of) { return F(0) - floor(F(0) - F(S(std::int32_t(of))) * scale); };
    const F columns = cells(levels.level[0].columns), rows = cells(levels.level[0].rows), last = tall ? rows : columns;
    const F c = (F(S(std::int32_t(base.column))) + column) * scale, r = (F(S(std::int32_t(base.row))) + row) * scale;
    const F across = min(max((tall ? wide : high) * scale, F(S(least_box))), F(1)),
            length = max((tall ? high : wide) * scale, F(S(most_box)));  // shorter ones would lose the sums' digits
    const F side = (tall ? c : r) - half * across, start = (tall ? r : c) - half * length;
    const F line = floor(side), beyond = max(F(1) - (line + F(1) - side) / across, F(0)), per = weight / length;
    const Uint<F> lines = to_int(tall ? columns : rows), pitch = to_int(tall ? columns : columns + F(1));
    std::uint32_t at[lanes], place[corners][lanes];
    S share[corners][lanes];
    for (int end = 0; end < 2; ++end) {
        const F to = min(max(end == 0 ? start : start + length, F(0)), last), cell = min(floor(to), last - F(1)), rest = to - cell;
        const Uint<F> k = to_int(cell);
        for (int n = 0; n < 4; ++n) {
            const Uint<F> number = to_int(line) + (n / 2 == 0 ? Uint<F>(0u) : one), sum = k + (n % 2 == 0 ? Uint<F>(0u) : one);
            const Mask<F> lit = number < lines;
            const F part = (n / 2 == 0 ? F(1) - beyond : beyond) * (n % 2 == 0 ? F(1) - rest : rest);
            store(select(lit, tall ? sum * pitch + number : number * pitch + sum, Uint<F>(0u)), place[4 * end + n]);
            store(select(lit, end == 0 ? F(0) - per * part : per * part, F(0)), share[4 * end + n]);
        }
    }
    store(level + Uint<F>(std::uint32_t(levels.count)), at);
    for (int k = 0; k < lanes; ++k) {
        const float* const sums = levels.level[at[k]].texels;
        Texel sum{};
        for (int n = 0; n < 4; ++n) {
            Texel ends[2];
            for (int end = 0; end < 2; ++end) ends[end] = load_texel(sums + std::size_t(place[4 * end + n][k]) * 4);
            Texel part = ends[1] * share[4 + n][k];
            part += ends[0] * share[n][k];
            sum += part;
        }
        store_texel(sum, light[k]);
    }
}

/// The mean over boxes of a plane that differ from lane to lane, each on a level of its own: weight x the light of each lane; R, G,
/// B and an unused number. A box's level is that at which it is at most two cells wide, and one cell's width of it is read: the
/// light that a coarser cell would add from outside the box is the larger error. Positions are measured from the panel's corner in
/// single precision: on a panel of 16384 columns accurate to 1/1000 of a pixel.
template <class F>
LFDSIM_FN void light_of_plane(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, F column, F row, F wide, F high,
                              F weight, Scalar<F> (*light)[4]) {
    using S = Scalar<F>;
    constexpr int lanes = LaneTraits<F>::width;
    const bool any_long = levels.sums && any((levels.tall ? high : wide) > F(S(most_box)));
    S long_light[lanes][4];
    if (any_long) {
        const F across = levels.tall ? wide : high, along = levels.tall ? high : wide;
        const Mask<F> lies_long = along > max(across, F(S(most_box)));
        light_of_long_boxes(levels, base, column, row, wide, high, select(lies_long, weight, F(0)), long_light);
        weight = select(lies_long, F(0), weight);
    }
    const F size = F(S(0.5)) * max(wide, high);  // <= 2^level
    const Uint<F> level = level_of(size, levels.count);
    const F scale = bits_float<F>((Uint<F>(127u) - level) << 23);
    auto cells = [&](std::uint32_t of) { return to_int(F(0) - floor(F(0) - F(S(std::int32_t(of))) * scale)); };
    const Uint<F> columns = cells(levels.level[0].columns), rows = cells(levels.level[0].rows);
    const F half = F(S(0.5)), width = min(max(wide * scale, F(S(least_box))), F(1)),
            height = min(max(high * scale, F(S(least_box))), F(1));
    const F c = (F(S(std::int32_t(base.column))) + column) * scale - half * width,
            r = (F(S(std::int32_t(base.row))) + row) * scale - half * height;
    const F whole_c = floor(c), whole_r = floor(r);
    const F right = max(F(1) - (whole_c + F(1) - c) / width, F(0)), below = max(F(1) - (whole_r + F(1) - r) / height, F(0));
    const Uint<F> i = to_int(whole_c), j = to_int(whole_r);
    std::uint32_t at[lanes], place[4][lanes];
    S share[4][lanes];
    auto cell = [&](int k, Uint<F> across, Uint<F> down, F part) {
        const Mask<F> lit = (across < columns) && (down < rows);
        store(select(lit, down * columns + across, Uint<F>(0u)), place[k]);
        store(select(lit, weight * part, F(0)), share[k]);
    };
    const Uint<F> one = Uint<F>(1u);
    cell(0, i, j, (F(1) - below) * (F(1) - right));
    cell(1, i + one, j, (F(1) - below) * right);
    cell(2, i, j + one, below * (F(1) - right));
    cell(3, i + one, j + one, below * right);
    store(level, at);
    for (int k = 0; k < lanes; ++k) {
        const float* const texels = levels.level[at[k]].texels;
        Texel sum{};
        for (int n = 0; n < 4; ++n) {
            sum += load_texel(texels + std::size_t(place[n][k]) * 4) * share[n][k];
        }
        if (any_long) sum += texel_of(long_light[k]);
        store_texel(sum, light[k]);
    }
}

/// The mean over boxes of the panel, each lane's own: of all that shines in them.
template <class F>
LFDSIM_FN void light_of_boxes(const PanelLevels& levels, const PanelBase<Scalar<F>>& base, F column, F row, F wide, F high,
                              F weight, Scalar<F> (*light)[4]) {
    using S = Scalar<F>;
    constexpr int lanes = LaneTraits<F>::width;
    const Emission<S>& emission = *levels.emission;
    if (emission.whole) return light_of_plane(levels, base, column, row, wide, high, weight, light);
    for (int n = 0; n < lanes; ++n)
        for (int colour = 0; colour < 4; ++colour) light[n][colour] = 0;
    const std::uint32_t number[2] = {base.column, base.row};
    const F place[2] = {column, row}, size[2] = {wide, high};
    const auto side_of = [&](const SubpixelPart<S>& part, int axis) {
        PlaneSide<F> side(part, axis, number[axis], place[axis], size[axis]);
        side.squeeze(part, axis);
        return side;
    };
    PlaneSide<F> side[2] = {side_of(emission.part[0], 0), side_of(emission.part[0], 1)};
    for (int k = 0; k < emission.count; ++k) {
        const SubpixelPart<S>& part = emission.part[k];
        for (int axis = 0; axis < 2 && k > 0; ++axis)
            if (!alike(part, emission.part[k - 1], axis)) side[axis] = side_of(part, axis);
        PanelBase<S> from = base;
        from.column = side[0].base;
        from.row = side[1].base;
        S of_part[lanes][4], shown[4];
        light_of_plane(plane_of(levels, part.plane), from, side[0].middle, side[1].middle, side[0].width, side[1].width,
                       weight * F(part.share) * side[0].light * side[1].light, of_part);
        for (int colour = 0; colour < 4; ++colour) shown[colour] = part.channel == 3 || part.channel == colour ? S(1) : S(0);
        for (int n = 0; n < lanes; ++n)
            for (int colour = 0; colour < 4; ++colour) light[n][colour] = light[n][colour] + shown[colour] * of_part[n][colour];
    }
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
