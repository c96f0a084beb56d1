// Pictures of light fields and light fields of scenes. Floor 2.
#pragma once
#include "content/content.h"
#include "content/pictures/light_field.h"

namespace lfdsim {

struct FieldPicture {
    Picture picture;
    std::int64_t beside_cameras = 0, beside_focus = 0;  // rays that no view shows (LightField::Answer): black
};

/// Elemental images as of a scene, each ray's light from views. The grid's focus is parallel to the panel, its middle over the
/// panel's. The same bits for any number of threads. Throws InputError for a bad thread count.
FieldPicture elemental_images(const Display&, const Geometry&, const LightField&, int threads, Job&);

/// How the views of a scene are made.
struct ViewMaking {
    int width, height;     // pixels of each
    std::int64_t samples;  // rays of a pixel, spread over it
    int threads = 0;       // 0: all
};

/// What one of the grid's cameras sees of a scene: the focus, from edge to edge. Throws InputError for a bad thread count.
Picture scene_view(const ContentScene&, const Geometry&, const ViewGrid&, int column, int row, const ViewMaking&, Job&);
/// How far from the cameras' plane that is, mm, in all three channels, through the middle of each pixel; 0 where nothing is.
Picture scene_view_depth(const ContentScene&, const Geometry&, const ViewGrid&, int column, int row, const ViewMaking&, Job&);

}  // namespace lfdsim
