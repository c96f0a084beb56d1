// Where the camera sees the screen. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "image/compare/region.h"
#include "image/overlay/homography.h"

#include <optional>
#include <string>

namespace lfdsim {

/// Four corners in the camera's picture, pixels; they may lie outside it. "Top left" is meant for a viewer upright in front of the
/// display, after the array's rotation is rounded to a quarter turn. Without them `missing` says why.
struct ScreenCorners {
    std::optional<Corners> at;
    std::string missing;
};

/// The corners of the screen that a photograph shows, in the viewer-side vertex plane: of the lens array (count times pitch, with
/// its rotation and offset), and on sides where that reaches over the panel by more than half a lens of the part whose straight
/// line from the camera meets the panel's rectangle (geometry/screen.h). Corners cut off by less than a fiftieth of the outline
/// count as whole.
ScreenCorners screen_corners(const Display&, const Geometry&);

/// The pixels of the camera's picture that see the screen: the array, where a straight line goes on to the panel's rectangle
/// (geometry/screen.h). Nothing if a corner of either lies behind the camera.
std::optional<Region> screen_region(const Display&, const Geometry&);

}  // namespace lfdsim
