// Where in its picture the camera sees the screen. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "image/compare/region.h"
#include "image/overlay/homography.h"

#include <optional>
#include <string>

namespace lfdsim {

/// The screen's corners in the camera's picture.
struct ScreenCorners {
    /// From the top left one on, clockwise, pixels; they may lie outside the picture. "Top left" is that of a viewer upright in
    /// front of the display, after the array's rotation is rounded to a quarter turn.
    std::optional<Corners> at;
    std::string missing;  // why there are none
};

/// Returns the corners of the screen that a photograph shows, in the viewer-side vertex plane: of the lens array (count times
/// pitch, with its rotation and offset), and on sides where that reaches over the panel by more than half a lens of the part whose
/// straight line from the camera meets the panel's rectangle (geometry/screen.h). Corners cut off by less than a fiftieth of the
/// outline count as whole.
ScreenCorners screen_corners(const Display&, const Geometry&);

/// Returns the pixels of the camera's picture that see the screen: the array, where a straight line goes on to the panel's
/// rectangle (geometry/screen.h); nothing if a corner of either lies behind the camera.
std::optional<Region> screen_region(const Display&, const Geometry&);

}  // namespace lfdsim
