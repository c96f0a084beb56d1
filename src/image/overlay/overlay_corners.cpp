#include "base/constants.h"
#include "image/compare/blur.h"
#include "image/overlay/overlay.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

// Gauss-Newton steps over the eight coordinates of the corners: docs/measures.md, "Overlay". The photograph is resampled to the
// view's grid once; from there on it moves in that grid. Both pictures are blurred, at first by the largest displacement of a
// corner, then less and less.
namespace lfdsim {
namespace {

constexpr int unknowns = 8;  // x and y of the four corners, in the order of Corners
using Vector = std::array<double, unknowns>;
using NormalMatrix = std::array<Vector, unknowns>;

/// Solves a x = b by Cholesky's factors; `a` is symmetric and positive definite.
Vector solve(NormalMatrix a, Vector b) {
    for (std::size_t j = 0; j < unknowns; ++j)
        for (std::size_t i = j; i < unknowns; ++i) {
            for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
            a[i][j] = i == j ? std::sqrt(a[j][j]) : a[i][j] / a[j][j];
        }
    for (std::size_t i = 0; i < unknowns; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (std::size_t i = unknowns; i-- > 0;) {
        for (std::size_t k = i + 1; k < unknowns; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return b;
}

double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t k = 0; k < unknowns; ++k) sum += a[k] * b[k];
    return sum;
}

Corners moved(Corners corners, const Vector& by) {
    for (std::size_t k = 0; k < unknowns; ++k) corners[k / 2][k % 2] += by[k];
    return corners;
}

/// The fit at one blur: both pictures, the means of their channels in the view's light, blurred alike.
class BlurLevel {
  public:
    BlurLevel(std::vector<float> photograph, std::vector<float> view, const Aligned& aligned, const Corners& corners, double sigma)
        : photograph_(std::move(photograph)),
          view_(std::move(view)),
          aligned_(aligned),
          corners_(corners),
          width_(aligned.light.width),
          height_(aligned.light.height),
          border_(int(std::ceil(3 * sigma)) + 1) {
        blur(photograph_, width_, height_, 1, sigma);
        blur(view_, width_, height_, 1, sigma);
        constexpr double enough = 5e5;  // pixels that a step uses; of larger screens only every stride_-th one along each side
        stride_ = std::max(1, int(std::sqrt(double(aligned.screen.pixels()) / enough)));
    }

    /// The normal equations J^T J step = J^T residual, J the derivatives of the photograph's light by the unknowns.
    struct Sums {
        NormalMatrix normal{};
        Vector right{};
        double squares = 0, pixels = 0, light = 0;  // sum of squared residuals; number of pixels; sum of squared light of the view
    };
    /// Returns the normal equations of a step from corners that have moved `by` in the view's grid. Rows are summed in order, so
    /// that the number of threads changes no bit.
    Sums sums(const Vector& by) const {
        const Homography now(corners_, moved(corners_, by));
        std::vector<Homography> tried;  // each with one coordinate moved one pixel further, for the derivatives
        for (std::size_t k = 0; k < unknowns; ++k) {
            Vector further = by;
            further[k] += 1;
            tried.emplace_back(corners_, moved(corners_, further));
        }
        std::vector<Sums> of_rows;
        of_rows.resize(std::size_t(height_));
        tbb::parallel_for(0, (height_ + stride_ - 1) / stride_, [&](int k) {
            const int y = k * stride_;
            for (int x = 0; x < width_; x += stride_)
                if (counts(x, y)) add(of_rows[std::size_t(y)], x, y, now, tried);
        });
        Sums total;
        for (const Sums& row : of_rows) {
            for (std::size_t i = 0; i < unknowns; ++i) {
                for (std::size_t j = 0; j < unknowns; ++j) total.normal[i][j] += row.normal[i][j];
                total.right[i] += row.right[i];
            }
            total.squares += row.squares;
            total.pixels += row.pixels;
            total.light += row.light;
        }
        return total;
    }

    double pixels_per_sample() const { return double(stride_) * stride_; }

  private:
    bool on_screen(int x, int y) const {
        const int k = y - aligned_.screen.top;
        if (k < 0 || k >= int(aligned_.screen.rows.size())) return false;
        const Region::Row& row = aligned_.screen.rows[std::size_t(k)];
        return x >= row.from && x < row.to;
    }
    /// Whether a pixel is used: not saturated, and so far from the screen's border that the black outside does not blur in. The
    /// screen is convex, so the corners of a square decide.
    bool counts(int x, int y) const {
        for (const int i : {-border_, border_})
            for (const int j : {-border_, border_})
                if (!on_screen(x + i, y + j)) return false;
        return !aligned_.saturated[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
    }
    /// Adds one pixel of the view: the photograph's light where `now` maps it, by bilinear interpolation, and its derivatives.
    void add(Sums& sums, int x, int y, const Homography& now, const std::vector<Homography>& tried) const {
        const Point p = now(x + 0.5, y + 0.5);
        const double column = p[0] - 0.5, row = p[1] - 0.5;
        if (!(column >= 0 && row >= 0 && column < width_ - 1 && row < height_ - 1)) return;
        const std::size_t at = std::size_t(row) * std::size_t(width_) + std::size_t(column), below = at + std::size_t(width_);
        const double u = column - std::floor(column), v = row - std::floor(row);
        const double a = photograph_[at], b = photograph_[at + 1], c = photograph_[below], d = photograph_[below + 1];
        const double by_x = (1 - v) * (b - a) + v * (d - c), by_y = (1 - u) * (c - a) + u * (d - b);
        const double light = (1 - v) * (a + u * (b - a)) + v * (c + u * (d - c));
        const double wanted = view_[std::size_t(y) * std::size_t(width_) + std::size_t(x)], residual = wanted - light;
        Vector slope;
        for (std::size_t k = 0; k < unknowns; ++k) {
            const Point q = tried[k](x + 0.5, y + 0.5);
            slope[k] = by_x * (q[0] - p[0]) + by_y * (q[1] - p[1]);
        }
        for (std::size_t i = 0; i < unknowns; ++i) {
            for (std::size_t j = 0; j < unknowns; ++j) sums.normal[i][j] += slope[i] * slope[j];
            sums.right[i] += slope[i] * residual;
        }
        sums.squares += residual * residual;
        sums.light += wanted * wanted;
        ++sums.pixels;
    }

    std::vector<float> photograph_, view_;  // one value a pixel of the view
    const Aligned& aligned_;
    const Corners& corners_;             // in the view
    const int width_, height_, border_;  // pixels; border_: beyond the blur's reach
    int stride_;
};

}  // namespace

Corners fit_corners(const Image& view, const Corners& in_view, const Aligned& photograph, const std::array<double, 3>& gains,
                    const Corners& in_photograph, double most_px, const Job& job) {
    // The means of the channels of both pictures, the photograph's divided by the gains.
    const Homography to_photograph(in_view, in_photograph), to_view(in_photograph, in_view);
    std::vector<float> light(view.rgb.size() / 3), simulated(light.size());
    for (std::size_t k = 0; k < photograph.screen.rows.size(); ++k)
        for (int x = photograph.screen.rows[k].from; x < photograph.screen.rows[k].to; ++x) {
            const int y = photograph.screen.top + int(k);
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t i = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
                light[i] += float(photograph.light.at(x, y)[c] / (3 * gains[c]));
                simulated[i] += view.at(x, y)[c] / 3;
            }
        }
    const auto limited = [&](const Vector& by) {  // shortened so that no corner moves by more than most_px of the photograph
        Vector result{};
        for (std::size_t k = 0; k < 4; ++k) {
            const Point from = in_photograph[k], to = to_photograph(in_view[k][0] + by[2 * k], in_view[k][1] + by[2 * k + 1]);
            const double dx = to[0] - from[0], dy = to[1] - from[1], share = std::min(1.0, most_px / std::hypot(dx, dy));
            const Point back = to_view(from[0] + share * dx, from[1] + share * dy);
            result[2 * k] = back[0] - in_view[k][0];
            result[2 * k + 1] = back[1] - in_view[k][1];
        }
        return result;
    };

    // most_px in the view's grid, by the mean scale at the screen's middle, and the prior's standard deviation.
    const auto [along_x, along_y] =
        to_photograph.derivatives((in_view[0][0] + in_view[2][0]) / 2, (in_view[0][1] + in_view[2][1]) / 2);
    const double reach = most_px / std::sqrt(std::hypot(along_x[0], along_x[1]) * std::hypot(along_y[0], along_y[1]));
    const double click_px = 0.4 * reach;  // standard deviation of a given corner, in the view's grid
    Vector by{};
    // Level by level of blur, each from the result of the one before it; a level ends when a step does not help or is very small.
    for (double sigma = std::max(1.0, reach); sigma >= 1 && !job.cancelled(); sigma /= 2) {
        const BlurLevel level(light, simulated, photograph, in_view, sigma);
        BlurLevel::Sums here = level.sums(by);
        if (here.pixels == 0) break;
        // After the blur the noise of neighbours is correlated: 4 pi sigma^2 pixels count as one. `known` is the prior's weight in
        // the normal equations, the variance of a residual over that of a corner.
        const double alike = std::max(1.0, 4 * pi * sigma * sigma / level.pixels_per_sample());
        const double known = std::max(here.squares, 1e-12 * here.light) / here.pixels * alike / (click_px * click_px);
        const auto cost = [&](const BlurLevel::Sums& sums, const Vector& moved_by) {
            return sums.squares / sums.pixels + known / here.pixels * dot(moved_by, moved_by);
        };
        for (int step = 0; step < 20 && !job.cancelled(); ++step) {
            for (std::size_t k = 0; k < unknowns; ++k) {
                here.normal[k][k] += known;
                here.right[k] -= known * by[k];
            }
            if (!(known > 0)) break;  // black
            Vector next = solve(here.normal, here.right);
            for (std::size_t k = 0; k < unknowns; ++k) next[k] += by[k];
            next = limited(next);
            const BlurLevel::Sums there = level.sums(next);
            if (!(cost(there, next) < cost(here, by))) break;
            double most = 0;
            for (std::size_t k = 0; k < unknowns; ++k) most = std::max(most, std::abs(next[k] - by[k]));
            by = next;
            here = there;
            if (most < 0.002) break;
        }
    }
    Corners result;
    for (std::size_t k = 0; k < 4; ++k) result[k] = to_photograph(in_view[k][0] + by[2 * k], in_view[k][1] + by[2 * k + 1]);
    return result;
}

}  // namespace lfdsim
