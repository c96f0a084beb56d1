// What a command says about a rendering, in its file and on standard output. Floor 5.
#pragma once
#include "cli/output/output.h"
#include "engine/render.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim::cli {

struct Rendered {
    Metadata about;                       // of the picture's file
    std::vector<ImageLayer> layers;       // "error", with a target error and a file that keeps layers
    Json more;                            // for --json
    std::size_t pixels_above_target = 0;  // pixels whose error exceeds the target
};

/// Returns estimator, and kernel and threads or the GPU, in words.
std::string how_made(const Rendering&);
Json how_made_json(const Rendering&);

/// Collects what to say about a rendering. The picture of its errors is moved out of it if it becomes a layer.
Rendered rendered(Rendering&, std::optional<double> target_error, bool layers);

}  // namespace lfdsim::cli
