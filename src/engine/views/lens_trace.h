// Light from a point of the panel through one lens to the viewer's side, in double precision. Floor 2.
//
// Lengths in mm from the lens's axis, in the axes of the array; depths z from the lens's rear principal plane, towards the viewer.
// The lens stands alone: its surfaces in their order, its own apertures, and the sheet of stops. In clear and plate surrounds light
// that crosses walls is therefore left out.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "optics/traced_display.h"

#include <array>
#include <optional>
#include <vector>

namespace lfdsim {

/// A ray on the viewer's side: (x + mx z, y + my z). Behind the lens it is where the ray seems to come from.
struct LensRay {
    double x, y, mx, my;
};

using Point = std::array<double, 2>;

/// Direction cosines against x and y of a ray that leaves the panel. A Lambertian panel sends equal light into equal areas of them.
struct Directions {
    double x0, x1, y0, y1;
};

class LensTrace {
  public:
    LensTrace(const Display&, const Geometry&);

    /// The ray that leaves the panel's point in the direction of these cosines; none where it does not get through.
    std::optional<LensRay> ray(Point panel, Point cosines) const;

    /// The cosines, in the medium next to the panel, of the ray that by paraxial optics passes the lens's principal planes at the
    /// point `at`: in the medium below the lens its slope is (at - panel) / (n g), g the gap. Real rays come close to it.
    Point towards(Point panel, Point at) const;

    /// The point of the principal planes that towards() would give these cosines for.
    Point aim(Point panel, Point cosines) const;

    /// Whether the lens focuses light along x only.
    bool of_strips() const { return scene_.lattice.strips; }

    /// A rectangle not much larger than all directions that get through. None if none does, or less than 1e-10 of them.
    std::optional<Directions> directions(Point panel) const;

  private:
    /// 0 where the ray gets through, and then `out` is it. Else a number above 0 that falls the further a ray gets and the less it
    /// misses the aperture at which it ends, so that a search can follow it.
    double blocked(Point panel, Point cosines, LensRay& out) const;
    std::optional<Directions> search(Point panel, Directions among) const;
    bool leaves_layers(Point& at, Point& cosines) const;
    double blocked_by_ideal(Point panel, Point slope, LensRay& out) const;
    double outside(double x, double y, double radius) const;
    double index_at_panel() const, index_below_lens() const;
    struct Aim;

    // The lens turned over, as the tracer's rays come down: the panel stays in z = 0, the lens is below it.
    optics::TracedDisplay<double> scene_;
    double semi_aperture_mm_[max_surfaces];
    double rear_principal_mm_, gap_mm_;
};

}  // namespace lfdsim
