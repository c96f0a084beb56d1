#include "analysis/white_lines.h"

#include "analysis/fourier.h"
#include "model/colour.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int lines_a_square = 8;

}  // namespace

double blackman(double u) { return 1 - (0.5 * std::cos(2 * pi * u) - 0.08 * std::cos(4 * pi * u)) / 0.42; }

// splitmix64 (Steele, Lea, Flood 2014)
double counted_random(std::uint64_t counter) {
    std::uint64_t z = counter * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

WhiteSeen::WhiteSeen(const Display& d, const Geometry& green, const ChannelWeights& weights)
    : panel_(d.panel), vertex_plane_(green.vertex_plane_mm) {
    if (!disperses(d)) {
        paths_.push_back({EyeRays(d, green), {d.panel, weights}});
        return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        if (weights[c] == 0) continue;
        ChannelWeights own{};
        own[c] = weights[c];
        paths_.push_back({EyeRays(d, resolve(d, d.panel.wavelengths_nm[c])), {d.panel, own}});
    }
}

WhiteSeen::End WhiteSeen::end(std::size_t path, const Vec3d& eye, double x, double y, double a, double b) const {
    const Sight sight = paths_[path].rays.look_through(eye, {x, y, vertex_plane_}, a, b);
    if (!(sight.light > 0)) return {};
    return {sight.x / panel_.pixel_pitch_mm + 0.5 * double(panel_.pixels[0]),
            0.5 * double(panel_.pixels[1]) - sight.y / panel_.pixel_pitch_mm, sight.light};
}

WhiteLight WhiteSeen::light(const Vec3d& eye, double x, double y, double a, double b) const {
    WhiteLight light;
    for (std::size_t path = 0; path < paths(); ++path) {
        const End at = end(path, eye, x, y, a, b);
        if (!(at.light > 0)) continue;
        light.plain += at.light * white(path).mean();
        light.seen += at.light * white(path).at(at.column, at.row);
    }
    return light;
}

WhiteLines::WhiteLines(const WhiteSeen& screen, std::int64_t seed, const Vec3d& eye, const Window& window, Parts& parts)
    : window_(window) {
    const auto weights = [](int count) {
        std::vector<double> all;
        for (int k = 0; k < count; ++k) all.push_back(blackman((k + 0.5) / count));
        return all;
    };
    const std::vector<double> across = weights(window.columns), up = weights(window.rows);
    const auto columns = std::size_t(window.columns), rows = std::size_t(window.rows), squares = columns * rows;
    change_.resize(squares);
    std::vector<double> light(rows), noise(rows);
    parts.run(window.rows, [&](int part) {
        const auto row = std::size_t(part);
        for (std::size_t n = 0; n < lines_a_square; ++n)
            for (std::size_t column = 0; column < columns; ++column) {
                const std::size_t square = row * columns + column;
                const auto random = [&](std::uint64_t k) {
                    return counted_random((std::uint64_t(seed) << 32) + 4 * (n * squares + square) + k + 1);
                };
                const double x = (double(column) + random(0) - 0.5 * window.columns) * window.square_mm,
                             y = (double(row) + random(1) - 0.5 * window.rows) * window.square_mm;
                const WhiteLight found = screen.light(eye, x, y, 2 * random(2) - 1, 2 * random(3) - 1);
                const double weight = across[column] * up[row], change = weight * (found.seen - found.plain);
                change_[square] += change / lines_a_square;
                light[row] += weight * found.plain;
                noise[row] += change * change;
            }
    });
    double sum = 0, of_squares = 0;
    for (std::size_t row = 0; row < rows; ++row) sum += light[row], of_squares += noise[row];
    const double lines = double(squares) * lines_a_square;
    mean_ = sum / lines;
    noise_ = std::sqrt(of_squares) / lines / mean_;
}

}  // namespace lfdsim
