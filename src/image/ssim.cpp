#include "image/ssim.h"

#include "model/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace lfdsim {

Region Region::of(const Rect& r) { return {r.y0, std::vector<Row>(std::size_t(std::max(r.y1 - r.y0, 0)), Row{r.x0, r.x1})}; }

Region Region::polygon(std::span<const std::array<double, 2>> corners, int width, int height) {
    if (corners.size() < 3) throw std::invalid_argument("a polygon has three corners or more");
    Region region{0, std::vector<Row>(std::size_t(height), Row{0, 0})};
    for (int row = 0; row < height; ++row) {
        const double y = row + 0.5;
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
            if ((a[1] <= y) == (b[1] <= y)) continue;
            const double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            least = std::min(least, x);
            most = std::max(most, x);
        }
        const auto column = [width](double x) { return int(std::clamp(std::ceil(x - 0.5), 0., double(width))); };
        if (least < most) region.rows[std::size_t(row)] = {column(least), column(most)};
    }
    return region;
}

std::int64_t Region::pixels() const {
    std::int64_t sum = 0;
    for (const Row& r : rows) sum += std::max(r.to - r.from, 0);
    return sum;
}

Rect Region::bounds() const {
    Rect box{};
    bool first = true;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& r = rows[k];
        if (r.from >= r.to) continue;
        const int y = top + int(k);
        box = first ? Rect{r.from, y, r.to, y + 1} : Rect{std::min(box.x0, r.from), box.y0, std::max(box.x1, r.to), y + 1};
        first = false;
    }
    return box;
}

Region Region::shifted(int columns, int down) const {
    Region r = *this;
    r.top += down;
    for (Row& row : r.rows) row = {row.from + columns, row.to + columns};
    return r;
}

Region Region::intersected(const Region& other) const {
    Region r = *this;
    for (std::size_t k = 0; k < r.rows.size(); ++k) {
        const int n = top + int(k) - other.top;
        const Row with = n >= 0 && n < int(other.rows.size()) ? other.rows[std::size_t(n)] : Row{0, 0};
        r.rows[k] = {std::max(r.rows[k].from, with.from), std::min(r.rows[k].to, with.to)};
    }
    return r;
}

namespace {

constexpr int border = ssim_window / 2;
constexpr double sigma = 1.5;
constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // (K1 L)^2, (K2 L)^2 with L = 1

std::array<double, border + 1> gaussian() {
    std::array<double, border + 1> weights{};  // [k]: at distance k; both sides sum to 1
    double sum = 0;
    for (int k = -border; k <= border; ++k) sum += std::exp(-0.5 * k * k / (sigma * sigma));
    for (int k = 0; k <= border; ++k) weights[std::size_t(k)] = std::exp(-0.5 * k * k / (sigma * sigma)) / sum;
    return weights;
}

/// sRGB's encoding of single-precision light in [0, 1], good to 2e-7: straight lines between 512 places an octave, by the bits of
/// the number. A power takes six times as long.
class Encode {
  public:
    Encode() {
        for (std::size_t k = 0; k < places.size(); ++k) {
            const auto at = [](std::uint32_t bits) {
                const double x = std::bit_cast<float>(bits);
                return std::array<double, 2>{x, 1.055 * std::pow(x, 1 / 2.4) - 0.055};
            };
            const std::uint32_t bits = first + (std::uint32_t(k) << shift);
            const auto from = at(bits), to = at(bits + (1u << shift));
            const double slope = (to[1] - from[1]) / (to[0] - from[0]);
            places[k] = {float(from[1] - slope * from[0]), float(slope)};
        }
    }
    float operator()(float x) const {
        x = x > 0 ? (x < 1 ? x : 1) : 0;
        if (x <= 0.0031308f) return 12.92f * x;
        const Line& l = places[(std::bit_cast<std::uint32_t>(x) - first) >> shift];
        return l.at_zero + l.slope * x;
    }

  private:
    struct Line {
        float at_zero, slope;
    };
    static constexpr int shift = 14;
    static constexpr std::uint32_t first = std::bit_cast<std::uint32_t>(0x1p-9f);
    std::array<Line, ((std::bit_cast<std::uint32_t>(1.0f) - first) >> shift) + 1> places;
};

/// Luma of columns [x0, x1) of a row.
void luma(const Image& image, int row, int x0, int x1, double* to) {
    static const Encode encode;
    const float* pixel = image.at(x0, row);
    for (int x = x0; x < x1; ++x, pixel += 3)
        *to++ = 0.2126f * encode(pixel[0]) + 0.7152f * encode(pixel[1]) + 0.0722f * encode(pixel[2]);
}

/// What SSIM sums up over a window: both lumas, their squares together, their product.
enum Moment { of_a, of_b, of_squares, of_product, moments };
using Moments = std::array<std::vector<double>, moments>;

/// Eleven rows of moments, as they enter and leave the window from above.
class Rows {
  public:
    Rows(const Image& a, const Image& b, Rect box) : a_(a), b_(b), box_(box), columns_(std::size_t(box.x1 - box.x0)) {
        for (Moments& row : rows_)
            for (auto& moment : row) moment.resize(columns_);
        for (auto& moment : down_) moment.resize(columns_);
    }
    void load(int row) {
        Moments& m = at(row);
        luma(a_, row, box_.x0, box_.x1, m[of_a].data());
        luma(b_, row, box_.x0, box_.x1, m[of_b].data());
        const double *va = m[of_a].data(), *vb = m[of_b].data();
        double *squares = m[of_squares].data(), *product = m[of_product].data();
        for (std::size_t x = 0; x < columns_; ++x) {
            squares[x] = va[x] * va[x] + vb[x] * vb[x];
            product[x] = va[x] * vb[x];
        }
    }
    /// SSIM of the windows about (x, row), x = box.x0 + border ...; the rows row - border ... row + border are loaded.
    void windows(int row, std::vector<double>& values) {
        static const auto w = gaussian();
        for (std::size_t i = 0; i < moments; ++i) {
            const double* r[ssim_window];
            for (int k = 0; k < ssim_window; ++k) r[k] = at(row - border + k)[i].data();
            double* to = down_[i].data();
            for (std::size_t x = 0; x < columns_; ++x)
                to[x] = w[0] * r[5][x] + w[1] * (r[4][x] + r[6][x]) + w[2] * (r[3][x] + r[7][x]) + w[3] * (r[2][x] + r[8][x]) +
                        w[4] * (r[1][x] + r[9][x]) + w[5] * (r[0][x] + r[10][x]);
        }
        const auto across = [&](int moment, std::size_t x) {
            const double* v = down_[std::size_t(moment)].data() + x;
            return w[0] * v[5] + w[1] * (v[4] + v[6]) + w[2] * (v[3] + v[7]) + w[3] * (v[2] + v[8]) + w[4] * (v[1] + v[9]) +
                   w[5] * (v[0] + v[10]);
        };
        values.resize(columns_ - 2 * border);
        for (std::size_t x = 0; x < values.size(); ++x) {
            const double a = across(of_a, x), b = across(of_b, x), product = a * b, squares = a * a + b * b;
            values[x] = (2 * product + c1) * (2 * (across(of_product, x) - product) + c2) /
                        ((squares + c1) * (across(of_squares, x) - squares + c2));
        }
    }

  private:
    Moments& at(int row) { return rows_[std::size_t(row) % ssim_window]; }

    const Image &a_, &b_;
    const Rect box_;
    const std::size_t columns_;
    std::array<Moments, ssim_window> rows_;
    Moments down_;
};

/// Where a window's middle may stand so that it lies in the region.
Region middles(const Region& region, const Image& image) {
    Region r = region.intersected(Region::of({0, 0, image.width, image.height}));
    const std::vector<Region::Row> rows = r.rows;
    for (int k = 0; k < int(rows.size()); ++k) {
        Region::Row& middle = r.rows[std::size_t(k)];
        if (k < border || k + border >= int(rows.size())) {
            middle = {0, 0};
            continue;
        }
        for (int n = k - border; n <= k + border; ++n) {
            middle.from = std::max(middle.from, rows[std::size_t(n)].from);
            middle.to = std::min(middle.to, rows[std::size_t(n)].to);
        }
        middle = {middle.from + border, middle.to - border};
    }
    return r;
}

}  // namespace

// Bands of rows go to the threads. Sums over rows are made in row order, so that the number of threads changes no bit.
std::vector<double> ssim(const Image& a, const Image& b, std::span<const Region> regions) {
    if (a.width != b.width || a.height != b.height)
        throw InputError("", fmt::format("the pictures are {} x {} and {} x {} pixels; only equal sizes can be compared", a.width,
                                         a.height, b.width, b.height));
    std::vector<Region> seen;
    Rect box{a.width, a.height, 0, 0};  // of all windows' middles
    for (const Region& region : regions) {
        seen.push_back(middles(region, a));
        const Rect r = seen.back().bounds();
        if (r.x0 < r.x1) box = {std::min(box.x0, r.x0), std::min(box.y0, r.y0), std::max(box.x1, r.x1), std::max(box.y1, r.y1)};
    }
    std::vector<std::vector<double>> sums(regions.size(), std::vector<double>(std::size_t(std::max(box.y1 - box.y0, 0)), 0.0));
    constexpr int band_rows = 64;
    tbb::parallel_for(0, (std::max(box.y1 - box.y0, 0) + band_rows - 1) / band_rows, [&](int band) {
        const int begin = box.y0 + band * band_rows, end = std::min(begin + band_rows, box.y1);
        Rows rows(a, b, {box.x0 - border, 0, box.x1 + border, 0});
        std::vector<double> values;
        for (int row = begin - border; row < end + border; ++row) {
            rows.load(row);
            const int middle = row - border;
            if (middle < begin) continue;
            rows.windows(middle, values);
            for (std::size_t k = 0; k < seen.size(); ++k) {
                const int n = middle - seen[k].top;
                if (n < 0 || n >= int(seen[k].rows.size())) continue;
                const Region::Row r = seen[k].rows[std::size_t(n)];
                double sum = 0;
                for (int x = r.from; x < r.to; ++x) sum += values[std::size_t(x - box.x0)];
                sums[k][std::size_t(middle - box.y0)] = sum;
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
