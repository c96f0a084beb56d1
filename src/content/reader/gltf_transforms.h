// Texture transforms of glTF 2.0, which Assimp 5.2 turns about the wrong point.
#pragma once
#include <assimp/vector3.h>

#include <filesystem>
#include <map>
#include <optional>

namespace lfdsim::reader {

/// KHR_texture_transform: (u', v') = offset + R (scale (u, v)), v downwards; R turns counter-clockwise as the picture is seen.
struct UvTransform {
    double offset[2]{0, 0}, scale[2]{1, 1}, rotation = 0;
    std::optional<unsigned> channel;  // in place of the one that the texture names

    /// Of coordinates as Assimp has them, v upwards.
    aiVector3D operator()(const aiVector3D& uv) const;
};

/// Those of the base colour textures, by the materials' numbers.
std::map<unsigned, UvTransform> gltf_transforms(const std::filesystem::path&);

}  // namespace lfdsim::reader
