// Where the camera sees the screen. Floor 2.
#pragma once
#include "image/homography.h"
#include "model/display.h"
#include "model/geometry.h"

#include <optional>

namespace lfdsim {

/// The corners of the lens array (count times pitch, with its rotation and offset, in the viewer-side vertex plane) in the camera's
/// picture; they may lie outside of it. Top left is the corner that is so for a viewer who stands upright before the display, the
/// array's rotation taken to the nearest quarter turn. Nothing if the camera has a corner behind it.
std::optional<Corners> screen_corners(const Display&, const Geometry&);

}  // namespace lfdsim
