#include "image/compare/ssim.h"

#include "base/input_error.h"
#include "image/compare/ssim_window.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim {

// w(k) = exp(-k^2 / (2 sigma^2)) over the sum of all eleven.
SsimWeights ssim_weights() {
    constexpr double sigma = 1.5;
    SsimWeights weights{};
    double sum = 0;
    for (int k = -ssim_border; k <= ssim_border; ++k) sum += std::exp(-0.5 * k * k / (sigma * sigma));
    for (int k = 0; k <= ssim_border; ++k) weights.at[k] = std::exp(-0.5 * k * k / (sigma * sigma)) / sum;
    return weights;
}

const std::vector<SrgbLine>& srgb_lines() {
    static const std::vector<SrgbLine> lines = [] {
        std::vector<SrgbLine> made(((__builtin_bit_cast(std::uint32_t, 1.0f) - srgb_first) >> srgb_shift) + 1);
        for (std::size_t k = 0; k < made.size(); ++k) {
            const auto at = [](std::uint32_t bits) {
                const double x = __builtin_bit_cast(float, bits);
                return std::array<double, 2>{x, 1.055 * std::pow(x, 1 / 2.4) - 0.055};
            };
            const std::uint32_t bits = srgb_first + (std::uint32_t(k) << srgb_shift);
            const auto from = at(bits), to = at(bits + (1u << srgb_shift));
            const double slope = (to[1] - from[1]) / (to[0] - from[0]);
            made[k] = {float(from[1] - slope * from[0]), float(slope)};
        }
        return made;
    }();
    return lines;
}

Region ssim_middles(const Region& region, int width, int height) {
    Region r = region.intersected(Region::of({0, 0, width, height}));
    const std::vector<Region::Row> rows = r.rows;
    for (int k = 0; k < int(rows.size()); ++k) {
        Region::Row& middle = r.rows[std::size_t(k)];
        if (k < ssim_border || k + ssim_border >= int(rows.size())) {
            middle = {0, 0};
            continue;
        }
        for (int n = k - ssim_border; n <= k + ssim_border; ++n) {
            middle.from = std::max(middle.from, rows[std::size_t(n)].from);
            middle.to = std::min(middle.to, rows[std::size_t(n)].to);
        }
        middle = {middle.from + ssim_border, middle.to - ssim_border};
    }
    return r;
}

namespace {

/// Writes the luma of columns [x0, x1) of a row.
void luma_of_row(const Image& image, int row, int x0, int x1, double* to) {
    const SrgbLine* const lines = srgb_lines().data();
    const float* pixel = image.at(x0, row);
    for (int x = x0; x < x1; ++x, pixel += 3) *to++ = code_luma(lines, pixel);
}

using WindowMoments = std::array<std::vector<double>, moments>;

/// The eleven rows of moments that a window covers, moved down the picture row by row: row r is kept at r mod 11.
class WindowRows {
  public:
    WindowRows(const Image& a, const Image& b, Rect box) : a_(a), b_(b), box_(box), columns_(std::size_t(box.x1 - box.x0)) {
        for (WindowMoments& row : rows_)
            for (auto& moment : row) moment.resize(columns_);
        for (auto& moment : down_) moment.resize(columns_);
    }
    void load(int row) {
        WindowMoments& m = at(row);
        luma_of_row(a_, row, box_.x0, box_.x1, m[of_a].data());
        luma_of_row(b_, row, box_.x0, box_.x1, m[of_b].data());
        const double *va = m[of_a].data(), *vb = m[of_b].data();
        double *squares = m[of_squares].data(), *product = m[of_product].data();
        for (std::size_t x = 0; x < columns_; ++x) {
            squares[x] = va[x] * va[x] + vb[x] * vb[x];
            product[x] = va[x] * vb[x];
        }
    }
    /// Computes the SSIM of the windows centred at (x, row), for x from box.x0 + ssim_border on; the rows from row - ssim_border to
    /// row + ssim_border must be loaded.
    void windows(int row, std::vector<double>& values) {
        for (std::size_t i = 0; i < moments; ++i) {
            const double* r[ssim_window];
            for (int k = 0; k < ssim_window; ++k) r[k] = at(row - ssim_border + k)[i].data();
            double* to = down_[i].data();
            for (std::size_t x = 0; x < columns_; ++x) to[x] = weighted(weights_, [&](int k) { return r[k][x]; });
        }
        const auto across = [&](int moment, std::size_t x) {
            const double* v = down_[std::size_t(moment)].data() + x;
            return weighted(weights_, [v](int k) { return v[k]; });
        };
        values.resize(columns_ - 2 * ssim_border);
        for (std::size_t x = 0; x < values.size(); ++x)
            values[x] = ssim_value(across(of_a, x), across(of_b, x), across(of_squares, x), across(of_product, x));
    }

  private:
    WindowMoments& at(int row) { return rows_[std::size_t(row) % ssim_window]; }

    const Image &a_, &b_;
    const Rect box_;
    const std::size_t columns_;
    const SsimWeights weights_ = ssim_weights();
    std::array<WindowMoments, ssim_window> rows_;
    WindowMoments down_;
};

}  // namespace

// Bands of rows go to the threads, each with ssim_border rows more above and below. Sums over rows are made in row order, so that
// the number of threads changes no bit.
std::vector<double> ssim(const Image& a, const Image& b, std::span<const Region> regions) {
    if (a.width != b.width || a.height != b.height)
        throw InputError("", fmt::format("the pictures are {} x {} and {} x {} pixels; only equal sizes can be compared", a.width,
                                         a.height, b.width, b.height));
    std::vector<Region> seen;
    Rect box{a.width, a.height, 0, 0};  // of all windows' middles
    for (const Region& region : regions) {
        seen.push_back(ssim_middles(region, a.width, a.height));
        const Rect r = seen.back().bounds();
        if (r.x0 < r.x1) box = {std::min(box.x0, r.x0), std::min(box.y0, r.y0), std::max(box.x1, r.x1), std::max(box.y1, r.y1)};
    }
    std::vector<std::vector<double>> sums(regions.size(), std::vector<double>(std::size_t(std::max(box.y1 - box.y0, 0)), 0.0));
    constexpr int band_rows = 64;
    tbb::parallel_for(0, (std::max(box.y1 - box.y0, 0) + band_rows - 1) / band_rows, [&](int band) {
        const int begin = box.y0 + band * band_rows, end = std::min(begin + band_rows, box.y1);
        WindowRows rows(a, b, {box.x0 - ssim_border, 0, box.x1 + ssim_border, 0});
        std::vector<double> values;
        for (int row = begin - ssim_border; row < end + ssim_border; ++row) {
            rows.load(row);
            const int middle = row - ssim_border;
            if (middle < begin) continue;
            rows.windows(middle, values);
            for (std::size_t k = 0; k < seen.size(); ++k) {
                const int n = middle - seen[k].top;
                if (n < 0 || n >= int(seen[k].rows.size())) continue;
                const Region::Row r = seen[k].rows[std::size_t(n)];
                sums[k][std::size_t(middle - box.y0)] = sum_of_row(r, [&](int x) { return values[std::size_t(x - box.x0)]; });
            }
        }
    });
    std::vector<double> result;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        double total = 0;
        for (const double sum : sums[k]) total += sum;
        result.push_back(total / double(seen[k].pixels()));  // 0 / 0: NaN
    }
    return result;
}

}  // namespace lfdsim
