// Rays in the plane of a lens's axis, traced surface by surface in either direction, for drawings. Floor 4.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <vector>

namespace lfdsim {

/// A ray at (y, z), mm from the lens's axis and from the panel, with the unit direction (dy, dz).
struct SideRay {
    double y, z, dy, dz;

    /// Returns y where the ray crosses another height z.
    double y_at(double other_z) const { return y + dy / dz * (other_z - z); }
};

/// Returns the ray from (y, z) towards another point.
SideRay side_ray(double y, double z, double to_y, double to_z);

/// The path of a ray through a lens.
struct SidePath {
    std::vector<std::array<double, 2>> points;  // (y, z), mm: the start, and the intersection with each surface
    SideRay last;                               // the ray after the last point
    bool through;                               // false: a rim, a stop or total reflection ended it at the last point
};

/// Traces a ray through one lens of the display as described, upwards (dz > 0: from the panel) or downwards, by the tracer's
/// pass_lens() (optics/lens.h), and through the layers on the panel. y is from the lens's axis.
SidePath through_lens(const Display&, const Geometry&, const SideRay&);

}  // namespace lfdsim
