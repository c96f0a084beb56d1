// What a camera of a grid sees of a display. Floor 2.
#pragma once
#include "display/view_grid.h"
#include "engine/render.h"

namespace lfdsim {

/// A display's camera in place of one of a grid's, looking straight at the panel, in a picture with pixels half as large as the
/// view's, of which the focus is a part.
struct GridCamera {
    Display display;             // with that camera
    Rect crop;                   // the whole pixels that cover the focus
    double left, top;            // of the focus in the picture, pixels
    double per_column, per_row;  // pixels of the picture for one of the view
};

/// The camera of a view of width x height pixels. Throws InputError, with the camera's number in the grid, if it is within the
/// display, or too far aside for its picture.
GridCamera grid_camera(const Display&, const Geometry&, const ViewGrid&, int column, int row, int width, int height);

/// The view: renders it and takes for each of its pixels the mean over its area. The image has width x height pixels; `crop` of the
/// options does not count.
Rendering grid_view(const GridCamera&, const SummedPanel& panel, int width, int height, RenderOptions, Job&);

}  // namespace lfdsim
