// The nodes of a glTF file: their transforms, and which of them its scene shows.
#pragma once
#include "content/reader/gltf/gltf_file.h"
#include "content/reader/places.h"

#include <assimp/types.h>

#include <vector>

namespace lfdsim::reader {

using Matrix = aiMatrix4x4t<double>;

/// The trees of nodes.
class GltfNodes {
  public:
    /// Throws std::runtime_error if the nodes do not form trees.
    explicit GltfNodes(const GltfFile&);

    /// Returns the transform from a node's coordinates to the scene's.
    const Matrix& world(std::size_t node) const { return world_[node]; }
    /// Returns the nodes of the file's scene, in its order; of a file without scenes, all nodes. Nodes that KHR_node_visibility
    /// hides, and those below them, are left out.
    std::vector<std::size_t> shown() const;

  private:
    const GltfFile& file_;
    std::vector<std::size_t> parents_;
    std::vector<Matrix> world_;
};

/// Returns translation x rotation (a quaternion x, y, z, w of any length) x scale.
Matrix placed(const double* translation, const double* rotation, const double* scale);

}  // namespace lfdsim::reader
