// What Assimp 5.2 passes over in 3MF files.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <filesystem>

namespace lfdsim::reader {

/// Notes colours of colour groups, materials of single triangles, and parts that lie in other files of the archive.
void note_3mf(const std::filesystem::path&, NotShown&);

}  // namespace lfdsim::reader
