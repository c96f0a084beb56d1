// Where the camera sees the screen. Floor 2.
#pragma once
#include "image/homography.h"
#include "image/region.h"
#include "model/display.h"
#include "model/geometry.h"

#include <optional>

namespace lfdsim {

/// The corners of the lens array (count times pitch, with its rotation and offset, in the viewer-side vertex plane) in the camera's
/// picture, pixels; they may lie outside it. "Top left" is meant for a viewer upright in front of the display, after the array's
/// rotation is rounded to a quarter turn. Nothing if a corner lies behind the camera.
std::optional<Corners> screen_corners(const Display&, const Geometry&);

/// The pixels of the camera's picture that see the screen: the array, where a straight line goes on to the panel's rectangle
/// (model/screen.h). Nothing if a corner of either lies behind the camera.
std::optional<Region> screen_region(const Display&, const Geometry&);

}  // namespace lfdsim
