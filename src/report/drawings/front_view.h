// A few lenses as the viewer sees them: their cells and clear apertures. Floor 4.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "report/plots/svg_drawing.h"

namespace lfdsim {

/// Draws the lens in the middle of the array and those about it, with the array's rotation, in a square with this upper left corner
/// and side, pixels. Cells are outlined, clear apertures filled; the middle lens is emphasised.
void draw_front(SvgDrawing&, Point corner, double side, const Display&, const Geometry&);

}  // namespace lfdsim
