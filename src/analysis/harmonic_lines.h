// Waves in the light of a white panel, harmonic by harmonic: neither other harmonics' waves nor their noise disturb. Floor 3.
//
// The panel's light is a Fourier series of the place P on it. Over lines that aim at r and end at P, the mean of light times
// c exp(2 pi i (K P - f r)) is what the harmonic K gives to the wave f.
#pragma once
#include "analysis/white_lines.h"

#include <complex>
#include <vector>

namespace lfdsim {

class HarmonicLines {
  public:
    /// A window of the screen as WhiteLines has it, with fewer lines. Takes `rows` parts.
    HarmonicLines(const WhiteSeen&, std::int64_t seed, const Vec3d& eye, const Window&, Parts&);
    static constexpr int rows = 128;

    /// The wave within 1.5 periods of the window of a frequency: of the harmonic that gives most to it there, and of those whose
    /// own waves have the same frequency. `contrast`: about what it is.
    WaveSums near(const Frequency&, double contrast) const;

    /// The mean light, weighted as waves are.
    double mean() const { return mean_; }

  private:
    struct Line {
        double x, y;         // share of the window, from its middle
        double column, row;  // on the panel
        double light;        // weighted; 0 for lines that end nowhere
    };
    struct Harmonic {
        std::size_t path;
        double column, row;  // periods per pixel
        std::complex<double> c;
    };
    std::complex<double> of_line(const Line&, const Harmonic&, const Frequency&) const;
    WaveSums sums(const Harmonic&, const Frequency&) const;

    double width_, height_, mean_ = 0;
    std::vector<std::vector<Line>> paths_;  // of each path of light the lines, set by set
    std::vector<Harmonic> harmonics_;
    std::vector<double> noise_;  // of each path: standard deviation of a mean over few_lines
};

}  // namespace lfdsim
