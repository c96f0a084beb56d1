// Waves in the light of a white panel, harmonic by harmonic: neither other harmonics' waves nor their noise disturb. Floor 3.
//
// The panel's light is a Fourier series of the place P on it. Over lines that aim at r and end at P, the mean of light times
// c exp(2 pi i (K P - f r)) is what the harmonic K gives to the wave f.
#pragma once
#include "analysis/moire/white_lines.h"

#include <complex>
#include <optional>
#include <vector>

namespace lfdsim {

/// Lines through a window of the screen as WhiteLines has it, fewer of them, that end on the panel.
class LineEnds {
  public:
    /// A line of sight by its point in the window and its end on the panel.
    struct LineEnd {
        double x, y;         // share of the window, from its middle
        double column, row;  // on the panel
        double light;        // weighted
        int set;
    };
    static constexpr int rows = 256;

    /// Takes `rows` parts.
    LineEnds(const WhiteSeen&, std::int64_t seed, const Vec3d& eye, const Window&, Parts&);

    double width_mm, height_mm;               // of the window
    std::vector<std::vector<LineEnd>> paths;  // of each path of light
};

/// The waves of a white screen in one mixture of channels, as harmonics of the panel.
class HarmonicLines {
  public:
    /// Keeps references to both arguments, which must live as long.
    HarmonicLines(const LineEnds&, const WhiteSeen&, std::size_t mixture);

    struct MeasuredWave {
        WaveSums sums;   // of the harmonic that gives most and of those whose waves have its frequency
        double noise;    // standard deviation of its amplitude, if each line's light were chance
        double unclear;  // amplitude of what is neither clearly of its frequency nor clearly of another
    };
    /// The wave within 1.5 periods of the window of a frequency. `contrast`: about what it is. None where no harmonic gives
    /// anything for sure.
    std::optional<MeasuredWave> near(const Frequency&, double contrast) const;

    /// The mean light, weighted as waves are.
    double mean() const { return mean_; }

  private:
    using LineEnd = LineEnds::LineEnd;
    /// A harmonic of the white panel in the light of one path.
    struct Harmonic {
        std::size_t path;
        int k, l;            // periods per cell of pixels
        double column, row;  // periods per pixel
        std::complex<double> c;
    };
    /// The subpixel cell, divided into squares in which lines are gathered.
    struct CellBins {
        double columns, rows;  // pixels
        int squares = 0;       // along each axis; 0: nothing takes the path
    };
    /// The part of a wave's amplitude that a harmonic gives.
    struct HarmonicShare {
        const Harmonic* harmonic;
        double amplitude;
    };
    /// The significant shares of harmonics in a wave, the strongest first, of harmonics that may give `least` or more.
    std::vector<HarmonicShare> parts(const Frequency&, double least) const;
    std::complex<double> of_line(const LineEnd&, const Harmonic&, const Frequency&) const;
    WaveSums sums(const Harmonic&, const Frequency&) const;

    const LineEnds& ends_;
    double mean_ = 0;
    std::vector<CellBins> cells_;  // of each path
    std::vector<double> noise_;    // of each path: standard deviation of a mean over all lines
    std::vector<Harmonic> harmonics_;
};

}  // namespace lfdsim
