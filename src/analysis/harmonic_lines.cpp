#include "analysis/harmonic_lines.h"

#include "model/numbers.h"

#include <algorithm>
#include <cmath>
#include <functional>

// docs/model.md, "Moire".
namespace lfdsim {
namespace {

constexpr int lines_a_set = HarmonicLines::rows * HarmonicLines::rows;
constexpr int one_in = 7;             // lines that are enough to tell which harmonics give anything
constexpr double least_share = 1e-3;  // of a harmonic in the mean light: what is less is left out
constexpr double least_part = 0.05;   // of a wave, that another harmonic must give to be looked at
constexpr double surely = 4;          // standard deviations
constexpr double one_wave = 0.3;      // periods of the window: waves no farther apart are one

}  // namespace

HarmonicLines::HarmonicLines(const WhiteSeen& screen, std::int64_t seed, const Vec3d& eye, const Window& window, Parts& parts)
    : width_(window.width_mm()), height_(window.height_mm()), paths_(screen.paths()) {
    for (std::vector<Line>& lines : paths_) lines.resize(std::size_t(independent_sets) * lines_a_set);
    parts.run(rows, [&](int row) {
        for (int set = 0; set < independent_sets; ++set)
            for (int column = 0; column < rows; ++column) {
                const std::size_t number = (std::size_t(set) * rows + std::size_t(row)) * rows + std::size_t(column);
                const auto random = [&](std::uint64_t n) {  // other lines than those of WhiteLines
                    return counted_random((std::uint64_t(seed) << 32) + (std::uint64_t(1) << 31) + 4 * number + n + 1);
                };
                const double x = (column + random(0)) / rows - 0.5, y = (row + random(1)) / rows - 0.5,
                             weight = blackman(x + 0.5) * blackman(y + 0.5);
                for (std::size_t path = 0; path < paths_.size(); ++path) {
                    const WhiteSeen::End end = screen.end(path, eye, x * width_, y * height_, 2 * random(2) - 1, 2 * random(3) - 1);
                    paths_[path][number] = {x, y, end.column, end.row, weight * end.light};
                }
            }
    });
    for (std::size_t path = 0; path < paths_.size(); ++path) {
        double light = 0, squares = 0;
        for (const Line& line : paths_[path]) {
            light += line.light;
            squares += line.light * line.light;
        }
        const double count = double(paths_[path].size());
        const WhitePanel& white = screen.white(path);
        mean_ += light / count * white.mean();
        noise_.push_back(std::sqrt(squares * one_in) / count);
        const auto [highest_k, highest_l] = white.highest_order();
        for (int k = -highest_k; k <= highest_k; ++k)
            for (int l = -highest_l; l <= highest_l; ++l)
                if (const std::complex<double> c = white.harmonic(k, l); (k != 0 || l != 0) && std::abs(c) >= least_share)
                    harmonics_.push_back({path, double(k) / white.cell()[0], double(l) / white.cell()[1], c});
    }
}

std::complex<double> HarmonicLines::of_line(const Line& line, const Harmonic& h, const Frequency& f) const {
    return std::polar(line.light,
                      2 * pi * (h.column * line.column + h.row * line.row - f[0] * line.x * width_ - f[1] * line.y * height_));
}

WaveSums HarmonicLines::sums(const Harmonic& harmonic, const Frequency& f) const {
    WaveSums result(f, width_, height_);
    const std::vector<Line>& lines = paths_[harmonic.path];
    const std::complex<double> share = harmonic.c / double(lines_a_set);
    for (std::size_t n = 0; n < lines.size(); ++n)
        if (lines[n].light > 0)
            result.add(int(n / lines_a_set), int((lines[n].x + 0.5) * WaveSums::side), int((lines[n].y + 0.5) * WaveSums::side),
                       share * of_line(lines[n], harmonic, f));
    return result;
}

WaveSums HarmonicLines::near(const Frequency& f, double contrast) const {
    struct Part {
        const Harmonic* harmonic;
        double amplitude;
    };
    std::vector<Part> parts;
    for (const Harmonic& h : harmonics_) {
        if (2 * std::abs(h.c) < least_part * contrast) continue;
        std::complex<double> sum = 0;
        const std::vector<Line>& lines = paths_[h.path];
        for (std::size_t n = 0; n < lines.size(); n += one_in)
            if (lines[n].light > 0) sum += of_line(lines[n], h, f);
        const double mean = std::abs(sum) * one_in / double(lines.size());
        if (mean > surely * noise_[h.path]) parts.push_back({&h, std::abs(h.c) * mean});
    }
    if (parts.empty()) return WaveSums(f, width_, height_);
    std::ranges::sort(parts, std::greater(), &Part::amplitude);
    WaveSums wave = sums(*parts.front().harmonic, f);
    const Frequency own = wave.peak(f);
    for (std::size_t n = 1; n < parts.size() && parts[n].amplitude > least_part * parts.front().amplitude; ++n) {
        const WaveSums other = sums(*parts[n].harmonic, f);
        const Frequency at = other.peak(f);
        if (std::hypot((at[0] - own[0]) * width_, (at[1] - own[1]) * height_) <= one_wave) wave.add(other);
    }
    return wave;
}

}  // namespace lfdsim
