// Meshes that are compressed by KHR_draco_mesh_compression.
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

/// A decompressed mesh.
class DracoMesh {
  public:
    /// Throws std::runtime_error for damaged bytes.
    explicit DracoMesh(std::string_view bytes);
    ~DracoMesh();

    /// Returns the attribute that the extension calls `id` and `accessor` describes. Throws std::runtime_error if it is missing
    /// or damaged.
    AccessorValues numbers(std::uint32_t id, const Item& accessor) const;
    /// Returns three vertex indices for each triangle.
    std::vector<double> indices() const;

  private:
    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace lfdsim::reader
