#include "image/compare.h"

#include "model/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

// Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE TIP 13(4),
// 2004.
constexpr int window = 11, border = window / 2;
constexpr double sigma = 1.5;
constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // (K1 L)^2, (K2 L)^2 with L = 1

std::array<double, border + 1> gaussian() {
    std::array<double, border + 1> weights{};  // [k]: at distance k; both sides sum to 1
    double sum = 0;
    for (int k = -border; k <= border; ++k) sum += std::exp(-0.5 * k * k / (sigma * sigma));
    for (int k = 0; k <= border; ++k) weights[std::size_t(k)] = std::exp(-0.5 * k * k / (sigma * sigma)) / sum;
    return weights;
}

/// sRGB-encoded luma of the pixels in `region`, row by row. Single precision suffices: 6e-8 of values in [0, 1].
std::vector<float> luma(const Image& image, const Rect& region) {
    std::vector<float> result;
    result.reserve(std::size_t(region.x1 - region.x0) * std::size_t(region.y1 - region.y0));
    const auto encode = [](float x) {
        x = x > 0 ? (x < 1 ? x : 1) : 0;
        return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    };
    for (int y = region.y0; y < region.y1; ++y) {
        const float* pixel = image.at(region.x0, y);
        for (int x = region.x0; x < region.x1; ++x, pixel += 3)
            result.push_back(0.2126f * encode(pixel[0]) + 0.7152f * encode(pixel[1]) + 0.0722f * encode(pixel[2]));
    }
    return result;
}

enum Moment { mean_a, mean_b, mean_aa, mean_bb, mean_ab, moments };
using Moments = std::array<std::vector<double>, moments>;

/// The sum over a row of windows; `a` and `b` are the top rows of luma, `vertical` is room to work in.
double ssim_of_row(const float* a, const float* b, std::size_t columns, Moments& vertical) {
    static const auto weights = gaussian();
    for (auto& moment : vertical) moment.assign(columns, 0.0);  // weighted down the window's columns
    for (int k = -border; k <= border; ++k, a += columns, b += columns) {
        const double w = weights[std::size_t(std::abs(k))];
        for (std::size_t x = 0; x < columns; ++x) {
            const double va = a[x], vb = b[x];
            vertical[mean_a][x] += w * va;
            vertical[mean_b][x] += w * vb;
            vertical[mean_aa][x] += w * va * va;
            vertical[mean_bb][x] += w * vb * vb;
            vertical[mean_ab][x] += w * va * vb;
        }
    }
    double sum = 0;
    for (std::size_t x = border; x < columns - border; ++x) {
        double m[moments];
        for (std::size_t i = 0; i < moments; ++i) {
            const double* v = &vertical[i][x];
            m[i] = weights[0] * v[0];
            for (int k = 1; k <= border; ++k) m[i] += weights[std::size_t(k)] * (v[-k] + v[k]);
        }
        const double product = m[mean_a] * m[mean_b], squares = m[mean_a] * m[mean_a] + m[mean_b] * m[mean_b];
        sum += (2 * product + c1) * (2 * (m[mean_ab] - product) + c2) / ((squares + c1) * (m[mean_aa] + m[mean_bb] - squares + c2));
    }
    return sum;
}

/// In bands of rows, so that the luma of a large picture is never all in memory. Sums over rows are made in row order, so that the
/// number of threads changes no bit.
double ssim(const Image& a, const Image& b, const Rect& region) {
    constexpr int band_rows = 64;
    const std::size_t columns = std::size_t(region.x1 - region.x0);
    const int rows = region.y1 - region.y0 - 2 * border;  // of windows
    std::vector<double> row_sums(std::size_t(rows), 0.0);
    tbb::parallel_for(0, (rows + band_rows - 1) / band_rows, [&](int band) {
        const int begin = band * band_rows, end = std::min(begin + band_rows, rows);
        const Rect seen{region.x0, region.y0 + begin, region.x1, region.y0 + end + 2 * border};
        const std::vector<float> luma_a = luma(a, seen), luma_b = luma(b, seen);
        Moments vertical;
        for (int row = begin; row < end; ++row) {
            const std::size_t top = std::size_t(row - begin) * columns;
            row_sums[std::size_t(row)] = ssim_of_row(&luma_a[top], &luma_b[top], columns, vertical);
        }
    });
    double total = 0;
    for (const double sum : row_sums) total += sum;
    return total / (double(columns - 2 * border) * double(rows));
}

struct RowDifference {
    double squares = 0, max = -1;
    int column = 0, channel = 0;
};

void compare_light(const Image& a, const Image& b, const Rect& region, Comparison& result) {
    std::vector<RowDifference> rows(std::size_t(region.y1 - region.y0));
    tbb::parallel_for(region.y0, region.y1, [&](int y) {
        RowDifference& row = rows[std::size_t(y - region.y0)];
        const float *pa = a.at(region.x0, y), *pb = b.at(region.x0, y);
        for (int i = 0; i < (region.x1 - region.x0) * 3; ++i) {
            const double difference = std::abs(double(pa[i]) - double(pb[i]));
            row.squares += difference * difference;
            if (difference > row.max) {
                row.max = difference;
                row.column = region.x0 + i / 3;
                row.channel = i % 3;
            }
        }
    });
    double squares = 0;
    result.max_difference = -1;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        squares += rows[r].squares;
        if (rows[r].max <= result.max_difference) continue;
        result.max_difference = rows[r].max;
        result.max_column = rows[r].column;
        result.max_row = region.y0 + int(r);
        result.max_channel = rows[r].channel;
    }
    result.rmse = std::sqrt(squares / (3.0 * double(region.x1 - region.x0) * double(rows.size())));
    result.psnr_db = squares > 0 ? -20 * std::log10(result.rmse) : std::numeric_limits<double>::infinity();
}

}  // namespace

Comparison compare(const Image& a, const Image& b, std::optional<Rect> wanted) {
    if (a.width != b.width || a.height != b.height)
        throw InputError("", fmt::format("the pictures are {} x {} and {} x {} pixels; only equal sizes can be compared", a.width,
                                         a.height, b.width, b.height));
    const Rect region = wanted.value_or(Rect{0, 0, a.width, a.height});
    if (region.x0 < 0 || region.y0 < 0 || region.x1 > a.width || region.y1 > a.height)
        throw InputError("", fmt::format("the region {},{},{},{} leaves the picture of {} x {} pixels", region.x0, region.y0,
                                         region.x1, region.y1, a.width, a.height));
    const int columns = region.x1 - region.x0, rows = region.y1 - region.y0;
    if (columns < window || rows < window)
        throw InputError(
            "", fmt::format("{} x {} pixels are too few to compare; at least {} x {} are needed", columns, rows, window, window));
    Comparison result{};
    result.ssim = ssim(a, b, region);
    compare_light(a, b, region, result);
    return result;
}

}  // namespace lfdsim
