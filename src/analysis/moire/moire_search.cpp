// The search for the strongest wave of a white screen. docs/measures.md, "Moire".

#include "analysis/moire/eye_filter.h"
#include "analysis/moire/moire.h"
#include "analysis/resolution/fourier.h"
#include "base/constants.h"
#include "base/sinc.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lfdsim {
namespace {

constexpr double window_deg = 10, finest_cycles_per_degree = 50;  // the window's side, and the finest waves that are searched for
constexpr double least_periods = 3;  // in the window: with fewer, a wave cannot be told from its mirror image of the frequency -f
constexpr double least_squares = 500'000, most_along = 1000;  // in the window: with fewer lines of sight their noise hides waves
constexpr std::size_t most_candidates = 8;
constexpr double least_over_noise = 6;  // the greatest of a million frequencies' noise is at some 5

struct Candidate {
    Frequency frequency;
    double contrast, seen;  // before and after the eye's filter
};

bool is_measurable(const Frequency& f, const Window& w) {
    return std::hypot(f[0] * w.width_mm(), f[1] * w.height_mm()) >= least_periods;
}

/// Returns the candidates: local maxima of the squares' transform after the eye's filter, the strongest first.
std::vector<Candidate> strongest_waves(const WhiteLines& lines, double mm_per_degree) {
    const Window& w = lines.window();
    int n = 1;
    while (n < std::max(w.columns, w.rows)) n *= 2;
    // The squares' changes, filled up with zeros to a power of two for the transform
    std::vector<std::complex<double>> plane(std::size_t(n) * std::size_t(n));
    const std::vector<double> change = lines.weighted_change();
    for (int y = 0; y < w.rows; ++y)
        for (int x = 0; x < w.columns; ++x)
            plane[std::size_t(y) * std::size_t(n) + std::size_t(x)] =
                change[std::size_t(y) * std::size_t(w.columns) + std::size_t(x)];
    fourier(plane, n);
    const auto frequency = [&](int k, int l) {
        const auto signed_order = [&](int order) { return order < n / 2 ? order : order - n; };
        return Frequency{signed_order(k) / (n * w.square_mm), signed_order(l) / (n * w.square_mm)};
    };
    // Contrast is twice the amplitude over the mean. Squares average a wave, by sinc along each axis.
    std::vector<double> contrast(plane.size()), seen(plane.size());
    const double scale = 2 / (double(change.size()) * lines.mean());
    for (int l = 0; l < n; ++l)
        for (int k = 0; k < n; ++k) {
            const Frequency f = frequency(k, l);
            const double cycles = std::hypot(f[0], f[1]) * mm_per_degree;
            if (!is_measurable(f, w) || cycles > finest_cycles_per_degree) continue;
            const std::size_t here = std::size_t(l) * std::size_t(n) + std::size_t(k);
            contrast[here] = scale * std::abs(plane[here]) / (sinc(f[0] * w.square_mm) * sinc(f[1] * w.square_mm));
            seen[here] = contrast[here] * eye_filter(cycles);
        }
    // Maxima over 5 x 5 frequencies, of each pair f and -f one
    std::vector<Candidate> all;
    const auto place = [&](int k, int l) { return std::size_t((l + n) % n) * std::size_t(n) + std::size_t((k + n) % n); };
    for (int l = 0; l < n; ++l)
        for (int k = 0; k < n; ++k) {
            const Frequency f = frequency(k, l);
            const double here = seen[place(k, l)];
            if (f[1] < 0 || (f[1] == 0 && f[0] <= 0) || here == 0) continue;
            bool greatest = true;
            for (int dl = -2; dl <= 2; ++dl)
                for (int dk = -2; dk <= 2; ++dk) greatest = greatest && here >= seen[place(k + dk, l + dl)];
            if (greatest) all.push_back({f, contrast[place(k, l)], here});
        }
    std::ranges::stable_sort(all, std::greater(), &Candidate::seen);
    if (all.size() > most_candidates) all.resize(most_candidates);
    return all;
}

/// Returns the wave near a frequency from all sets of lines but one (-1: from all).
Beat beat_of(const HarmonicLines::MeasuredWave& wave, const Frequency& from, double mean, double mm_per_degree, int without) {
    const Frequency f = wave.sums.peak(from, without);
    Beat beat{f, 2 * std::abs(wave.sums.wave(f, without)) / mean, 0};
    beat.seen = beat.contrast * eye_filter(std::hypot(f[0], f[1]) * mm_per_degree);
    return beat;
}

/// Returns the wave near a frequency with errors by the jackknife over the sets; those of contrast include what is unclear.
MeasuredBeat measured(const HarmonicLines::MeasuredWave& wave, const Frequency& from, double mean, double mm_per_degree) {
    std::array<Beat, independent_sets + 1> found;  // without none, and without each set
    for (int without = -1; without < independent_sets; ++without)
        found[std::size_t(without + 1)] = beat_of(wave, from, mean, mm_per_degree, without);
    const auto figure = [&](auto of) { return jackknife([&](int without) { return of(found[std::size_t(without + 1)]); }); };
    MeasuredBeat m;
    m.beat = found[0];
    for (std::size_t k = 0; k < 2; ++k)
        m.frequency_error[k] = figure([&](const Beat& b) { return b.frequency[k]; }).error + wave.sums.closest()[k];
    const double error = std::hypot(m.frequency_error[0], m.frequency_error[1]), period = period_mm(m.beat.frequency);
    // Period 1/f: an error d of the frequency makes d period^2 of it, and at most d period, in radians, of the direction.
    m.period_mm = {period, error * period * period};
    m.direction_deg = {direction_deg(m.beat.frequency), std::min(error * period / degree, 90.)};
    const double unclear = 2 * wave.unclear / mean;
    m.contrast = figure([](const Beat& b) { return b.contrast; });
    m.contrast.error = std::hypot(m.contrast.error, unclear);
    m.seen = figure([](const Beat& b) { return b.seen; });
    m.seen.error =
        std::hypot(m.seen.error, unclear * eye_filter(std::hypot(m.beat.frequency[0], m.beat.frequency[1]) * mm_per_degree));
    return m;
}

}  // namespace

Window middle_of_screen(const Display& d, const Geometry& g, double eye_mm) {
    const double away = eye_mm - g.vertex_plane_mm, finest = mm_per_degree(away) / (2 * finest_cycles_per_degree);
    const double scale = away / eye_mm;  // of the panel, projected from the eye onto the vertex plane
    double half_x = std::min(0.5 * window_deg * mm_per_degree(away), 0.5 * g.panel_width_mm * scale),
           half_y = std::min(0.5 * window_deg * mm_per_degree(away), 0.5 * g.panel_height_mm * scale);
    // The window is scaled down until it lies within the array's rectangle, which may be rotated and shifted.
    const Lattice<double>& lattice = g.lattice;
    const double move_x = lattice.cos_turn * lattice.offset[0] + lattice.sin_turn * lattice.offset[1],
                 move_y = lattice.cos_turn * lattice.offset[1] - lattice.sin_turn * lattice.offset[0];
    const double wide = std::abs(lattice.cos_turn) * half_x + std::abs(lattice.sin_turn) * half_y,
                 high = std::abs(lattice.cos_turn) * half_y + std::abs(lattice.sin_turn) * half_x;
    const double fits =
        std::min({1., (0.5 * g.array_width_mm - std::abs(move_x)) / wide,
                  d.array.lattice == LatticeKind::strips ? 1. : (0.5 * g.array_height_mm - std::abs(move_y)) / high});
    const double inside = 2 * std::max(fits, 0.);
    // Small windows have finer squares, so that there are as many lines of sight.
    const double small = inside * std::max(std::sqrt(half_x * half_y / least_squares), std::max(half_x, half_y) / most_along),
                 square = small > 0 ? std::min(finest, small) : finest;
    const auto squares = [&](double half) { return std::max(1, int(inside * half / square)); };
    return {squares(half_x), squares(half_y), square};
}

MoireSearch find_moire(const WhiteLines& lines, const HarmonicLines& harmonics, const std::optional<Beat>& theory,
                       double mm_per_degree) {
    MoireSearch search;
    // A sum of random phases has a standard deviation of noise/sqrt(2) in each of its components; contrast is twice the
    // amplitude.
    search.least = 2 * least_over_noise * lines.noise() / std::sqrt(2.);
    std::vector<MeasuredBeat> all;
    const auto measure = [&](const Frequency& from, double contrast) {
        const auto wave = harmonics.near(from, contrast);
        if (!wave) return;
        const MeasuredBeat m = measured(*wave, from, harmonics.mean(), mm_per_degree);
        const double least = 2 * least_over_noise * wave->noise / std::sqrt(2.) / harmonics.mean();
        if (m.beat.contrast > least && is_measurable(m.beat.frequency, lines.window())) all.push_back(m);
    };
    for (const Candidate& c : strongest_waves(lines, mm_per_degree)) measure(c.frequency, c.contrast);
    // Theory's wave may be too weak to be a maximum of the squares' transform.
    if (theory && is_measurable(theory->frequency, lines.window())) measure(theory->frequency, theory->contrast);
    // Symmetry makes waves of the same period that may be equally strong: of those the one of the least direction is reported.
    if (all.empty()) return search;
    const auto strongest = std::ranges::max_element(all, {}, [](const MeasuredBeat& m) { return m.seen.value; });
    for (const MeasuredBeat& m : all) {
        const auto may_equal = [&](const Estimate& a, const Estimate& b, double most) {
            return std::abs(a.value - b.value) <= std::min(std::hypot(a.error, b.error), most * b.value);
        };
        if (!may_equal(m.seen, strongest->seen, 0.25) || !may_equal(m.period_mm, strongest->period_mm, 0.02)) continue;
        if (!search.strongest || rank_deg(m.direction_deg.value) < rank_deg(search.strongest->direction_deg.value))
            search.strongest = m;
    }
    // Other waves, at least a period of the window apart, that may be as strong
    for (const MeasuredBeat& m : all) {
        const bool another = std::hypot(m.beat.frequency[0] - search.strongest->beat.frequency[0],
                                        m.beat.frequency[1] - search.strongest->beat.frequency[1]) > 1 / lines.window().width_mm();
        if (another && m.seen.value + m.seen.error >= search.strongest->seen.value - search.strongest->seen.error)
            search.as_strong.push_back(m);
    }
    return search;
}

}  // namespace lfdsim
