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

double period_mm(const Frequency&);
/// The direction of the wave vector, counter-clockwise from +x, 0 to below 180.
double direction_deg(const Frequency&);
/// The direction by which equally strong waves are ranked: within a tenth of a degree of 180 it is below 0, so that rounding
/// makes no 180 of 0.
inline double rank_deg(double direction_deg) { return direction_deg < 179.9 ? direction_deg : direction_deg - 180; }

/// A component of the pattern. Contrast is Michelson's, of this component alone: without and with the eye's filter.
struct Beat {
    Frequency frequency{};
    double contrast = 0, seen = 0;
    Frequency turned_per_rad{};  // periods by which a diffuser's angle about the display's y and x moves it
};

/// White panels as an eye on axis sees them through paraxial lenses, `eye_mm` from the panel.
class MoireTheory {
  public:
    MoireTheory(const Display&, const Geometry&, double eye_mm, const ChannelWeights& = luminance_weights);

    /// The coarsest beat of the harmonic with (k, l) periods in a cell of the panel's with the lens lattice.
    Frequency beat(int k, int l) const;

    /// The strongest beat after the eye's filter; of those of its period that are within 1 % as strong, as symmetry
    /// makes them (and of all that are exactly as strong), that of the least direction. None where the panel has no
    /// structure, or where all are too fine for the eye.
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
    WaveVector scale_;  // panel places per place of the vertex plane, along the array's x' and y'
    WaveVector glass_;  // g/f, by how much a lens moves the panel place with the place in the lens
};

}  // namespace lfdsim
