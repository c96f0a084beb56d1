// What a rendering says of itself, in its file and on standard output. Floor 5.
#pragma once
#include "cli/output/output.h"
#include "engine/render.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim::cli {

struct Rendered {
    Metadata about;
    std::vector<ImageLayer> layers;  // with a target error, for a file that keeps layers
    Json more;                       // for --json
    std::size_t pixels_above_target = 0;
};

/// Estimator, and kernel and threads or the GPU.
std::string how_made(const Rendering&);
Json how_made_json(const Rendering&);

/// Moves the error's picture out of the rendering if it becomes a layer.
Rendered rendered(Rendering&, std::optional<double> target_error, bool layers);

}  // namespace lfdsim::cli
