// The display drawn to scale from the side, with traced rays. Floor 4.
#pragma once
#include "analysis/core/subject.h"

#include <string>

namespace lfdsim {

/// The scale of a drawing: y and z, mm, at the borders of a box in the drawing's own units; z to the right, y up.
struct SideFrame {
    double y_low, y_high, z_low, z_high;
    double left, top, width, height;  // of the box
};

/// The drawing from the panel to the eye, in the plane x = 0: panel, lenses, diffuser, central depth plane with its marginal
/// planes; rays from the eye back through the diffuser to the panel, and one pixel's light on its way to its image.
std::string side_view_svg(const Subject&, SideFrame* = nullptr);

/// A few lenses near the middle, with their true surfaces, the gap, what is between them, and the same rays. In the array's own
/// frame where the array is turned. Beside it their cells as the viewer sees them.
std::string lens_view_svg(const Subject&, SideFrame* = nullptr);

}  // namespace lfdsim
