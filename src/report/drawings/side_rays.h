// Rays in the plane of a lens's axis, surface by surface and either way, for drawing. Floor 4.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <vector>

namespace lfdsim {

/// A ray at (y, z), mm from the lens's axis and from the panel; direction of unit length.
struct SideRay {
    double y, z, dy, dz;

    double y_at(double other_z) const { return y + dy / dz * (other_z - z); }
};

/// The ray from (y, z) towards another point.
SideRay side_ray(double y, double z, double to_y, double to_z);

struct SidePath {
    std::vector<std::array<double, 2>> points;  // (y, z): the start, and where each surface was met
    SideRay last;                               // the ray after the last point
    bool through;                               // false: a rim, a stop or total reflection ended it at the last point
};

/// Through one lens of the display, upwards (dz > 0: from the panel) or downwards, by the tracer's own passage (optics/lens.h).
SidePath through_lens(const Display&, const Geometry&, const SideRay&);

}  // namespace lfdsim
