#include "content/pictures/view_order.h"

#include "image/scaled.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

constexpr int block_side = 16, furthest_move = 16, most_columns = 512, enough_blocks = 12;  // pixels; blocks that must agree

/// A picture's brightness.
struct Grey {
    int width, height;
    std::vector<float> light;
    float at(int x, int y) const { return light[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Returns the approximate perceived brightness: the square root of the mean of the channels.
Grey grey(const Image& picture) {
    const Image small = reduced(picture, most_columns);
    Grey grey{small.width, small.height, {}};
    for (std::size_t i = 0; i < small.rgb.size(); i += 3)
        grey.light.push_back(std::sqrt(std::max(0.f, (small.rgb[i] + small.rgb[i + 1] + small.rgb[i + 2]) / 3)));
    return grey;
}

/// Returns how far a block moves from one picture to another along x or y, pixels to the right or down, by the least mean square
/// difference with the minimum of a parabola; nothing if the match is not distinct.
std::optional<double> move_of(const Grey& from, const Grey& to, int x0, int y0, bool along_x) {
    std::vector<double> difference;  // mean of squares, for each move
    for (int move = -furthest_move; move <= furthest_move; ++move) {
        double sum = 0;
        for (int y = y0; y < y0 + block_side; ++y)
            for (int x = x0; x < x0 + block_side; ++x) {
                const double d = double(to.at(along_x ? x + move : x, along_x ? y : y + move)) - double(from.at(x, y));
                sum += d * d;
            }
        difference.push_back(sum / (block_side * block_side));
    }
    const auto best = std::min_element(difference.begin(), difference.end());
    if (best == difference.begin() || best == difference.end() - 1) return {};
    // Distinct: all moves that are not next to the best are much worse, and by more than the rounding of 8-bit codes.
    double second = INFINITY;
    for (auto other = difference.begin(); other != difference.end(); ++other)
        if (std::abs(other - best) > 2) second = std::min(second, *other);
    if (!(second > 4 * *best + 1e-4)) return {};
    const double a = best[-1], b = best[0], c = best[1], bend = a - 2 * b + c;
    return double(best - difference.begin()) - furthest_move + (bend > 0 ? 0.5 * (a - c) / bend : 0);
}

/// The correlation of pairs of moves that should have the same sign.
class Agreement {
  public:
    /// Adds a pair of moves, pixels.
    void add(double a, double b) {
        ++count_;
        aa_ += a * a;
        bb_ += b * b;
        ab_ += a * b;
    }
    /// Returns whether enough pairs certainly have opposite signs.
    bool opposite() const {
        return count_ >= enough_blocks && std::min(aa_, bb_) >= 0.25 * count_ && ab_ < -0.8 * std::sqrt(aa_ * bb_);
    }

  private:
    int count_ = 0;
    double aa_ = 0, bb_ = 0, ab_ = 0;
};

}  // namespace

OrderDoubt order_doubt(const ViewGrid& grid, const std::vector<Image>& views, const std::vector<KappaMap>& maps) {
    int column = grid.columns / 2, row = grid.rows / 2;
    const auto index = [&](int i, int j) { return std::size_t(j) * std::size_t(grid.columns) + std::size_t(i); };
    const auto mapped = [&](std::size_t k) { return k < maps.size() && !maps[k].kappa.empty(); };
    if (!mapped(index(column, row)))
        for (std::size_t k = 0; k < maps.size(); ++k)
            if (mapped(k)) column = int(k % std::size_t(grid.columns)), row = int(k / std::size_t(grid.columns));
    const std::size_t base = index(column, row);
    const Grey middle = grey(views[base]);
    struct Neighbour {
        Grey picture;
        double step_pixels;  // move of a point at kappa 1, to the right or down
    };
    std::optional<Neighbour> aside, below;
    if (grid.columns > 1) {
        const int i = column + 1 < grid.columns ? column + 1 : column - 1;
        aside = {grey(views[index(i, row)]), (grid.camera(column, row)[0] - grid.camera(i, row)[0]) * middle.width / grid.width_mm};
    }
    if (grid.rows > 1) {
        const int j = row + 1 < grid.rows ? row + 1 : row - 1;
        below = {grey(views[index(column, j)]),
                 (grid.camera(column, j)[1] - grid.camera(column, row)[1]) * middle.height / grid.height_mm};
    }
    // Each block's moves to both neighbours, compared with each other and with the depth map
    Agreement axes, with_depth;
    const int margin = furthest_move;
    for (int y = margin; y + block_side + margin <= middle.height; y += block_side)
        for (int x = margin; x + block_side + margin <= middle.width; x += block_side) {
            const auto moved = [&](const std::optional<Neighbour>& to, bool along_x) -> std::optional<double> {
                return to ? move_of(middle, to->picture, x, y, along_x) : std::nullopt;
            };
            const std::optional<double> across = moved(aside, true), down = moved(below, false);
            // Cameras one step to the right and one step down move a point by equal amounts, relative to their steps.
            if (across && down)
                axes.add(*across, *down * std::abs(aside->step_pixels / below->step_pixels) *
                                      (aside->step_pixels * below->step_pixels < 0 ? -1 : 1));
            if (!mapped(base) || !(across || down)) continue;
            const KappaMap& map = maps[base];
            const int map_x = (2 * x + block_side) * map.width / (2 * middle.width),
                      map_y = (2 * y + block_side) * map.height / (2 * middle.height);
            const double kappa = double(map.at(std::min(map_x, map.width - 1), std::min(map_y, map.height - 1)));
            if (!std::isfinite(kappa)) continue;
            if (across) with_depth.add(*across, kappa * aside->step_pixels);
            if (down) with_depth.add(*down, kappa * below->step_pixels);
        }
    return {axes.opposite(), with_depth.opposite()};
}

}  // namespace lfdsim
