// The slopes, at the lenses, of the light that one eye gathers from a screen, for lenses without aberration. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "analysis/spots/aperture_wave.h"
#include "geometry/diffuser_profile.h"

#include <array>
#include <functional>

namespace lfdsim {

/// A line of sight of an eye at x that aims at the place X across the array has the slope m = (X - x)/E, E the eye's distance from
/// the lenses' viewer-side principal plane, and sees what is meant for a viewer of the slope s from the screen's middle. Where the
/// elemental images are made for the distance M, s is x/E and the sum of
/// - the lens aperture: q (1/E - 1/L), q the place in the aperture;
/// - the diffuser: (tan(atan m + theta) - m)(d/M - 1), theta its angle, d its distance from that plane; what it turns past the
///   array's border is dark;
/// - the lenses across: X (1/M - 1/E).
/// 1/L is 1/f - 1/g, of a pinhole -1/g. Of strips all is along the panel's rows.
class SlopeSpread {
  public:
    /// eye_mm: E, more than 0. Along the array's width, or with axis 1 along its height.
    SlopeSpread(const Subject&, double eye_mm, int axis = 0);

    /// Share of the light with slopes s from low to high for an eye at x; either end may be infinite.
    double within(double x_mm, double low, double high) const;

    /// Full width of aperture and diffuser together; of a gaussian diffuser that at half maximum.
    double width() const;

  private:
    /// Light below a slope; none is below `low` and all below `high`.
    struct Spread {
        double low, high;
        std::function<double(double)> below;
    };
    Spread aperture() const, lenses() const, diffuser(double x_mm, double aimed_mm) const;
    static double convolved(std::array<const Spread*, 3> spreads, double low, double high);
    double turned_less(double angle) const;

    double eye_mm_, array_mm_;
    ApertureShape shape_;
    std::size_t axis_;
    double aperture_slopes_, lens_slopes_per_mm_;
    double half_rad_, above_mm_, diffuser_scale_;  // half the diffuser's angle; its height above the vertex plane; 1 - d/M
    const ProfileFigures* profile_;                // the diffuser's
};

}  // namespace lfdsim
