// The light of a panel point on the viewer's side of its lens: bundles of rays, fans in two planes, and their width. Floor 3.
//
// Lengths and depths as in engine/views/lens_trace.h.
#pragma once
#include "engine/views/lens_trace.h"

#include <vector>

namespace lfdsim {

/// Rays of all the light of a panel point that is transmitted by the lens, each with equal light of a Lambertian panel; for
/// strips only those of the plane across them: light that runs steeply along strips, which no eye sees, meets them as if they
/// were stronger.
struct Bundle {
    std::vector<LensRay> rays;
    double light = 0;  // area of their direction cosines
};
/// Rays from the middles of a grid of about across x across cells over the directions that get through.
Bundle bundle(const LensTrace&, Point panel, int across);

/// A ray of a fan in its plane: it crosses the depth z at `at` + slope z.
struct FanRay {
    double at, slope;
};

/// Rays in two planes, over the whole aperture to its very rims: the meridional one of the panel's point and the lens's axis (for a
/// point on the axis: along x), and across it the sagittal one about the middle ray of the other. Each as seen along its own plane.
/// Empty where nothing gets through.
struct Fans {
    std::vector<FanRay> meridional, sagittal;
};
Fans fans(const LensTrace&, Point panel, int rays);

/// The full width of a fan at depth z, and its derivative along z. 0 for no lines. It is a convex function of z.
struct FanWidth {
    double mm, per_mm;
};
FanWidth width_at(const std::vector<FanRay>&, double z);

/// Half the diffuser's full angle (gaussian: full width at half maximum) along a unit vector of the array's axes, radians; 0
/// without one.
double diffuser_angle(const Display&, Point along);

/// The outermost lines after a diffuser at depth z that turns each by as much as +-angle (radians), up to 89 degrees from the axis.
std::vector<FanRay> diffused(const std::vector<FanRay>&, double z, double angle);

}  // namespace lfdsim
