// The beats of the lens lattice with the panel's pixels, in closed form. docs/measures.md, "Moire". Floor 3.
#pragma once
#include "analysis/moire/eye_filter.h"
#include "analysis/moire/wave_sums.h"
#include "display/display.h"
#include "geometry/geometry.h"
#include "geometry/subpixels.h"

#include <array>
#include <optional>

namespace lfdsim {

/// Returns 1/|f|, mm.
double period_mm(const Frequency&);
/// Returns the direction of the wave vector, degrees counter-clockwise from +x, from 0 to below 180.
double direction_deg(const Frequency&);
/// Returns the direction by which equally strong waves are ranked: within a tenth of a degree of 180 it is below 0, so that
/// rounding does not turn 0 into 180.
inline double rank_deg(double direction_deg) { return direction_deg < 179.9 ? direction_deg : direction_deg - 180; }

/// A component of the pattern.
struct Beat {
    Frequency frequency{};
    double contrast = 0, seen = 0;  // Michelson's, of this component alone: before and after the eye's filter
    Frequency turned_per_rad{};     // periods by which a diffuser's angle about the display's y and x moves it
};

/// The waves of a white panel that an eye on axis, `eye_mm` from the panel, sees through paraxial lenses, in light of the given
/// channel weights.
class MoireTheory {
  public:
    MoireTheory(const Display&, const Geometry&, double eye_mm, const ChannelWeights& = luminance_weights);

    /// Returns the lowest frequency at which the panel's harmonic with (k, l) periods in a cell beats with the lens lattice.
    Frequency beat(int k, int l) const;

    /// Returns the strongest beat after the eye's filter. Of those of its period that are within 1 % as strong, as symmetry makes
    /// them, and of all that are exactly as strong, it is the one of the least direction. Nothing if the panel has no structure,
    /// or if all beats are too fine or too weak for the eye.
    std::optional<Beat> strongest(const EyeFilter& = eye_for_luminance) const;

  private:
    /// A frequency, periods per mm, or another vector of two components along x and y or x' and y'.
    struct WaveVector {
        double x, y;
    };
    /// Orders of the lattice's harmonics along one axis, both ends included.
    struct OrderRange {
        int from, to;
    };
    WaveVector to_array(WaveVector) const;
    Frequency to_display(WaveVector) const;
    WaveVector seen_harmonic(int k, int l) const;
    OrderRange lens_orders(int axis, double panel, double reach) const;
    WaveVector lens_harmonic(int m, int n) const;
    double diffuser(WaveVector nu) const;

    const Display& display_;
    const Geometry& geometry_;
    WhitePanel panel_;
    double eye_mm_;
    WaveVector scale_;  // e: displacement on the panel per displacement of lens and aim in the vertex plane, along x' and y'
    WaveVector glass_;  // g/f: displacement on the panel per displacement within a lens
};

}  // namespace lfdsim
