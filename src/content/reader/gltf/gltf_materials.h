// The materials of a glTF file as Assimp keeps materials.
#pragma once
#include "content/reader/gltf/gltf_file.h"
#include "content/reader/limits/not_shown.h"

#include <assimp/scene.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace lfdsim::reader {

/// KHR_texture_transform: (u', v') = offset + R (scale (u, v)), v downwards; R turns counter-clockwise as the picture is seen.
struct UvTransform {
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotation = 0;

    std::array<double, 2> operator()(double u, double v) const;
};

/// Which texture coordinates a material's texture takes.
struct TextureUse {
    std::string channel;  // "TEXCOORD_0", "" without a texture
    UvTransform transform;
};

class GltfMaterials {
  public:
    explicit GltfMaterials(GltfFile& file) : file_(file) {}

    /// The number of a primitive's material, null for the default one, in `all`.
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
