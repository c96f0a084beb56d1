// Amplitudes of waves near a frequency, from sums over blocks of a window, set by set. Floor 3.
#pragma once
#include "analysis/core/estimate.h"

#include <array>
#include <complex>
#include <vector>

namespace lfdsim {

/// A wave exp(2 pi i f r) over the viewer-side vertex plane, f in cycles per mm along the display's x and y.
using Frequency = std::array<double, 2>;

class WaveSums {
  public:
    static constexpr int side = 32;          // blocks along each axis of the window
    static constexpr double one_wave = 0.3;  // periods of the window: waves no farther apart are one

    WaveSums(const Frequency& about, double width_mm, double height_mm)
        : about_(about), width_(width_mm), height_(height_mm), blocks_(std::size_t(side) * side) {}

    /// A part of a set's mean of light times exp(-2 pi i about r), in a block.
    void add(int set, int column, int row, std::complex<double> part) {
        blocks_[std::size_t(row) * side + std::size_t(column)][std::size_t(set)] += part;
    }
    /// Sums about the same frequency.
    void add(const WaveSums&);

    /// Amplitude and phase of the wave with this frequency, without one of the sets (-1: all): half of the mean light for full
    /// contrast.
    std::complex<double> wave(const Frequency&, int without = -1) const;

    /// The frequency near the given one where the wave is strongest, within 1.5 periods of the window of the one that the sums are
    /// about.
    Frequency peak(const Frequency& from, int without = -1) const;
    /// The least error of a frequency along x and y, however little noise there is: lenses with aberrations make waves that are
    /// not quite of one frequency, and a window weights their parts.
    Frequency closest() const { return {closest_step / width_, closest_step / height_}; }

  private:
    static constexpr double finest_step = 1e-5, closest_step = 0.05;  // periods of the window: searched, and known
    Frequency about_;
    double width_, height_;
    std::vector<std::array<std::complex<double>, independent_sets>> blocks_;
};

}  // namespace lfdsim
