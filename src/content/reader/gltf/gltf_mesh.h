// Primitives of glTF meshes, as triangles in the scene's coordinates.
#pragma once
#include "content/reader/gltf/gltf_draco.h"
#include "content/reader/gltf/gltf_materials.h"
#include "content/reader/gltf/gltf_nodes.h"

#include <memory>

namespace lfdsim::reader {

/// A mesh without its positions, and these in double precision.
struct Piece {
    std::unique_ptr<aiMesh> mesh;
    std::vector<Place> places;
};

/// How the vertices of a node's mesh are moved into the scene: each by its joints if there are any, else all by each of
/// `instances`.
struct Posing {
    std::vector<Matrix> instances, joints;
    std::vector<double> morph_weights;
};

/// The triangles of all meshes of a scene.
class GltfMeshes {
  public:
    GltfMeshes(GltfFile& file, NotShown& not_shown) : file_(file), not_shown_(not_shown), materials_(file) {}

    /// Adds the mesh of a node.
    void add(const Item& mesh, const Posing&);

    std::vector<Piece> pieces;
    GltfMaterials& materials() { return materials_; }
    std::size_t points() const { return points_; }  // vertices of points and lines, which are left out

  private:
    struct Primitive;
    struct Vertices;
    void add_primitive(const Item& primitive, const Posing&);
    std::optional<AccessorValues> numbers(const Primitive&, const std::string& attribute);
    std::optional<AccessorValues> posed(const Primitive&, const char* attribute, const Posing&, std::size_t least,
                                        std::size_t most);
    std::vector<std::uint32_t> triangles(const Primitive&, std::size_t mode, std::size_t vertices);
    std::vector<Matrix> joint_matrices(const Primitive&, const Posing&, std::size_t vertices);
    void place(const Vertices&, const std::vector<Matrix>& at);

    GltfFile& file_;
    NotShown& not_shown_;
    GltfMaterials materials_;
    std::size_t points_ = 0, vertices_ = 0;
};

}  // namespace lfdsim::reader
