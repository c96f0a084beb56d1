// Pictures as models.
#pragma once
#include "content/models/model.h"

#include <filesystem>

namespace lfdsim::reader {

/// Returns a rectangle of height 1 about the origin, facing +z, that shows a picture file without shading; its alpha is the share
/// of light that it adds and hides. Throws std::runtime_error, which says why the file cannot be read.
Model picture(const std::filesystem::path&);

}  // namespace lfdsim::reader
