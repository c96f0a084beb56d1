#include "engine/estimator/refine.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lfdsim {

namespace {

constexpr int group_side = 4;                  // pixels whose errors are pooled
constexpr std::int64_t most_points = 1 << 20;  // a pixel
constexpr std::uint32_t points_at_once = 16;   // a pixel, in a repetition

/// The sums of a block's points, which grow from pass to pass, with its picture and its error.
struct BlockSums {
    RefinedBlock at;
    RefinedPicture picture{}, error{};
    std::array<double, refined_side * refined_side * 3> sum{}, squares{};  // over the repetitions' pictures
};

/// Refines blocks together: all that are not good enough yet take the next repetition.
class Refinement {
  public:
    Refinement(BlockPainter& painter, const Tile& tile, double target, const Job& job)
        : painter_(painter), view_(*tile.view), target_(target), job_(job) {}

    std::vector<BlockSums> run(const std::vector<RefinedBlock>& of) {
        for (const RefinedBlock& at : of) blocks_.push_back({at});
        for (BlockSums& b : blocks_) open_.push_back(&b);
        refine();
        return std::move(blocks_);
    }
    std::int64_t samples = 0;

  private:
    /// Renders a repetition of the open blocks. Seeds are far from each other and from those that users count up (golden ratio).
    void paint(std::uint64_t repetition) {
        std::vector<RefinedBlock> at;
        for (const BlockSums* b : open_) at.push_back(b->at);
        pictures_.assign(at.size(), {});
        painter_.paint(at, points_at_once, view_.seed + repetition * 0x9e3779b97f4a7c15u, pictures_);
        for (const RefinedBlock& b : at) samples += std::int64_t(points_at_once) * (right(b) - b.x) * (bottom(b) - b.y);
    }

    void refine() {
        std::int64_t repetitions = 0;
        for (std::int64_t wanted = 8; !open_.empty(); wanted *= 2) {
            for (; repetitions < wanted; ++repetitions) {
                if (job_.cancelled()) return;
                paint(std::uint64_t(repetitions));
                for (std::size_t k = 0; k < open_.size(); ++k) {
                    BlockSums& b = *open_[k];
                    for (std::size_t i = 0; i < b.sum.size(); ++i) {
                        const float one = pictures_[k][i];
                        b.sum[i] += one;
                        b.squares[i] += double(one) * one;
                    }
                }
            }
            // The mean of n repetitions, and its squared standard error: (sum of squares - (sum)^2/n)/(n (n - 1))
            const double n = double(repetitions);
            for (BlockSums* b : open_) {
                for (std::size_t i = 0; i < b->sum.size(); ++i) {
                    b->picture[i] = float(b->sum[i] / n);
                    b->error[i] = float(std::max(b->squares[i] - b->sum[i] * b->sum[i] / n, 0.0) / (n * (n - 1)));
                }
            }
            close();
            if (2 * wanted * points_at_once > most_points) return;
        }
    }

    /// Turns the squared errors of the open blocks into errors, and closes the blocks that are good enough.
    void close() {
        std::erase_if(open_, [&](BlockSums* b) { return pool(*b) <= target_; });
    }

    /// Replaces each squared error by the root mean square over its group; returns the largest over all groups, colours pooled.
    double pool(BlockSums& b) const {
        double worst = 0;
        for (int y = b.at.y; y < bottom(b.at); y += group_side) {
            for (int x = b.at.x; x < right(b.at); x += group_side) {
                const int x1 = std::min(x + group_side, right(b.at)), y1 = std::min(y + group_side, bottom(b.at));
                double all = 0;
                for (int c = 0; c < 3; ++c) {
                    const auto each = [&](auto visit) {
                        for (int j = y; j < y1; ++j)
                            for (int i = x; i < x1; ++i)
                                visit(b.error[std::size_t(((j - b.at.y) * refined_side + i - b.at.x) * 3 + c)]);
                    };
                    double sum = 0;
                    each([&](float& v) { sum += v; });
                    sum /= (x1 - x) * (y1 - y);
                    each([&](float& v) { v = float(std::sqrt(sum)); });
                    all += sum / 3;
                }
                worst = std::max(worst, std::sqrt(all));
            }
        }
        return worst;
    }

    int right(const RefinedBlock& b) const { return std::min(b.x + refined_side, view_.width); }
    int bottom(const RefinedBlock& b) const { return std::min(b.y + refined_side, view_.height); }

    BlockPainter& painter_;
    const optics::RayOrigin& view_;
    const double target_;
    const Job& job_;
    std::vector<BlockSums> blocks_;
    std::vector<BlockSums*> open_;
    std::vector<RefinedPicture> pictures_;  // of the open blocks
};

/// Renders blocks with a CPU kernel.
class KernelPainter : public BlockPainter {
  public:
    KernelPainter(Kernel kernel, const Tile& of, const Job& job) : kernel_(kernel), tile_(of), view_(*of.view), job_(job) {
        tile_.view = &view_;
    }
    void paint(const std::vector<RefinedBlock>& blocks, std::uint32_t points, std::uint64_t seed,
               std::vector<RefinedPicture>& pictures) override {
        tile_.crop_width = refined_side;
        tile_.strata = 0;
        tile_.samples = points;
        view_.seed = seed;
        for (std::size_t k = 0; k < blocks.size() && !job_.cancelled(); ++k) {
            tile_.crop_x = tile_.x0 = blocks[k].x;
            tile_.crop_y = tile_.y0 = blocks[k].y;
            tile_.x1 = std::min(blocks[k].x + refined_side, view_.width);
            tile_.y1 = std::min(blocks[k].y + refined_side, view_.height);
            tile_.out = pictures[k].data();
            kernel_(tile_);
        }
    }

  private:
    Kernel kernel_;
    Tile tile_;
    optics::RayOrigin view_;
    const Job& job_;
};

}  // namespace

std::optional<std::int64_t> refine_tile(BlockPainter& painter, const Tile& tile, double target, float* error, const Job& job) {
    std::vector<RefinedBlock> blocks;
    for (int y0 = tile.y0 / refined_side * refined_side; y0 < tile.y1; y0 += refined_side)
        for (int x0 = tile.x0 / refined_side * refined_side; x0 < tile.x1; x0 += refined_side) blocks.push_back({x0, y0});
    Refinement refinement(painter, tile, target, job);
    const std::vector<BlockSums> refined = refinement.run(blocks);
    if (job.cancelled()) return {};
    for (const BlockSums& b : refined) {
        for (int y = std::max(b.at.y, tile.y0); y < std::min(b.at.y + refined_side, tile.y1); ++y) {
            for (int x = std::max(b.at.x, tile.x0); x < std::min(b.at.x + refined_side, tile.x1); ++x) {
                const std::size_t from = std::size_t((y - b.at.y) * refined_side + x - b.at.x) * 3,
                                  to =
                                      (std::size_t(y - tile.crop_y) * std::size_t(tile.crop_width) + std::size_t(x - tile.crop_x)) *
                                      3;
                for (std::size_t c = 0; c < 3; ++c) {
                    tile.out[to + c] = b.picture[from + c];
                    error[to + c] = b.error[from + c];
                }
            }
        }
    }
    return refinement.samples;
}

std::optional<std::int64_t> refine_tile(Kernel kernel, const Tile& tile, double target, float* error, const Job& job) {
    KernelPainter painter(kernel, tile, job);
    return refine_tile(painter, tile, target, error, job);
}

}  // namespace lfdsim
