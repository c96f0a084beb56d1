// A picture's work, prepared for any device. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/render.h"
#include "engine/scene/traced_display.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// What a kernel or a GPU needs to render a picture. Its tile points into it, so it is not copied.
struct Work {
    /// The panel's images and the job must outlive the work. Throws InputError for a bad crop, target error, number of samples or
    /// panel size.
    Work(const Display&, const Geometry&, const std::vector<optics::SummedImage>& panel, const RenderOptions&, const Job&);
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

    /// Makes a black picture of the crop's size, to which the tile is then rendered, and another for errors if wanted.
    void make_pictures(bool with_error);

    Rendering result;  // estimator; pictures once they are made
    StoredDisplay<float> scene;
    optics::RayOrigin view;
    Tile tile;                           // the whole crop
    std::optional<double> target_error;  // where there is something to sample
};

}  // namespace lfdsim
