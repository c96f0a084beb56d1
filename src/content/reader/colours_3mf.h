// Features of 3MF files that Assimp 5.2 ignores.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <filesystem>

namespace lfdsim::reader {

/// Notes colours of colour groups, materials of single triangles, missing materials, and parts in other files of the archive: they
/// are not shown. Throws std::runtime_error for a required extension that is not read, and for a material that does not exist.
/// Other formats have nothing to note.
void note_3mf(const std::filesystem::path&, NotShown&);

}  // namespace lfdsim::reader
