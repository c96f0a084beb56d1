#include "engine/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace lfdsim {

namespace {

constexpr int kSide = 16, kGroup = 4;
constexpr std::int64_t kMostPoints = 1 << 20;  // a pixel
constexpr std::uint32_t kPointsAtOnce = 16;
// The first step is a wide one: 1 and 2 strata, or 2 and 4, may have the same cuts, on the lenses' borders, and then show no error.
constexpr int kStrata[] = {1, 4, 8, 16, 32, kMostStrata - 2};
using Picture = std::array<float, kSide * kSide * 3>;

/// A block of the frame, whole even where a crop cuts through it, so that no pixel depends on the crop.
class Block {
  public:
    Block(Kernel kernel, const Tile& of, int x0, int y0, const Job& job) : kernel_(kernel), tile_(of), view_(*of.view), job_(job) {
        tile_.view = &view_;
        tile_.crop_x = tile_.x0 = x0;
        tile_.crop_y = tile_.y0 = y0;
        tile_.crop_width = kSide;
        tile_.x1 = std::min(x0 + kSide, view_.width);
        tile_.y1 = std::min(y0 + kSide, view_.height);
    }
    Picture render(int strata, std::uint32_t points, std::uint64_t repetition) {
        Picture picture{};
        tile_.out = picture.data();
        tile_.strata = strata;
        tile_.samples = points;
        view_.seed = seed_ + repetition * 0x9e3779b97f4a7c15u;
        kernel_(tile_);
        samples += std::int64_t(strata > 0 ? strata * strata : int(points)) * (tile_.x1 - tile_.x0) * (tile_.y1 - tile_.y0);
        return picture;
    }
    /// Takes the squared error of each number to the root of its group's mean; the largest of all groups.
    double pool(Picture& squares) const {
        double worst = 0;
        for (int y = tile_.y0; y < tile_.y1; y += kGroup) {
            for (int x = tile_.x0; x < tile_.x1; x += kGroup) {
                const int x1 = std::min(x + kGroup, tile_.x1), y1 = std::min(y + kGroup, tile_.y1);
                double all = 0;
                for (int c = 0; c < 3; ++c) {
                    double sum = 0;
                    each(x, y, x1, y1, c, squares, [&](float& v) { sum += v; });
                    sum /= (x1 - x) * (y1 - y);
                    each(x, y, x1, y1, c, squares, [&](float& v) { v = float(std::sqrt(sum)); });
                    all += sum / 3;
                }
                worst = std::max(worst, std::sqrt(all));
            }
        }
        return worst;
    }
    bool cancelled() const { return job_.cancelled(); }
    std::int64_t samples = 0;

  private:
    template <class Visit>
    void each(int x0, int y0, int x1, int y1, int c, Picture& p, Visit visit) const {
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) visit(p[std::size_t(((y - tile_.y0) * kSide + x - tile_.x0) * 3 + c)]);
    }

    Kernel kernel_;
    Tile tile_;
    optics::View view_;
    const Job& job_;
    std::uint64_t seed_ = view_.seed;
};

void refine_filtered(Block& block, double target, Picture& picture, Picture& error) {
    picture = block.render(kStrata[0], 0, 0);
    for (std::size_t step = 1; step < std::size(kStrata); ++step) {
        const Picture finer = block.render(kStrata[step], 0, 0);
        for (std::size_t i = 0; i < finer.size(); ++i) error[i] = (finer[i] - picture[i]) * (finer[i] - picture[i]);
        picture = finer;
        if (block.pool(error) <= target || block.cancelled()) return;
    }
}

void refine_points(Block& block, double target, Picture& picture, Picture& error) {
    std::array<double, kSide * kSide * 3> sum{}, squares{};
    for (std::int64_t repetitions = 0, wanted = 8;; wanted *= 2) {
        for (; repetitions < wanted; ++repetitions) {
            if (block.cancelled()) return;
            const Picture one = block.render(0, kPointsAtOnce, std::uint64_t(repetitions));
            for (std::size_t i = 0; i < one.size(); ++i) {
                sum[i] += one[i];
                squares[i] += double(one[i]) * one[i];
            }
        }
        const double n = double(repetitions);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            picture[i] = float(sum[i] / n);
            error[i] = float(std::max(squares[i] - sum[i] * sum[i] / n, 0.0) / (n * (n - 1)));
        }
        if (block.pool(error) <= target || 2 * wanted * kPointsAtOnce > kMostPoints) return;
    }
}

}  // namespace

std::optional<std::int64_t> refine_tile(Kernel kernel, const Tile& tile, double target, float* error, const Job& job) {
    std::int64_t samples = 0;
    for (int y0 = tile.y0 / kSide * kSide; y0 < tile.y1; y0 += kSide) {
        for (int x0 = tile.x0 / kSide * kSide; x0 < tile.x1; x0 += kSide) {
            Block block(kernel, tile, x0, y0, job);
            Picture picture{}, errors{};
            if (tile.strata > 0)
                refine_filtered(block, target, picture, errors);
            else
                refine_points(block, target, picture, errors);
            if (job.cancelled()) return {};
            samples += block.samples;
            for (int y = std::max(y0, tile.y0); y < std::min(y0 + kSide, tile.y1); ++y) {
                for (int x = std::max(x0, tile.x0); x < std::min(x0 + kSide, tile.x1); ++x) {
                    const std::size_t from = std::size_t((y - y0) * kSide + x - x0) * 3,
                                      to = (std::size_t(y - tile.crop_y) * std::size_t(tile.crop_width) +
                                            std::size_t(x - tile.crop_x)) *
                                           3;
                    for (std::size_t c = 0; c < 3; ++c) {
                        tile.out[to + c] = picture[from + c];
                        error[to + c] = errors[from + c];
                    }
                }
            }
        }
    }
    return samples;
}

}  // namespace lfdsim
