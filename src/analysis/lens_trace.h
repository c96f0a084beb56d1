// Light from a point of the panel through one lens to the viewer's side, in double precision. Floor 3.
//
// Lengths in mm from the lens's axis, in the axes of the array; depths z from the lens's rear principal plane, towards the viewer.
// The lens stands alone: its surfaces in their order, its own apertures, and the sheet of stops. In clear and plate surrounds light
// that crosses walls is therefore left out.
#pragma once
#include "model/display.h"
#include "model/geometry.h"
#include "optics/scene.h"

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
    struct Aim;

    // The lens turned over, as the tracer's rays come down: the panel stays in z = 0, the lens is below it.
    optics::Scene<double> scene_;
    double semi_aperture_mm_[max_surfaces];
    double rear_principal_mm_, gap_mm_;
};

/// All the light of a panel point that gets through, as rays of equal light of a Lambertian panel.
struct Bundle {
    std::vector<LensRay> rays;
    double light = 0;  // area of their direction cosines
};
/// Rays from the middles of a grid of about across x across cells over the directions that get through.
Bundle bundle(const LensTrace&, Point panel, int across);

/// Where a ray crosses the depth z along one axis: at + slope z.
struct Line {
    double at, slope;
};

/// Rays in two planes, over the whole aperture to its very rims: the meridional one of the panel's point and the lens's axis (for a
/// point on the axis: along x), and across it the sagittal one about the middle ray of the other. Each as seen along its own plane.
/// Empty where nothing gets through.
struct Fans {
    std::vector<Line> meridional, sagittal;
};
Fans fans(const LensTrace&, Point panel, int rays);

/// The full width of a fan at depth z, and its derivative along z. 0 for no lines. It is a convex function of z.
struct Width {
    double mm, per_mm;
};
Width width_at(const std::vector<Line>&, double z);

/// Half the diffuser's full angle (gaussian: full width at half maximum) along a unit vector of the array's axes, radians; 0
/// without one.
double diffuser_angle(const Display&, Point along);

/// The outermost lines after a diffuser at depth z that turns each by as much as +-angle (radians), up to 89 degrees from the axis.
std::vector<Line> diffused(const std::vector<Line>&, double z, double angle);

}  // namespace lfdsim
