// Meshes that KHR_draco_mesh_compression packs.
#pragma once
#include "content/reader/gltf/gltf_file.h"

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace draco {
class Mesh;
}

namespace lfdsim::reader {

class DracoMesh {
  public:
    /// Throws std::runtime_error for damaged bytes.
    explicit DracoMesh(std::string_view bytes);
    ~DracoMesh();

    /// The attribute that the extension calls `id`, which `accessor` describes.
    AccessorValues numbers(std::uint32_t id, const Item& accessor) const;
    /// Three for each triangle.
    std::vector<double> indices() const;

  private:
    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace lfdsim::reader
