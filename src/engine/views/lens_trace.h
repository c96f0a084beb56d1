// Light from a point of the panel through one lens to the viewer's side, in double precision. Floor 2.
//
// Lengths in mm from the lens's axis, in the axes of the array; depths z from the lens's rear principal plane, towards the viewer.
// The lens is isolated: its surfaces in their order, their apertures, and the sheet of stops. In clear and plate surrounds light
// that crosses walls is therefore left out.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "optics/traced_display.h"

#include <array>
#include <optional>

namespace lfdsim {

/// A ray on the viewer's side: (x + mx z, y + my z). Behind the lens, at z < 0, it is where the ray seems to come from.
struct LensRay {
    double x, y, mx, my;
};

using Point = std::array<double, 2>;

/// A rectangle of direction cosines against x and y, x0 .. x1 and y0 .. y1, of rays that leave the panel, in the medium next to it.
/// A Lambertian panel sends equal light into equal areas of them.
struct Directions {
    double x0, x1, y0, y1;
};

/// Traces rays from the panel through one lens of a display, without errors. Points of the panel are from the lens's axis, mm.
class LensTrace {
  public:
    /// Traces at the wavelength of the geometry.
    LensTrace(const Display&, const Geometry&);

    /// Returns the ray that leaves the panel's point in the direction of these cosines; nothing where it does not get through.
    std::optional<LensRay> ray(Point panel, Point cosines) const;

    /// Returns the cosines, in the medium next to the panel, of the ray that by paraxial optics passes the lens's principal planes
    /// at the point `at`: in the medium below the lens its slope is (at - panel) / (n g), g the gap. Real rays come close to it.
    Point towards(Point panel, Point at) const;

    /// Returns the point of the principal planes for which towards() gives these cosines.
    Point aim(Point panel, Point cosines) const;

    /// Returns whether the lens focuses light along x only.
    bool of_strips() const { return scene_.lattice.strips; }

    /// Returns a rectangle not much larger than all directions that get through; nothing if none does, or if they span less than
    /// 1e-10.
    std::optional<Directions> directions(Point panel) const;

  private:
    /// Returns 0 where the ray gets through, and sets `out` to it; else a number above 0 that falls the further a ray gets and the
    /// less it misses the aperture at which it ends, so that a search can follow it.
    double blocked(Point panel, Point cosines, LensRay& out) const;
    std::optional<Directions> search(Point panel, Directions among) const;
    bool leaves_layers(Point& at, Point& cosines) const;
    double blocked_by_ideal(Point panel, Point slope, LensRay& out) const;
    double outside(double x, double y, double radius) const;
    double index_at_panel() const, index_below_lens() const;  // of the media next to the panel, and next to the lens
    struct Aim;

    // The lens turned over, as the tracer's rays come down: the panel stays in z = 0, the lens is below it, so that a height z of
    // the display is -z here.
    optics::TracedDisplay<double> scene_;
    double semi_aperture_mm_[max_surfaces];
    double rear_principal_mm_, gap_mm_;
};

}  // namespace lfdsim
