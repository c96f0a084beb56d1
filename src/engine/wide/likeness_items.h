// The items of each step of comparing a view with a photograph, one for each thread: what image/compare/likeness.cpp computes, in
// the same order. Compiled as CUDA (engine/cuda) and, to test it anywhere, for the host. Floor 2.
#pragma once
#include "engine/wide/likeness_frame.h"

namespace lfdsim::wide {

/// The row, from the band's first, and the column of item i. A band has few enough items for 32 bits; a GPU divides 64-bit numbers
/// by a hundred instructions.
struct RowAndColumn {
    std::int32_t row, column;
    LFDSIM_FN RowAndColumn(const LikenessFrame& f, std::int64_t i)
        : row(std::int32_t(std::uint32_t(i) / std::uint32_t(f.width))), column(std::int32_t(i) - row * f.width) {}
};

/// Computes the moments of moment_rows pixels below each other, whose windows have most of their columns' pixels in common: of a
/// (the view) and b (the photograph), a^2 + b^2 and a b, each weighted down the column. value_item() sums them across.
LFDSIM_FN void moment_item(const LikenessFrame& f, std::int64_t i) {
    const RowAndColumn at(f, i);
    constexpr int span = ssim_window + moment_rows - 1;
    const std::int32_t row = at.row * moment_rows, top = f.first_row + row - ssim_border;
    double a[span], b[span], squares[span], product[span];
    for (int k = 0; k < span; ++k) {
        const std::int32_t y = top + k < 0 ? 0 : top + k < f.height ? top + k : f.height - 1;
        const std::int64_t from = std::int64_t(y) * f.width + at.column;
        a[k] = double(f.view_code[from]);
        b[k] = double(f.photograph_code[from]);
        squares[k] = a[k] * a[k] + b[k] * b[k];
        product[k] = a[k] * b[k];
    }
    const std::int64_t each = std::int64_t(f.row_count) * f.width;
    for (int r = 0; r < moment_rows; ++r) {
        if (top + r < 0 || top + r + ssim_window > f.height || row + r >= f.row_count) continue;  // no window's middle
        double* const to = f.moments + std::int64_t(row + r) * f.width + at.column;
        const auto down = [&](const double* of) { return weighted(f.weights, [&](int k) { return of[r + k]; }); };
        to[of_a * each] = down(a);
        to[of_b * each] = down(b);
        to[of_squares * each] = down(squares);
        to[of_product * each] = down(product);
    }
}

/// A group of columns of a row: those with the same number modulo column_groups.
struct Group {
    std::int32_t y, number;
    LFDSIM_FN explicit Group(std::int64_t i) : y(std::int32_t(i / column_groups)), number(std::int32_t(i % column_groups)) {}

    /// Returns the place of one of its sums.
    LFDSIM_FN double& sum(const LikenessFrame& f, int which) const {
        return f.parts[(std::int64_t(which) * f.height + y) * column_groups + number];
    }
    /// Calls look(x) for its columns in a region's row, in ascending order.
    template <class Look>
    LFDSIM_FN void for_columns(Region::Row of_region, Look look) const {
        const std::int32_t first = of_region.from + ((number - of_region.from) & (column_groups - 1));
        for (std::int32_t x = first; x < of_region.to; x += column_groups) look(x);
    }
};

LFDSIM_FN bool holds(Region::Row row, std::int32_t x) { return x >= row.from && x < row.to; }

/// Computes SSIM of the window about a pixel of the band, if that may be a window's middle.
LFDSIM_FN void value_item(const LikenessFrame& f, std::int64_t i) {
    const RowAndColumn at(f, i);
    const std::int32_t x = at.column, y = f.first_row + at.row;
    if (!holds(f.columns[y], x) && !holds(f.columns[f.height + y], x)) return;
    const std::int64_t each = std::int64_t(f.row_count) * f.width;
    const double* const v = f.moments + i - ssim_border;
    const auto across = [&](int moment) { return weighted(f.weights, [&](int k) { return v[moment * each + k]; }); };
    f.values[std::int64_t(f.first_row) * f.width + i] =
        ssim_value(across(of_a), across(of_b), across(of_squares), across(of_product));
}

/// Sums SSIM over a group of columns, for both regions.
LFDSIM_FN void window_item(const LikenessFrame& f, std::int64_t i) {
    const Group group(i);
    const double* const value = f.values + std::int64_t(group.y) * f.width;
    for (int region = 0; region < likeness_regions; ++region) {
        double sum = 0;
        group.for_columns(f.columns[std::int64_t(region) * f.height + group.y], [&](std::int32_t x) { sum += value[x]; });
        group.sum(f, region) = sum;
    }
}

/// Sums the light that the covered share of the screen is derived from, over a group of columns.
LFDSIM_FN void cover_item(const LikenessFrame& f, std::int64_t i) {
    const Group group(i);
    double sums[cover_sums] = {};
    group.for_columns(f.columns[std::int64_t(likeness_regions) * f.height + group.y], [&](std::int32_t x) {
        const std::int64_t at = std::int64_t(group.y) * f.width + x;
        const float* const p = f.picture + at * 3;
        const float light[3] = {p[0] * f.gain, p[1] * f.gain, p[2] * f.gain};
        const double a = double(luma(light)), b = double(f.photograph_light[at]);
        sums[of_view] += a;
        sums[of_photograph] += b;
        sums[of_both] += a * b;
        sums[of_photograph_squared] += b * b;
    });
    for (int k = 0; k < cover_sums; ++k) group.sum(f, likeness_regions + k) = sums[k];
}

/// Computes item i of a step.
template <LikenessStep step>
LFDSIM_FN void likeness_item(const LikenessFrame& f, std::int64_t i) {
    if constexpr (step == LikenessStep::photograph) {
        f.photograph_code[i] = code_luma(f.srgb, f.picture + 3 * i);
        f.photograph_light[i] = luma(f.picture + 3 * i);
    }
    if constexpr (step == LikenessStep::view) {
        const float* const p = f.picture + 3 * i;
        const float light[3] = {p[0] * f.gain, p[1] * f.gain, p[2] * f.gain};
        f.view_code[i] = code_luma(f.srgb, light);
    }
    if constexpr (step == LikenessStep::moments) moment_item(f, i);
    if constexpr (step == LikenessStep::values) value_item(f, i);
    if constexpr (step == LikenessStep::windows) window_item(f, i);
    if constexpr (step == LikenessStep::cover) cover_item(f, i);
    if constexpr (step == LikenessStep::rows) {
        const double* const parts = f.parts + i * column_groups;
        double sum = 0;
        for (int group = 0; group < column_groups; ++group) sum += parts[group];
        f.sums[i] = sum;
    }
}

/// Calls do_it.operator()<step>() with the step as a constant: each is compiled separately.
template <class Do>
void choose_likeness_item(LikenessStep step, Do do_it) {
    switch (step) {
        case LikenessStep::photograph:
            return do_it.template operator()<LikenessStep::photograph>();
        case LikenessStep::view:
            return do_it.template operator()<LikenessStep::view>();
        case LikenessStep::moments:
            return do_it.template operator()<LikenessStep::moments>();
        case LikenessStep::values:
            return do_it.template operator()<LikenessStep::values>();
        case LikenessStep::windows:
            return do_it.template operator()<LikenessStep::windows>();
        case LikenessStep::cover:
            return do_it.template operator()<LikenessStep::cover>();
        case LikenessStep::rows:
            return do_it.template operator()<LikenessStep::rows>();
    }
}

}  // namespace lfdsim::wide
