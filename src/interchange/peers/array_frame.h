// Where the array's frame is in the display's. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

namespace lfdsim::peers {

/// The place of the array: a point p of its frame, from its middle and the panel, is at turn p + shift_mm in the display's.
struct ArrayFrame {
    double turn[3][3], shift_mm[3];
};

/// Returns the frame of an array that is rotated about z and, by a wedge, about the panel's axes, about its middle c in the plane
/// of the vertices: turn = Ry(wedge_y) Rx(wedge_x) Rz(rotation).
ArrayFrame array_frame(const Display&, const Geometry&);

}  // namespace lfdsim::peers
