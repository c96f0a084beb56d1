// Where the array's own frame is in the display's. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

namespace lfdsim::peers {

/// Takes a point p of the array's frame, x and y from its middle, z from the panel, to turn * p + shift_mm.
struct ArrayFrame {
    double turn[3][3], shift_mm[3];
};

/// Turned about z and, by a wedge, about the panel's axes, about the array's middle in the plane of the vertices.
ArrayFrame array_frame(const Display&, const Geometry&);

}  // namespace lfdsim::peers
