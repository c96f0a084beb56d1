// The blur of what is shown at a depth, by paraxial theory. Floor 3.
#pragma once
#include "analysis/edge_view.h"
#include "analysis/subject.h"

#include <array>

namespace lfdsim {

/// Width of the image of a panel pixel by the nodal points, in the plane z_mm from the panel: a |z - z_H'| / g.
double pixel_image_mm(const Display&, const Geometry&, double z_mm);

/// Whether a plane at this height above the panel is the lenses' own, where each of them shows only one point.
bool at_the_lenses(const Display&, const Geometry&, double z_mm);

/// Half a cycle per lens pitch, as an eye at an angle projects it into the plane of bars.
double lens_limit_per_mm(const Subject&, const Bars& plane, double angle_deg);

/// The distance in a plane between a line of sight and the nodal line of the pixel that it sees: a sum of independent parts.
struct Blur {
    double pixel_mm;                // uniform over a square
    std::array<double, 2> spot_mm;  // the lens's spot: uniform over a disk, or over a rectangle along the array's axes
    bool round;
    double array_rad;                   // the turn of that rectangle
    std::array<double, 2> diffuser_mm;  // along x and y: full widths, at half maximum if gaussian
    bool gaussian;

    /// Modulation at a frequency per mm, 0 or more, along x or, not horizontal, along y.
    double mtf(double per_mm, bool horizontal) const;
    /// About the full width of an edge's blur.
    double width_mm(bool horizontal) const;
};

/// Share of the light that an eye at this angle and distance sees on other lenses' elemental images, which Blur leaves out.
double light_astray(const Subject&, double angle_deg, double distance_mm);

/// For an angle of view to the right.
Blur blur(const Display&, const Geometry&, const Theory&, double z_mm, double angle_deg);

}  // namespace lfdsim
