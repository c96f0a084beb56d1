// The materials of a glTF file, as Assimp stores materials.
#pragma once
#include "content/reader/gltf/gltf_file.h"
#include "content/reader/limits/not_shown.h"

#include <assimp/scene.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace lfdsim::reader {

/// KHR_texture_transform: (u', v') = offset + R (scale (u, v)), v downwards; R rotates counter-clockwise as the picture is seen.
struct UvTransform {
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotation = 0;  // radians

    std::array<double, 2> operator()(double u, double v) const;
};

/// The texture coordinates that a material's texture uses.
struct TextureUse {
    std::string channel;  // "TEXCOORD_0"; "" without a texture
    UvTransform transform;
};

/// The materials and embedded pictures of a file, each converted once.
class GltfMaterials {
  public:
    explicit GltfMaterials(GltfFile& file) : file_(file) {}

    /// Returns the index in `all` of a primitive's material; a null number is the default material.
    unsigned index(const Item& number, NotShown&);
    const TextureUse& texture_use(unsigned index) const { return uses_[index]; }

    std::vector<std::unique_ptr<aiMaterial>> all;
    std::vector<std::unique_ptr<aiTexture>> embedded;

  private:
    void add_texture(const Item& use, aiMaterial& to);
    std::string name_of_image(const Item& number);

    GltfFile& file_;
    std::vector<TextureUse> uses_;
    std::map<std::size_t, unsigned> known_;
    std::map<std::size_t, std::string> images_;
};

}  // namespace lfdsim::reader
