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
    double light = 0;  // the area of their direction cosines, which a Lambertian point fills with equal light
};
/// Returns the rays at the middles of a grid of `across` x `across` cells (of strips across^2 in a row) over the directions that
/// get through; `panel`: mm from the lens's axis.
Bundle bundle(const LensTrace&, Point panel, int across);

/// A ray of a fan, projected onto the fan's plane: at depth z it is at `at` + slope z, mm.
struct FanRay {
    double at, slope;
};

/// Rays in two planes over the whole aperture, up to its rims: the meridional plane contains the panel's point and the lens's
/// axis (for a point on the axis it is along x'), the sagittal one is across it through the middle ray of the meridional fan.
/// Both are empty if nothing gets through.
struct Fans {
    std::vector<FanRay> meridional, sagittal;
};
/// Traces about `rays` rays of each fan, and those at the ends of each open range of directions.
Fans fans(const LensTrace&, Point panel, int rays);

/// The full width of a fan at a depth, mm, and its derivative by the depth. The width is a convex function of the depth.
struct FanWidth {
    double mm, per_mm;
};
/// Returns a fan's width at depth z, mm from H'; 0 for no rays.
FanWidth width_at(const std::vector<FanRay>&, double z);

/// Returns half the diffuser's full angle (gaussian: full width at half maximum) along a unit vector of the array's axes,
/// radians; 0 without a diffuser.
double diffuser_angle(const Display&, const Geometry&, Point along);

/// Returns the outermost rays that a diffuser at depth z makes of each: turned by plus and minus `angle` radians, up to 89
/// degrees from the axis.
std::vector<FanRay> diffused(const std::vector<FanRay>&, double z, double angle);

}  // namespace lfdsim
