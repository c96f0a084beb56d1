#include "analysis/moire/white_lines.h"

#include "analysis/resolution/fourier.h"
#include "base/constants.h"
#include "display/colour.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int lines_a_square = 8;

}  // namespace

// w(u) = 0.42 - 0.5 cos(2 pi u) + 0.08 cos(4 pi u), over its mean 0.42
double blackman(double u) { return 1 - (0.5 * std::cos(2 * pi * u) - 0.08 * std::cos(4 * pi * u)) / 0.42; }

// splitmix64 (Steele, Lea, Flood 2014)
double counted_random(std::uint64_t counter) {
    std::uint64_t z = counter * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

WhiteSeen::WhiteSeen(const Display& d, const Geometry& green, const std::vector<ChannelWeights>& mixtures)
    : panel_(d.panel), vertex_plane_(green.vertex_plane_mm), mixtures_(mixtures.size()) {
    if (!disperses(d)) {
        ChannelPath& path = paths_.emplace_back(ChannelPath{EyeRays(d, green), {}});
        for (const ChannelWeights& weights : mixtures) path.white.emplace_back(WhitePanel(d.panel, weights));
        return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        if (std::ranges::all_of(mixtures, [&](const ChannelWeights& weights) { return weights[c] == 0; })) continue;
        ChannelPath& path = paths_.emplace_back(ChannelPath{EyeRays(d, resolve(d, d.panel.wavelengths_nm[c])), {}});
        for (const ChannelWeights& weights : mixtures) {
            ChannelWeights own{};
            own[c] = weights[c];
            path.white.push_back(own[c] == 0 ? std::nullopt : std::optional(WhitePanel(d.panel, own)));
        }
    }
}

WhiteSeen::End WhiteSeen::end(std::size_t path, const Vec3d& eye, double x, double y, double a, double b) const {
    const Sight sight = paths_[path].rays.look_through(eye, {x, y, vertex_plane_}, a, b);
    if (!(sight.light > 0)) return {};
    const auto [column, row] = pixel_place(panel_, sight);
    return {column, row, sight.light};
}

void WhiteSeen::look(const Vec3d& eye, double x, double y, double a, double b, std::vector<WhiteLight>& light) const {
    light.assign(mixtures_, {});
    for (std::size_t path = 0; path < paths(); ++path) {
        const End at = end(path, eye, x, y, a, b);
        if (!(at.light > 0)) continue;
        for (std::size_t m = 0; m < mixtures_; ++m)
            if (const WhitePanel* panel = white(path, m)) {
                light[m].plain += at.light * panel->mean();
                light[m].seen += at.light * panel->at(at.column, at.row);
            }
    }
}

std::vector<WhiteLines> WhiteLines::of(const WhiteSeen& screen, std::int64_t seed, const Vec3d& eye, const Window& window,
                                       Parts& parts) {
    const auto weights = [](int count) {
        std::vector<double> all;
        for (int k = 0; k < count; ++k) all.push_back(blackman((k + 0.5) / count));
        return all;
    };
    // Squares have the window's weight at their middle.
    const std::vector<double> across = weights(window.columns), up = weights(window.rows);
    const auto columns = std::size_t(window.columns), rows = std::size_t(window.rows), squares = columns * rows;
    struct RowSums {
        double light = 0, noise = 0;
    };
    std::vector<WhiteLines> all(screen.mixtures(), WhiteLines(window));
    for (WhiteLines& lines : all) lines.change_.resize(squares);
    std::vector<std::vector<RowSums>> by_row(rows, std::vector<RowSums>(screen.mixtures()));
    parts.run(window.rows, [&](int part) {
        const auto row = std::size_t(part);
        std::vector<WhiteLight> found;
        for (std::size_t n = 0; n < lines_a_square; ++n)
            for (std::size_t column = 0; column < columns; ++column) {
                const std::size_t square = row * columns + column;
                const auto random = [&](std::uint64_t k) {
                    return counted_random((std::uint64_t(seed) << 32) + 4 * (n * squares + square) + k + 1);
                };
                const double x = (double(column) + random(0) - 0.5 * window.columns) * window.square_mm,
                             y = (double(row) + random(1) - 0.5 * window.rows) * window.square_mm;
                screen.look(eye, x, y, 2 * random(2) - 1, 2 * random(3) - 1, found);
                const double weight = across[column] * up[row];
                for (std::size_t m = 0; m < found.size(); ++m) {
                    const double change = weight * (found[m].seen - found[m].plain);
                    all[m].change_[square] += change / lines_a_square;
                    by_row[row][m].light += weight * found[m].plain;
                    by_row[row][m].noise += change * change;
                }
            }
    });
    const double lines = double(squares) * lines_a_square;
    for (std::size_t m = 0; m < all.size(); ++m) {
        double sum = 0, of_squares = 0;
        for (const std::vector<RowSums>& row : by_row) sum += row[m].light, of_squares += row[m].noise;
        all[m].mean_ = sum / lines;
        all[m].noise_ = std::sqrt(of_squares) / lines / all[m].mean_;
    }
    return all;
}

}  // namespace lfdsim
