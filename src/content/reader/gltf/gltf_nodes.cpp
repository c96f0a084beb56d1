#include "content/reader/gltf/gltf_nodes.h"

#include <cstdint>

namespace lfdsim::reader {
namespace {

constexpr std::size_t no_parent = SIZE_MAX;

// Returns a node's transform relative to its parent.
Matrix local(const Item& node) {
    if (node.has("matrix")) {  // column by column
        const auto m = node.at("matrix").numbers<16>({});
        return {m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14], m[3], m[7], m[11], m[15]};
    }
    return placed(node.at("translation").numbers<3>({0, 0, 0}).data(), node.at("rotation").numbers<4>({0, 0, 0, 1}).data(),
                  node.at("scale").numbers<3>({1, 1, 1}).data());
}

/// Returns the rotation that turns the front to +z, where it is by glTF and VRM 1.0; VRM 0.x has it at -z.
Matrix to_front(const Item& root) {
    const Item extensions = root.at("extensions");
    const double turn = extensions.has("VRM") && !extensions.has("VRMC_vrm") ? -1 : 1;
    return {turn, 0, 0, 0, 0, 1, 0, 0, 0, 0, turn, 0, 0, 0, 0, 1};
}

}  // namespace

Matrix placed(const double* t, const double* q, const double* s) {
    // The matrix is that of the unit quaternion; one of length 0 means no rotation.
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = size > 0 ? q[0] / size : 0, y = size > 0 ? q[1] / size : 0, z = size > 0 ? q[2] / size : 0,
                 w = size > 0 ? q[3] / size : 1;
    return {s[0] * (1 - 2 * (y * y + z * z)),
            s[1] * 2 * (x * y - z * w),
            s[2] * 2 * (x * z + y * w),
            t[0],
            s[0] * 2 * (x * y + z * w),
            s[1] * (1 - 2 * (x * x + z * z)),
            s[2] * 2 * (y * z - x * w),
            t[1],
            s[0] * 2 * (x * z - y * w),
            s[1] * 2 * (y * z + x * w),
            s[2] * (1 - 2 * (x * x + y * y)),
            t[2],
            0,
            0,
            0,
            1};
}

GltfNodes::GltfNodes(const GltfFile& file) : file_(file) {
    const Item nodes = file.root().at("nodes");
    parents_.assign(nodes.size(), no_parent);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Item children = nodes[i].at("children");
        for (std::size_t k = 0; k < children.size(); ++k) {
            file.named(children[k], "nodes");
            std::size_t& parent = parents_[children[k].whole(0)];
            if (parent != no_parent) children[k].fail("is also a child of another node");
            parent = i;
        }
    }
    const Matrix front = to_front(file.root());
    world_.resize(nodes.size());
    std::vector<bool> known(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::vector<std::size_t> line;  // from this node up to one whose transform is known
        for (std::size_t n = i; n != no_parent && !known[n]; n = parents_[n]) {
            if (line.size() == nodes.size()) nodes[i].fail("is a descendant of itself");
            line.push_back(n);
        }
        for (; !line.empty(); line.pop_back()) {
            const std::size_t n = line.back();
            world_[n] = (parents_[n] == no_parent ? front : world_[parents_[n]]) * local(nodes[n]);
            known[n] = true;
        }
    }
}

std::vector<std::size_t> GltfNodes::shown() const {
    const Item root = file_.root(), nodes = root.at("nodes");
    auto scene = file_.named(root.at("scene"), "scenes");
    if (!scene && root.at("scenes").size() > 0) scene = root.at("scenes")[0];
    std::vector<std::size_t> open, found;  // open: nodes still to visit, the last one first
    if (scene) {
        const Item first = scene->at("nodes");
        for (std::size_t k = first.size(); k-- > 0;) {
            file_.named(first[k], "nodes");
            open.push_back(first[k].whole(0));
        }
    } else {
        for (std::size_t k = nodes.size(); k-- > 0;)
            if (parents_[k] == no_parent) open.push_back(k);
    }
    // Depth first, a parent before its children; a node that is listed twice counts once.
    std::vector<bool> seen(nodes.size());
    while (!open.empty()) {
        const std::size_t n = open.back();
        open.pop_back();
        if (seen[n]) continue;
        seen[n] = true;
        if (!nodes[n].at("extensions").at("KHR_node_visibility").at("visible").truth(true)) continue;
        found.push_back(n);
        const Item children = nodes[n].at("children");
        for (std::size_t k = children.size(); k-- > 0;) open.push_back(children[k].whole(0));
    }
    return found;
}

}  // namespace lfdsim::reader
