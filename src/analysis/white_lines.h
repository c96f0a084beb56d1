// Lines of sight from one eye to a white panel, spread over a window of the screen, and waves in the light that they see. Floor 3.
//
// The window is cut into equal squares; each set of lines has one through each square, at a random place. The mean of light times a
// wave over such lines is that over the plane, whatever else the light holds: unlike evenly spaced points they make no false beats.
#pragma once
#include "analysis/estimate.h"
#include "analysis/eye_rays.h"
#include "analysis/moire_theory.h"
#include "analysis/parallel.h"

#include <complex>
#include <vector>

namespace lfdsim {

/// A rectangle of the vertex plane about the display's axis, in squares of `square_mm`.
struct Window {
    int columns, rows;
    double square_mm;
    double width_mm() const { return columns * square_mm; }
    double height_mm() const { return rows * square_mm; }
};

/// Light that a line of sight brings from a white panel, over the panel's own along its normal.
struct WhiteLight {
    double plain;  // of a panel without subpixels and black matrix: the mean
    double seen;   // where the line ends
};

/// A white panel behind the lenses, of which some channels count.
struct WhiteSeen {
    const EyeRays& rays;
    const Panel& panel;
    WhitePanel white;

    /// Of the line from an eye that aims at (x, y) of the vertex plane, with the diffuser's numbers a and b.
    WhiteLight light(const Vec3d& eye, double x, double y, double a, double b) const;
};

class WhiteLines {
  public:
    /// Takes rows parts.
    WhiteLines(const WhiteSeen&, std::int64_t seed, const Vec3d& eye, const Window&, Parts&);

    const Window& window() const { return window_; }

    /// The mean luminance, weighted as waves are, of a panel without structure.
    double mean() const;

    /// By how much subpixels and black matrix change the light in each square, all sets together, times weights that fall to 0 at
    /// the window's border: Blackman's along both axes, 1 in the mean.
    std::vector<double> weighted_change() const;

    /// Standard deviation of |wave()| over mean(), all sets together, if each line's light were chance.
    double noise() const;

    /// What finds the amplitudes of waves near one: sums over blocks of the window with that wave, set by set.
    class Near;
    Near near(const Frequency&, Parts&) const;
    /// The parts that near() takes.
    static constexpr int near_parts = 32;

  private:
    struct Line {
        double x, y;  // mm from the window's middle
        double a, b;  // the diffuser's numbers
    };
    Line line(int set, int column, int row) const;

    Window window_;
    std::uint64_t seed_;
    std::vector<double> across_, up_;  // weights of columns and rows
    std::vector<float> change_;        // of each line: set, row, column
    Sums light_{}, squares_{};         // weighted sums
};

/// Amplitudes of waves near a frequency.
class WhiteLines::Near {
  public:
    /// Amplitude and phase of the wave with this frequency, without one of the sets (-1: all): half of mean() for full contrast.
    std::complex<double> wave(const Frequency&, int without = -1) const;

    /// The frequency near the given one where the wave is strongest, within 1.5 periods
    /// of the window of the one that the sums are about.
    Frequency peak(const Frequency& from, int without = -1) const;

    /// The greatest amplitude that other waves seem to have next to the one at `f`, over its own: 0 where it stands alone.
    double company(const Frequency& f) const;

  private:
    friend class WhiteLines;
    static constexpr int side = near_parts;  // blocks along each axis
    Frequency about_{};
    double width_ = 0, height_ = 0;
    std::vector<std::array<std::complex<double>, independent_sets>> blocks_;  // means over all lines of a set
};

}  // namespace lfdsim
