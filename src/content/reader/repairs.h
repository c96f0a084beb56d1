// Known faults of Assimp 5.2's loaders, corrected in the scene as loaded, before post-processing.
#pragma once
#include <assimp/scene.h>

#include <filesystem>
#include <string>

namespace lfdsim::reader {

void repair(aiScene& scene, const std::filesystem::path& file, const std::string& format);

/// Whether a file's faces are flat where it has no normals: by specification of glTF 2.0; of OBJ where it says so ("s off", no
/// smoothing group), which Assimp passes over.
bool flat_without_normals(const std::filesystem::path& file, const std::string& format);

}  // namespace lfdsim::reader
