// Pictures as models.
#pragma once
#include "content/models/model.h"

#include <filesystem>

namespace lfdsim::reader {

/// A rectangle of height 1 about the origin, facing +z, that shows the picture in its own light, through which one sees as its
/// alpha says. Throws std::runtime_error that says why the file cannot be read.
Model picture(const std::filesystem::path&);

}  // namespace lfdsim::reader
