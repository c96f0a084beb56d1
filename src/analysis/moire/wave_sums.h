// Amplitudes of waves near a frequency, from sums over blocks of a window. Floor 3.
#pragma once
#include "analysis/core/estimate.h"

#include <array>
#include <complex>
#include <vector>

namespace lfdsim {

/// The frequency f of a wave exp(2 pi i f.r) in the vertex plane: cycles per mm along the display's x and y.
using Frequency = std::array<double, 2>;

/// Sums over the blocks of a window, for each independent set of lines, of light times exp(-2 pi i about.r). From them the
/// amplitude of any wave within some periods of the window follows without the lines: over a block it changes little against
/// `about`.
class WaveSums {
  public:
    static constexpr int side = 32;          // blocks along each axis of the window
    static constexpr double one_wave = 0.3;  // periods of the window by which waves may be apart and yet are one

    WaveSums(const Frequency& about, double width_mm, double height_mm)
        : about_(about), width_(width_mm), height_(height_mm), blocks_(std::size_t(side) * side) {}

    /// Adds a part of a set's mean of light times exp(-2 pi i about.r) to a block, columns to the right and rows upwards.
    void add(int set, int column, int row, std::complex<double> part) {
        blocks_[std::size_t(row) * side + std::size_t(column)][std::size_t(set)] += part;
    }
    /// Adds sums about the same frequency.
    void add(const WaveSums&);

    /// Returns amplitude and phase of the wave with a frequency, without one of the sets (-1: of all). The amplitude is half of
    /// the mean light for full contrast.
    std::complex<double> wave(const Frequency&, int without = -1) const;

    /// Returns the frequency near `from` at which the wave is strongest, within 1.5 periods of the window of `about`, by steps
    /// that are halved.
    Frequency peak(const Frequency& from, int without = -1) const;
    /// Returns the least error of a frequency along x and y, however little noise there is: lenses with aberrations make waves
    /// that are not exactly of one frequency.
    Frequency closest() const { return {closest_step / width_, closest_step / height_}; }

  private:
    // The last step of peak() and the least error of a frequency, in periods of the window
    static constexpr double finest_step = 1e-5, closest_step = 0.05;
    Frequency about_;
    double width_, height_;
    std::vector<std::array<std::complex<double>, independent_sets>> blocks_;
};

}  // namespace lfdsim
