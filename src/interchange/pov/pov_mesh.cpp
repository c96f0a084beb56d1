#include "interchange/pov/pov_mesh.h"

#include <fmt/format.h>
#include <iterator>

namespace lfdsim::peers {
namespace {

/// Appends a list of triples. fmt writes each float with the fewest digits that read back as the same float.
template <class T>
void add_list(std::string& text, const char* name, const std::vector<T>& all) {
    fmt::format_to(std::back_inserter(text), "  {} {{ {}", name, all.size() / 3);
    for (std::size_t i = 0; i + 2 < all.size(); i += 3)
        fmt::format_to(std::back_inserter(text), ",{}<{},{},{}>", i % 12 == 0 ? "\n   " : "", all[i], all[i + 1], all[i + 2]);
    text += " }\n";
}

}  // namespace

std::string pov_mesh(const Patch& patch, bool smooth) {
    std::string text = "mesh2 {\n";
    add_list(text, "vertex_vectors", patch.vertices_mm);
    if (smooth) add_list(text, "normal_vectors", patch.normals);
    add_list(text, "face_indices", patch.triangles);
    return text;
}

}  // namespace lfdsim::peers
