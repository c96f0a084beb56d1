#include "analysis/white_lines.h"

#include "analysis/fourier.h"
#include "model/colour.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
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

WhiteLines::Line WhiteLines::line(int set, int column, int row) const {
    const std::uint64_t square =
        (std::uint64_t(set) * std::uint64_t(window_.rows) + std::uint64_t(row)) * std::uint64_t(window_.columns) +
        std::uint64_t(column);
    const auto random = [&](std::uint64_t n) { return counted_random(seed_ + 4 * square + n + 1); };
    return {(column + random(0) - 0.5 * window_.columns) * window_.square_mm,
            (row + random(1) - 0.5 * window_.rows) * window_.square_mm, 2 * random(2) - 1, 2 * random(3) - 1};
}

WhiteLines::WhiteLines(const WhiteSeen& screen, std::int64_t seed, const Vec3d& eye, const Window& window, Parts& parts)
    : window_(window), seed_(std::uint64_t(seed) << 32) {
    const auto weights = [](int count) {
        std::vector<double> all;
        for (int k = 0; k < count; ++k) all.push_back(blackman((k + 0.5) / count));
        return all;
    };
    across_ = weights(window.columns);
    up_ = weights(window.rows);
    const std::size_t squares = std::size_t(window.columns) * std::size_t(window.rows);
    change_.resize(squares * independent_sets);
    std::vector<Sums> light(std::size_t(window.rows)), noise(light);
    parts.run(window.rows, [&](int row) {
        for (int set = 0; set < independent_sets; ++set)
            for (int column = 0; column < window.columns; ++column) {
                const Line at = line(set, column, row);
                const WhiteLight found = screen.light(eye, at.x, at.y, at.a, at.b);
                const double change = found.seen - found.plain;
                const double weight = across_[std::size_t(column)] * up_[std::size_t(row)];
                change_[std::size_t(set) * squares + std::size_t(row) * std::size_t(window.columns) + std::size_t(column)] =
                    float(change);
                light[std::size_t(row)][std::size_t(set)] += weight * found.plain;
                noise[std::size_t(row)][std::size_t(set)] += weight * weight * change * change;
            }
    });
    for (std::size_t row = 0; row < light.size(); ++row)
        for (std::size_t set = 0; set < independent_sets; ++set) {
            light_[set] += light[row][set] / double(squares);
            squares_[set] += noise[row][set] / double(squares * squares);
        }
}

double WhiteLines::mean() const { return total(light_) / independent_sets; }

double WhiteLines::noise() const { return std::sqrt(total(squares_)) / independent_sets / mean(); }

std::vector<double> WhiteLines::weighted_change() const {
    const std::size_t squares = std::size_t(window_.columns) * std::size_t(window_.rows);
    std::vector<double> all(squares);
    for (std::size_t k = 0; k < squares; ++k) {
        double sum = 0;
        for (std::size_t set = 0; set < independent_sets; ++set) sum += change_[set * squares + k];
        all[k] = sum / independent_sets * across_[k % std::size_t(window_.columns)] * up_[k / std::size_t(window_.columns)];
    }
    return all;
}

WaveSums WhiteLines::near(const Frequency& f, Parts& parts) const {
    WaveSums result(f, window_.width_mm(), window_.height_mm());
    const std::size_t squares = std::size_t(window_.columns) * std::size_t(window_.rows);
    parts.run(WaveSums::side, [&](int j) {  // blocks of row j
        for (int row = j * window_.rows / WaveSums::side; row < (j + 1) * window_.rows / WaveSums::side; ++row)
            for (int set = 0; set < independent_sets; ++set)
                for (int column = 0; column < window_.columns; ++column) {
                    const std::size_t square = std::size_t(row) * std::size_t(window_.columns) + std::size_t(column);
                    const double change = double(change_[std::size_t(set) * squares + square]);
                    if (change == 0) continue;
                    const Line at = line(set, column, row);
                    result.add(set, column * WaveSums::side / window_.columns, j,
                               std::polar(change * across_[std::size_t(column)] * up_[std::size_t(row)] / double(squares),
                                          -2 * pi * (f[0] * at.x + f[1] * at.y)));
                }
    });
    return result;
}

}  // namespace lfdsim
