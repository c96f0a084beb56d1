// A few lenses as the viewer sees them: their cells and what of them is clear. Floor 4.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "report/plots/svg_drawing.h"

namespace lfdsim {

/// The lens in the middle of the array and those about it, turned as they are, in a square with this upper left corner; its side in
/// pixels. The cells' borders are lines, clear apertures filled; the middle lens stands out.
void draw_front(SvgDrawing&, Point corner, double side, const Display&, const Geometry&);

}  // namespace lfdsim
