// Drawings of the display to scale from the side, with traced rays: from panel to eye, and of a few lenses. Floor 4.
#pragma once
#include "analysis/core/subject.h"

#include <string>

namespace lfdsim {

/// The scale of a drawing: a box in it, and y and z at the box's borders; z to the right, y up.
struct SideFrame {
    double y_low, y_high, z_low, z_high;  // mm
    double left, top, width, height;      // of the box, in the drawing's units
};

/// Returns the drawing from the panel to the eye, in the plane x = 0: panel, lenses, diffuser, central depth plane with its
/// marginal planes; rays from the eye back through the diffuser to the panel, and one pixel's light on its way to its image.
/// Heights are enlarged where they would be too small, and the drawing says so. The frame, if wanted, is filled.
std::string side_view_svg(const Subject&, SideFrame* = nullptr);

/// Returns the drawing of up to three lenses near the middle, with their surfaces, the gap, the surround and the same rays, in the
/// array's frame where the array is rotated. Beside them are their cells as the viewer sees them.
std::string lens_view_svg(const Subject&, SideFrame* = nullptr);

}  // namespace lfdsim
