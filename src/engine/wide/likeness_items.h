// The items of each step of comparing a view with a photograph, one for each thread: what image/likeness.cpp computes, in the same
// order. Compiled as CUDA (engine/cuda) and, to test it anywhere, for the host. Floor 2.
#pragma once
#include "engine/wide/likeness_frame.h"

namespace lfdsim::wide {

LFDSIM_FN std::int32_t chunks_of(const LikenessFrame& f) { return (f.width + columns_at_once - 1) / columns_at_once; }

/// Sum of value(x) over one chunk of a row's columns.
template <class Value>
LFDSIM_FN double sum_of_chunk(Region::Row row, std::int32_t chunk, Value value) {
    const std::int32_t begin = chunk * columns_at_once, end = begin + columns_at_once;
    double sum = 0;
    for (std::int32_t x = row.from > begin ? row.from : begin; x < row.to && x < end; ++x) sum += value(x);
    return sum;
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

LFDSIM_FN void window_item(const LikenessFrame& f, std::int64_t i) {
    const std::int32_t chunk = std::int32_t(i % chunks_of(f)), row = std::int32_t(i / chunks_of(f)), y = f.first_row + row;
    const std::int64_t each = std::int64_t(f.row_count) * f.width;
    const auto value = [&](std::int32_t x) {
        const double* const v = f.moments + std::int64_t(row) * f.width + x - ssim_border;
        const auto across = [&](int moment) { return weighted(f.weights, [&](int k) { return v[moment * each + k]; }); };
        return ssim_value(across(of_a), across(of_b), across(of_squares), across(of_product));
    };
    const Region::Row screen = f.columns[y], content = f.columns[f.height + y];
    double of_screen = 0, of_content = 0;
    for (std::int32_t x = chunk * columns_at_once; x < (chunk + 1) * columns_at_once; ++x) {
        const bool in_screen = x >= screen.from && x < screen.to, in_content = x >= content.from && x < content.to;
        if (!in_screen && !in_content) continue;
        const double v = value(x);
        if (in_screen) of_screen += v;
        if (in_content) of_content += v;
    }
    *part_of(f, 0, y, chunk) = of_screen;
    *part_of(f, 1, y, chunk) = of_content;
}

LFDSIM_FN void cover_item(const LikenessFrame& f, std::int64_t i) {
    const std::int32_t chunk = std::int32_t(i % chunks_of(f)), y = std::int32_t(i / chunks_of(f));
    const Region::Row row = f.columns[std::int64_t(likeness_regions) * f.height + y];
    const auto a = [&](std::int32_t x) {
        const float* const p = f.picture + (std::int64_t(y) * f.width + x) * 3;
        const float light[3] = {p[0] * f.gain, p[1] * f.gain, p[2] * f.gain};
        return double(luma(light));
    };
    const auto b = [&](std::int32_t x) { return double(f.photograph_light[std::int64_t(y) * f.width + x]); };
    *part_of(f, likeness_regions + of_view, y, chunk) = sum_of_chunk(row, chunk, a);
    *part_of(f, likeness_regions + of_photograph, y, chunk) = sum_of_chunk(row, chunk, b);
    *part_of(f, likeness_regions + of_both, y, chunk) = sum_of_chunk(row, chunk, [&](std::int32_t x) { return a(x) * b(x); });
    *part_of(f, likeness_regions + of_photograph_squared, y, chunk) =
        sum_of_chunk(row, chunk, [&](std::int32_t x) { return b(x) * b(x); });
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
        case LikenessStep::windows:
            return do_it.template operator()<LikenessStep::windows>();
        case LikenessStep::cover:
            return do_it.template operator()<LikenessStep::cover>();
        case LikenessStep::rows:
            return do_it.template operator()<LikenessStep::rows>();
    }
}

}  // namespace lfdsim::wide
