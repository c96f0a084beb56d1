// Waves of single harmonics of the panel. docs/measures.md, "Moire".

#include "analysis/moire/harmonic_lines.h"

#include "analysis/resolution/fourier.h"
#include "base/constants.h"
#include "base/sinc.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lfdsim {
namespace {

constexpr int lines_a_set = LineEnds::rows * LineEnds::rows;
constexpr double all_lines = double(independent_sets) * lines_a_set;
constexpr int finest_order = 800;       // of harmonics; finer ones, of pixels with a tiny aperture ratio, are left out
constexpr int most_squares = 2048;      // along a cell
constexpr double least_share = 1e-3;    // |c_K|: weaker harmonics are left out
constexpr double least_part = 0.01;     // of the strongest harmonic's amplitude: a harmonic above it is measured separately
constexpr double least_counted = 1e-3;  // of a wave's contrast: harmonics from here to least_part add to the error only
constexpr double surely = 4;            // standard deviations of noise from which a contribution is significant

}  // namespace

LineEnds::LineEnds(const WhiteSeen& screen, std::int64_t seed, const Vec3d& eye, const Window& window, Parts& parts)
    : width_mm(window.width_mm()), height_mm(window.height_mm()), paths(screen.paths()) {
    std::vector<std::vector<std::vector<LineEnd>>> by_row(paths.size(), std::vector<std::vector<LineEnd>>(rows));
    parts.run(rows, [&](int row) {
        // Each line has a random position in its square and random angles at the diffuser; all paths of light share them.
        for (int set = 0; set < independent_sets; ++set)
            for (int column = 0; column < rows; ++column) {
                const std::uint64_t number = (std::uint64_t(set) * rows + std::uint64_t(row)) * rows + std::uint64_t(column);
                // Bit 31 makes the numbers differ from those of WhiteLines.
                const auto random = [&](std::uint64_t n) {
                    return counted_random((std::uint64_t(seed) << 32) + (std::uint64_t(1) << 31) + 4 * number + n + 1);
                };
                const double x = (column + random(0)) / rows - 0.5, y = (row + random(1)) / rows - 0.5,
                             weight = blackman(x + 0.5) * blackman(y + 0.5);
                for (std::size_t path = 0; path < paths.size(); ++path) {
                    const WhiteSeen::End end =
                        screen.end(path, eye, x * width_mm, y * height_mm, 2 * random(2) - 1, 2 * random(3) - 1);
                    if (end.light > 0)
                        by_row[path][std::size_t(row)].push_back({x, y, end.column, end.row, weight * end.light, set});
                }
            }
    });
    for (std::size_t path = 0; path < paths.size(); ++path)
        for (const std::vector<LineEnd>& row : by_row[path]) paths[path].insert(paths[path].end(), row.begin(), row.end());
}

HarmonicLines::HarmonicLines(const LineEnds& ends, const WhiteSeen& screen, std::size_t mixture)
    : ends_(ends), cells_(ends.paths.size()), noise_(ends.paths.size()) {
    for (std::size_t path = 0; path < ends.paths.size(); ++path) {
        const WhitePanel* white = screen.white(path, mixture);
        if (!white) continue;
        // The noise of a mean of light times a random phase is sqrt(sum of light^2)/lines.
        double light = 0, squares = 0;
        for (const LineEnd& line : ends.paths[path]) {
            light += line.light;
            squares += line.light * line.light;
        }
        mean_ += light / all_lines * white->mean();
        noise_[path] = std::sqrt(squares) / all_lines;
        const auto [highest_k, highest_l] = white->highest_order();
        const int last_k = std::min(highest_k, finest_order), last_l = std::min(highest_l, finest_order);
        // At least four squares for each order, so that sinc(k/n), by which squares weaken a harmonic, stays near 1.
        CellBins cell{double(white->cell()[0]), double(white->cell()[1]), 32};
        while (cell.squares < most_squares && cell.squares < 4 * std::max(last_k, last_l)) cell.squares *= 2;
        cells_[path] = cell;
        for (int k = -last_k; k <= last_k; ++k)
            for (int l = -last_l; l <= last_l; ++l)
                if (const std::complex<double> c = white->harmonic(k, l); (k != 0 || l != 0) && std::abs(c) >= least_share)
                    harmonics_.push_back({path, k, l, k / cell.columns, l / cell.rows, c});
    }
}

std::complex<double> HarmonicLines::of_line(const LineEnd& line, const Harmonic& h, const Frequency& f) const {
    return std::polar(
        line.light,
        2 * pi * (h.column * line.column + h.row * line.row - f[0] * line.x * ends_.width_mm - f[1] * line.y * ends_.height_mm));
}

WaveSums HarmonicLines::sums(const Harmonic& harmonic, const Frequency& f) const {
    WaveSums result(f, ends_.width_mm, ends_.height_mm);
    const std::complex<double> share = harmonic.c / double(lines_a_set);
    for (const LineEnd& line : ends_.paths[harmonic.path])
        result.add(line.set, int((line.x + 0.5) * WaveSums::side), int((line.y + 0.5) * WaveSums::side),
                   share * of_line(line, harmonic, f));
    return result;
}

// One transform gives the contributions of all harmonics to a wave: line ends, with light exp(-2 pi i f.r), are collected in
// squares by their position in the cell, and the order (-k, -l) of the squares' transform is the sum of light exp(2 pi i (K.P -
// f.r)).
std::vector<HarmonicLines::HarmonicShare> HarmonicLines::parts(const Frequency& f, double least) const {
    std::vector<HarmonicShare> found;
    for (std::size_t path = 0; path < cells_.size(); ++path) {
        const CellBins& cell = cells_[path];
        const int n = cell.squares;
        if (n == 0) continue;  // nothing of the mixture takes this path
        const auto square = [&](double place, double size) {
            const double turns = place / size;
            return std::min(int((turns - std::floor(turns)) * n), n - 1);
        };
        std::vector<std::complex<double>> plane(std::size_t(n) * std::size_t(n));
        for (const LineEnd& line : ends_.paths[path])
            plane[std::size_t(square(line.row, cell.rows)) * std::size_t(n) + std::size_t(square(line.column, cell.columns))] +=
                std::polar(line.light, -2 * pi * (f[0] * line.x * ends_.width_mm + f[1] * line.y * ends_.height_mm));
        fourier(plane, n);
        for (const Harmonic& h : harmonics_) {
            if (h.path != path || 2 * std::abs(h.c) < least) continue;
            const std::size_t at = std::size_t((n - h.l) % n) * std::size_t(n) + std::size_t((n - h.k) % n);
            // Squares weaken a harmonic by sinc(k/n) sinc(l/n).
            const double mean = std::abs(plane[at]) / (sinc(double(h.k) / n) * sinc(double(h.l) / n)) / all_lines;
            if (mean > surely * noise_[path]) found.push_back({&h, std::abs(h.c) * mean});
        }
    }
    std::ranges::stable_sort(found, std::greater(), &HarmonicShare::amplitude);
    return found;
}

std::optional<HarmonicLines::MeasuredWave> HarmonicLines::near(const Frequency& f, double contrast) const {
    const std::vector<HarmonicShare> found = parts(f, least_counted * contrast);
    if (found.empty()) return {};
    const Harmonic& harmonic = *found.front().harmonic;
    MeasuredWave wave{sums(harmonic, f), std::abs(harmonic.c) * noise_[harmonic.path], 0};
    // Harmonics whose waves are within 0.3 periods of the window of the strongest one's are part of the wave; from 0.15 to 0.6
    // periods it is not clear.
    const Frequency own = wave.sums.peak(f);
    double left_out = 0;  // squares
    for (std::size_t n = 1; n < found.size(); ++n) {
        if (found[n].amplitude < least_part * found.front().amplitude) {
            left_out += found[n].amplitude * found[n].amplitude;
            continue;
        }
        const WaveSums other = sums(*found[n].harmonic, f);
        const Frequency at = other.peak(f);
        const double apart = std::hypot((at[0] - own[0]) * ends_.width_mm, (at[1] - own[1]) * ends_.height_mm) / WaveSums::one_wave;
        if (apart <= 1) wave.sums.add(other);
        if (apart > 0.5 && apart < 2) wave.unclear += found[n].amplitude;
    }
    wave.unclear = std::sqrt(wave.unclear * wave.unclear + left_out);
    return wave;
}

}  // namespace lfdsim
