#include "interchange/peers/ply.h"

#include <fmt/format.h>
#include <bit>
#include <cstring>

namespace lfdsim::peers {

static_assert(std::endian::native == std::endian::little);

std::string ply(const Patch& patch) {
    const std::size_t vertices = patch.vertices_mm.size() / 3;
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        vertices, patch.count());
    const std::size_t head = bytes.size();
    bytes.resize(head + vertices * 24 + patch.count() * 13);
    char* to = bytes.data() + head;
    const auto put = [&](const void* from, std::size_t size) {
        std::memcpy(to, from, size);
        to += size;
    };
    for (std::size_t v = 0; v < vertices; ++v) {
        put(&patch.vertices_mm[3 * v], 12);
        put(&patch.normals[3 * v], 12);
    }
    const unsigned char three = 3;
    for (std::size_t t = 0; t < patch.count(); ++t) {
        put(&three, 1);
        put(&patch.triangles[3 * t], 12);
    }
    return bytes;
}

}  // namespace lfdsim::peers
