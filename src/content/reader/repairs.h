// Known faults of Assimp 5.2's loaders, corrected in the scene as loaded, before post-processing.
#pragma once
#include <assimp/scene.h>

#include <filesystem>
#include <string>

namespace lfdsim::reader {

/// Corrects the faults for which the loader of a format (the name of Assimp's importer) is known.
void repair(aiScene& scene, const std::filesystem::path& file, const std::string& format);

/// Returns whether a file's faces are flat if it has no normals: by specification of glTF 2.0; of OBJ if the file says so ("s
/// off", no smoothing group), which Assimp ignores.
bool flat_without_normals(const std::filesystem::path& file, const std::string& format);

}  // namespace lfdsim::reader
