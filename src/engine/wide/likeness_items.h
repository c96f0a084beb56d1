// The items of each step of comparing a view with a photograph, one for each thread: what image/likeness.cpp computes, in the same
// order. Compiled as CUDA (engine/cuda) and, to test it anywhere, for the host. Floor 2.
#pragma once
#include "engine/wide/likeness_frame.h"

namespace lfdsim::wide {

LFDSIM_FN std::int32_t chunks_of(const LikenessFrame& f) { return (f.width + columns_at_once - 1) / columns_at_once; }

/// The columns of a region's row that lie in one chunk.
LFDSIM_FN Region::Row in_chunk(Region::Row row, std::int32_t chunk) {
    const std::int32_t begin = chunk * columns_at_once, end = begin + columns_at_once;
    return {row.from > begin ? row.from : begin, row.to < end ? row.to : end};
}

LFDSIM_FN void moment_item(const LikenessFrame& f, std::int64_t i) {
    const std::int32_t row = std::int32_t(i / f.width), y = f.first_row + row;
    if (y < ssim_border || y + ssim_border >= f.height) return;  // no window's middle
    const std::int64_t above = std::int64_t(y - ssim_border) * f.width + i % f.width;
    const auto a = [&](int k) { return double(f.view_code[above + std::int64_t(k) * f.width]); };
    const auto b = [&](int k) { return double(f.photograph_code[above + std::int64_t(k) * f.width]); };
    const std::int64_t each = std::int64_t(f.row_count) * f.width;
    f.moments[of_a * each + i] = weighted(f.weights, a);
    f.moments[of_b * each + i] = weighted(f.weights, b);
    f.moments[of_squares * each + i] = weighted(f.weights, [&](int k) { return a(k) * a(k) + b(k) * b(k); });
    f.moments[of_product * each + i] = weighted(f.weights, [&](int k) { return a(k) * b(k); });
}

LFDSIM_FN double* part_of(const LikenessFrame& f, int which, std::int32_t y, std::int32_t chunk) {
    return f.parts + (std::int64_t(which) * f.height + y) * chunks_of(f) + chunk;
}

LFDSIM_FN bool holds(Region::Row row, std::int32_t x) { return x >= row.from && x < row.to; }

LFDSIM_FN void value_item(const LikenessFrame& f, std::int64_t i) {
    const std::int32_t x = std::int32_t(i % f.width), y = f.first_row + std::int32_t(i / f.width);
    if (!holds(f.columns[y], x) && !holds(f.columns[f.height + y], x)) return;
    const std::int64_t each = std::int64_t(f.row_count) * f.width;
    const double* const v = f.moments + i - ssim_border;
    const auto across = [&](int moment) { return weighted(f.weights, [&](int k) { return v[moment * each + k]; }); };
    f.values[std::int64_t(f.first_row) * f.width + i] =
        ssim_value(across(of_a), across(of_b), across(of_squares), across(of_product));
}

LFDSIM_FN void window_item(const LikenessFrame& f, std::int64_t i) {
    const std::int32_t chunk = std::int32_t(i % chunks_of(f)), y = std::int32_t(i / chunks_of(f));
    const double* const value = f.values + std::int64_t(y) * f.width;
    for (int region = 0; region < likeness_regions; ++region) {
        const Region::Row columns = in_chunk(f.columns[std::int64_t(region) * f.height + y], chunk);
        double sum = 0;
        for (std::int32_t x = columns.from; x < columns.to; ++x) sum += value[x];
        *part_of(f, region, y, chunk) = sum;
    }
}

LFDSIM_FN void cover_item(const LikenessFrame& f, std::int64_t i) {
    const std::int32_t chunk = std::int32_t(i % chunks_of(f)), y = std::int32_t(i / chunks_of(f));
    const Region::Row columns = in_chunk(f.columns[std::int64_t(likeness_regions) * f.height + y], chunk);
    double sums[cover_sums] = {};
    for (std::int32_t x = columns.from; x < columns.to; ++x) {
        const std::int64_t at = std::int64_t(y) * f.width + x;
        const float* const p = f.picture + at * 3;
        const float light[3] = {p[0] * f.gain, p[1] * f.gain, p[2] * f.gain};
        const double a = double(luma(light)), b = double(f.photograph_light[at]);
        sums[of_view] += a;
        sums[of_photograph] += b;
        sums[of_both] += a * b;
        sums[of_photograph_squared] += b * b;
    }
    for (int k = 0; k < cover_sums; ++k) *part_of(f, likeness_regions + k, y, chunk) = sums[k];
}

/// Item i of a step.
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
        const double* const parts = f.parts + i * chunks_of(f);
        double sum = 0;
        for (std::int32_t chunk = 0; chunk < chunks_of(f); ++chunk) sum += parts[chunk];
        f.sums[i] = sum;
    }
}

/// do_it.template operator()<step>() for the step at hand: each is compiled separately.
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
