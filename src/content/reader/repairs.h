// Known faults of Assimp 5.2's loaders, corrected in the scene as loaded, before post-processing; and what its steps assume.
#pragma once
#include "content/models/model.h"

#include <assimp/scene.h>

#include <filesystem>
#include <string>

namespace lfdsim::reader {

/// Corrects the faults for which the loader of a format (the name of Assimp's importer) is known.
void repair(aiScene& scene, const std::filesystem::path& file, const std::string& format);

/// Returns whether a file's faces are flat if it has no normals: by specification of glTF 2.0; of OBJ if the file says so ("s
/// off", no smoothing group), which Assimp ignores.
bool flat_without_normals(const std::filesystem::path& file, const std::string& format);

/// The refusals of files whose faces have indices out of range, and whose meshes have no such material.
inline constexpr const char* missing_vertices =
    "some faces have indices of vertices that do not exist; the file is damaged, export it again";
inline constexpr const char* missing_material =
    "a mesh refers to a material that does not exist; the file is damaged, export it again";

/// Throws std::runtime_error if a mesh as loaded refers to a material, or a face to a vertex, that does not exist: Assimp's steps
/// leave such meshes out, and read beyond the end of the vertices.
void check_references(const aiScene& scene);

/// Gives corners whose normal is missing or broken (of a length not between 1/2 and 2), which would leave holes in the shading, a
/// vertex of their own with the face's normal.
void mend_normals(Model& model);

}  // namespace lfdsim::reader
