// Paraxially: which slopes the light that one eye gathers from a screen has at the lenses. Floor 3.
#pragma once
#include "analysis/subject.h"

#include <array>

namespace lfdsim {

/// Lines of sight of an eye at the lateral place X have the slope X/E through lens centres, E the eye's distance from the lenses'
/// viewer-side principal plane. Around it they spread, each of these independently of the others (docs/model.md, "Crosstalk"):
/// - by the lens aperture: q (1/E - 1/L), q the place in the aperture;
/// - by the diffuser: theta (1 - d/E), d its distance from that plane;
/// - by the lenses across, C (1/E - 1/M), where elemental images were made for another distance M.
class SlopeSpread {
  public:
    /// eye_mm: E, more than 0.
    SlopeSpread(const Subject&, double eye_mm);

    /// Share of the light whose slope lies between low and high from that of the line of sight, either end infinite at will.
    double within(double low, double high) const;

    /// Full width of aperture and diffuser together; of a gaussian diffuser that at half maximum.
    double width() const { return aperture_.width + diffuser_.width; }

  private:
    enum class Shape { even, disk, gaussian };  // a disk's chords; a gaussian's width is that at half maximum
    struct Spread {
        Shape shape;
        double width;
        double below(double x) const;  // share less than x
        double reach() const;          // no more of it beyond on either side
    };
    Spread aperture_, diffuser_, lenses_;
};

}  // namespace lfdsim
