// The mean light of the panel over a footprint, from a pyramid of ever coarser panel images. Floor 1.
//
// A level's cell is the mean of 2 x 2 cells of the level below; level 0 is the panel. The level is taken at which the footprint is
// at most one cell wide and high: it then overlaps 2 x 2 cells, which count by how much of it lies in each. At level 0 that is
// exact.
#pragma once
#include "optics/light.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A level of the pyramid as the rays from one base lens read it.
template <class S>
struct LevelReader {
    const float* texels;
    std::uint32_t columns, rows;          // cells
    std::uint32_t base_column, base_row;  // the cell of the base
    S rest_column, rest_row;              // panel pixels from that cell's first to the base
    S cells_per_pixel;

    LevelReader() = default;
    LFDSIM_FN LevelReader(const PanelLevel* levels, int level, const PanelBase<S>& base) {
        texels = levels[level].texels;
        columns = levels[level].columns;
        rows = levels[level].rows;
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

    /// Adds weight x the mean over a box about there, width x height cells, at most one each; per_width = 1 / width.
    template <class F>
    LFDSIM_FN void add_box(Light<F>& light, F column, F row, F weight, F width, F height, F per_width, F per_height) const {
        const F half = F(S(0.5)), c = cells(rest_column, column) - half * width, r = cells(rest_row, row) - half * height;
        const F whole_c = floor(c), whole_r = floor(r);
        const F right = max(F(1) - (whole_c + F(1) - c) * per_width, F(0)),
                below = max(F(1) - (whole_r + F(1) - r) * per_height, F(0));
        const Uint<F> i = to_int(whole_c), j = to_int(whole_r);
        const F upper = weight * (F(1) - below), lower = weight * below, left = F(1) - right;
        add_cell(light, i, j, upper * left);
        add_cell(light, i + Uint<F>(1u), j, upper * right);
        add_cell(light, i, j + Uint<F>(1u), lower * left);
        add_cell(light, i + Uint<F>(1u), j + Uint<F>(1u), lower * right);
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
constexpr float kLeastBox = 1.0f / 64, kMostBox = 1;

/// A box on the level that suits it, the same for all pixels of a block but for its place.
template <class S>
struct Footprint {
    LevelReader<S> level;
    S width, height, per_width, per_height;  // cells
    bool point;                              // too small to matter: one cell is read

    Footprint() = default;
    /// wide x high panel pixels.
    LFDSIM_FN Footprint(const PanelLevel* levels, int count, const PanelBase<S>& base, S wide, S high) {
        int l = 0;
        for (S most = max(wide, high); most > S(kMostBox) && l + 1 < count; most = most * S(0.5)) ++l;
        level = LevelReader<S>(levels, l, base);
        width = min(max(wide * level.cells_per_pixel, S(kLeastBox)), S(kMostBox));
        height = min(max(high * level.cells_per_pixel, S(kLeastBox)), S(kMostBox));
        per_width = S(1) / width;
        per_height = S(1) / height;
        point = max(wide, high) < S(kLeastBox);
    }
    template <class F>
    LFDSIM_FN void add(Light<F>& light, F column, F row, F weight) const {
        if (point)
            level.add_point(light, column, row, weight);
        else
            level.add_box(light, column, row, weight, F(width), F(height), F(per_width), F(per_height));
    }
};

/// The same for boxes that differ from lane to lane, lanes `active`.
template <class F>
LFDSIM_FN void add_boxes(const PanelLevel* levels, int count, const PanelBase<Scalar<F>>& base, Mask<F> active, F column, F row,
                         F wide, F high, F weight, Light<F>& light) {
    using S = Scalar<F>;
    F most = max(wide, high);
    for (int l = 0; l < count && any(active); ++l) {
        const Mask<F> here = l + 1 < count ? active && (most <= F(S(kMostBox))) : active;
        const LevelReader<S> level(levels, l, base);
        const F width = min(max(wide * F(level.cells_per_pixel), F(S(kLeastBox))), F(S(kMostBox))),
                height = min(max(high * F(level.cells_per_pixel), F(S(kLeastBox))), F(S(kMostBox)));
        if (any(here)) level.add_box(light, column, row, select(here, weight, F(0)), width, height, F(1) / width, F(1) / height);
        active = active && !here;
        most = most * F(S(0.5));
    }
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
