// Known faults of Assimp 5.2's loaders, corrected in the scene as loaded, before post-processing.
#pragma once
#include <assimp/scene.h>

#include <filesystem>
#include <string>

namespace lfdsim::reader {

void repair(aiScene& scene, const std::filesystem::path& file, const std::string& format);

}  // namespace lfdsim::reader
