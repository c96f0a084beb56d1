// Waves in the light of a white panel, harmonic by harmonic, so that other harmonics' waves and their noise do not disturb.
// Floor 3.
//
// The panel's light is a Fourier series of the position P on it, sum of c_K exp(2 pi i K.P). Over lines of sight that aim at r
// and end at P, the mean of light times c_K exp(2 pi i (K.P - f.r)) is what the harmonic K contributes to the wave f.
// docs/measures.md, "Moire".
#pragma once
#include "analysis/moire/white_lines.h"

#include <complex>
#include <optional>
#include <vector>

namespace lfdsim {

/// Lines of sight through a window of the screen, as WhiteLines but fewer, that end on the panel.
class LineEnds {
  public:
    /// A line of sight by its point in the window and its end on the panel.
    struct LineEnd {
        double x, y;         // in the window, from its middle, in widths and heights of it
        double column, row;  // on the panel, pixels from its top left corner
        double light;        // of a panel without structure, times Blackman's window
        int set;             // of the independent sets
    };
    static constexpr int rows = 256;  // rows and columns of squares; a set has a line in each

    /// Traces the lines of an eye, mm, display frame. Takes `rows` parts.
    LineEnds(const WhiteSeen&, std::int64_t seed, const Vec3d& eye, const Window&, Parts&);

    double width_mm, height_mm;               // of the window
    std::vector<std::vector<LineEnd>> paths;  // the line ends of each light path
};

/// The waves of a white screen in one mixture of channels, as sums over harmonics of the panel.
class HarmonicLines {
  public:
    /// Keeps a reference to the line ends, which must live as long.
    HarmonicLines(const LineEnds&, const WhiteSeen&, std::size_t mixture);

    /// A wave as measured.
    struct MeasuredWave {
        WaveSums sums;   // of the harmonic that contributes most, and of those whose waves have its frequency
        double noise;    // standard deviation of that harmonic's amplitude, if each line's light had a random phase
        double unclear;  // amplitude of harmonics of which it is not clear whether they are part of the wave
    };
    /// Returns the wave within 1.5 periods of the window of a frequency; nothing if no harmonic contributes significantly.
    /// `contrast` is about that of the wave: harmonics that can contribute only a thousandth of it are left out.
    std::optional<MeasuredWave> near(const Frequency&, double contrast) const;

    /// Returns the mean light of the mixture, weighted by the window as waves are.
    double mean() const { return mean_; }

  private:
    using LineEnd = LineEnds::LineEnd;
    /// A harmonic of the white panel in the light of one path.
    struct Harmonic {
        std::size_t path;
        int k, l;                // periods per cell of pixels
        double column, row;      // periods per pixel, to the right and down
        std::complex<double> c;  // c_K
    };
    /// The subpixel cell, divided into squares in which line ends are collected.
    struct CellBins {
        double columns, rows;  // pixels
        int squares = 0;       // along each axis; 0: no channel of the mixture takes the path
    };
    /// The amplitude that a harmonic contributes to a wave.
    struct HarmonicShare {
        const Harmonic* harmonic;
        double amplitude;
    };
    /// Returns the significant contributions to a wave, the strongest first, of harmonics whose contrast 2 |c| is `least` or
    /// more.
    std::vector<HarmonicShare> parts(const Frequency&, double least) const;
    /// Returns light exp(2 pi i (K.P - f.r)) of one line.
    std::complex<double> of_line(const LineEnd&, const Harmonic&, const Frequency&) const;
    /// Returns the sums of a harmonic's contribution to waves near f.
    WaveSums sums(const Harmonic&, const Frequency&) const;

    const LineEnds& ends_;
    double mean_ = 0;
    std::vector<CellBins> cells_;  // of each path
    std::vector<double> noise_;    // of each path: standard deviation of a mean over all lines
    std::vector<Harmonic> harmonics_;
};

}  // namespace lfdsim
