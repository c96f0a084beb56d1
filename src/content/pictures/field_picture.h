// Pictures of light fields, and light fields of scenes. Floor 2.
#pragma once
#include "content/content.h"
#include "content/pictures/light_field.h"

namespace lfdsim {

/// Elemental images made of views.
struct FieldPicture {
    Picture picture;
    std::int64_t beside_cameras = 0, beside_focus = 0;  // numbers of rays that no view shows (LightField::Answer), which are black
};

/// Returns elemental images as of a scene, with each ray's light from views. The grid's focus is parallel to the panel and
/// centred on the display's axis. The bits do not depend on the number of threads. Throws InputError for a bad number of threads.
FieldPicture elemental_images(const Display&, const Geometry&, const LightField&, int threads, Job&);

/// Options of the views of a scene.
struct ViewMaking {
    int width, height;     // pixels of each
    std::int64_t samples;  // rays for each pixel, spread over it
    int threads = 0;       // 0: one for each processor
};

/// Returns what one of the grid's cameras sees of a scene: exactly the focus. Throws InputError for a bad number of threads.
Picture scene_view(const ContentScene&, const Geometry&, const ViewGrid&, int column, int row, const ViewMaking&, Job&);
/// Returns the distance of what that camera sees from the cameras' plane, mm, in all three channels, through each pixel's centre;
/// 0 where nothing is.
Picture scene_view_depth(const ContentScene&, const Geometry&, const ViewGrid&, int column, int row, const ViewMaking&, Job&);

}  // namespace lfdsim
