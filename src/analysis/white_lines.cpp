#include "analysis/white_lines.h"

#include "analysis/fourier.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Blackman's window over [0, 1], 1 in the mean.
double blackman(double u) { return 1 - (0.5 * std::cos(2 * pi * u) - 0.08 * std::cos(4 * pi * u)) / 0.42; }

/// Its transform, for whole periods.
double blackman_wave(double periods) {
    return sinc(periods) + (0.25 * (sinc(periods - 1) + sinc(periods + 1)) + 0.04 * (sinc(periods - 2) + sinc(periods + 2))) / 0.42;
}

/// A number in [0, 1) for each counter (Steele, Lea, Flood 2014: splitmix64).
double counted_random(std::uint64_t counter) {
    std::uint64_t z = counter * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace

WhiteLight WhiteSeen::light(const Vec3d& eye, double x, double y, double a, double b) const {
    const Sight sight = rays.look_through(eye, {x, y, rays.point(0, 0)[2]}, a, b);
    if (!(sight.light > 0)) return {sight.light, 0};
    const double column = sight.x / panel.pixel_pitch_mm + 0.5 * double(panel.pixels[0]),
                 row = 0.5 * double(panel.pixels[1]) - sight.y / panel.pixel_pitch_mm;
    return {sight.light, sight.light * white.at(column, row)};
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

WhiteLines::Near WhiteLines::near(const Frequency& f, Parts& parts) const {
    Near result;
    result.about_ = f;
    result.width_ = window_.width_mm();
    result.height_ = window_.height_mm();
    result.blocks_.resize(std::size_t(Near::side) * Near::side);
    const std::size_t squares = std::size_t(window_.columns) * std::size_t(window_.rows);
    parts.run(Near::side, [&](int j) {  // blocks of row j
        for (int row = j * window_.rows / Near::side; row < (j + 1) * window_.rows / Near::side; ++row)
            for (int set = 0; set < independent_sets; ++set)
                for (int column = 0; column < window_.columns; ++column) {
                    const std::size_t square = std::size_t(row) * std::size_t(window_.columns) + std::size_t(column);
                    const double change = double(change_[std::size_t(set) * squares + square]);
                    if (change == 0) continue;
                    const Line at = line(set, column, row);
                    const std::size_t i = std::size_t(column * Near::side / window_.columns);
                    result.blocks_[std::size_t(j) * Near::side + i][std::size_t(set)] +=
                        std::polar(change * across_[std::size_t(column)] * up_[std::size_t(row)] / double(squares),
                                   -2 * pi * (f[0] * at.x + f[1] * at.y));
                }
    });
    return result;
}

std::complex<double> WhiteLines::Near::wave(const Frequency& f, int without) const {
    const double step_x = (f[0] - about_[0]) * width_ / side, step_y = (f[1] - about_[1]) * height_ / side;  // periods a block
    std::array<std::complex<double>, side> turn_x, turn_y;
    for (int k = 0; k < side; ++k) {
        turn_x[std::size_t(k)] = std::polar(1., -2 * pi * step_x * (k + 0.5 - 0.5 * side));
        turn_y[std::size_t(k)] = std::polar(1., -2 * pi * step_y * (k + 0.5 - 0.5 * side));
    }
    std::complex<double> sum = 0;
    for (std::size_t j = 0; j < side; ++j) {
        std::complex<double> row = 0;
        for (std::size_t i = 0; i < side; ++i)
            for (int set = 0; set < independent_sets; ++set)
                if (set != without) row += blocks_[j * side + i][std::size_t(set)] * turn_x[i];
        sum += row * turn_y[j];
    }
    return sum / (double(independent_sets - (without >= 0)) * sinc(step_x) * sinc(step_y));
}

Frequency WhiteLines::Near::peak(const Frequency& from, int without) const {
    Frequency best = from;
    double most = std::abs(wave(best, without));
    for (double step = 0.5; step > 1e-5; step *= 0.5)
        for (bool moved = true; moved;) {
            moved = false;
            for (const auto& [x, y] : {std::array{step, 0.}, {-step, 0.}, {0., step}, {0., -step}}) {
                const Frequency next{best[0] + x / width_, best[1] + y / height_};
                if (std::abs(next[0] - about_[0]) * width_ > 1.5 || std::abs(next[1] - about_[1]) * height_ > 1.5) continue;
                if (const double here = std::abs(wave(next, without)); here > most) {
                    best = next;
                    most = here;
                    moved = true;
                }
            }
        }
    return best;
}

double WhiteLines::Near::company(const Frequency& f) const {
    const std::complex<double> own = wave(f);
    double most = 0;
    constexpr int steps = 3;  // half a period of the window each: waves further away have their own peaks
    for (int y = -steps; y <= steps; ++y)
        for (int x = -steps; x <= steps; ++x) {
            const Frequency at{f[0] + 0.5 * x / width_, f[1] + 0.5 * y / height_};
            most = std::max(most, std::abs(wave(at) - own * (blackman_wave(0.5 * x) * blackman_wave(0.5 * y))));
        }
    return most / std::abs(own);
}

}  // namespace lfdsim
