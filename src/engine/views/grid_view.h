// What a camera of a grid sees of a display. Floor 2.
#pragma once
#include "display/view_grid.h"
#include "engine/render.h"

namespace lfdsim {

/// A display's camera at the position of one of a grid's (docs/model.md, "Grids of views"). Its off-axis frustum is a part of the
/// picture of a camera that looks straight at the panel, with pixels half as large as the view's.
struct GridCamera {
    Display display;             // with that camera
    Rect crop;                   // the whole pixels that cover the focus
    double left, top;            // of the focus in the picture, pixels
    double per_column, per_row;  // pixels of the picture in one pixel of the view
};

/// Returns the camera of a view of width x height pixels. Throws InputError, with the camera's place in the grid, if it is within
/// the display, or so far aside that its picture is too large.
GridCamera grid_camera(const Display&, const Geometry&, const ViewGrid&, int column, int row, int width, int height);

/// Renders the view: each of its pixels is the mean of the picture over its area. The image has width x height pixels; `crop` of
/// the options has no effect.
Rendering grid_view(const GridCamera&, const SummedPanel& panel, int width, int height, RenderOptions, Job&);

}  // namespace lfdsim
