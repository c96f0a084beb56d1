// The nodes of a glTF file: where they stand, and which of them its scene shows.
#pragma once
#include "content/reader/gltf/gltf_file.h"
#include "content/reader/places.h"

#include <assimp/types.h>

#include <vector>

namespace lfdsim::reader {

using Matrix = aiMatrix4x4t<double>;

class GltfNodes {
  public:
    /// Throws std::runtime_error for nodes that are no trees.
    explicit GltfNodes(const GltfFile&);

    /// Returns the transform from a node's coordinates to the scene's.
    const Matrix& world(std::size_t node) const { return world_[node]; }
    /// The nodes of the file's scene in its order; of a file without scenes, all. Parts that KHR_node_visibility hides are not
    /// among them.
    std::vector<std::size_t> shown() const;

  private:
    const GltfFile& file_;
    std::vector<std::size_t> parents_;
    std::vector<Matrix> world_;
};

/// Translation x rotation (a quaternion x, y, z, w) x scale.
Matrix placed(const double* translation, const double* rotation, const double* scale);

}  // namespace lfdsim::reader
