#include "content/reader/gltf_transforms.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

namespace lfdsim::reader {
namespace {

using Json = nlohmann::json;

// A .glb file has a header of 12 bytes, then chunks, each with its length and kind before it; the first is the description.
Json description(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::size_t start = 0, count = bytes.size();
    if (bytes.starts_with("glTF") && bytes.size() >= 20) {
        std::uint32_t length = 0;
        std::memcpy(&length, &bytes[12], 4);
        start = 20;
        count = std::min<std::size_t>(length, bytes.size() - start);
    }
    return Json::parse(bytes.begin() + std::ptrdiff_t(start), bytes.begin() + std::ptrdiff_t(start + count), nullptr, false);
}

// The value at a path of keys, null where there is none.
Json value_of(const Json& from, std::initializer_list<const char*> keys) {
    const Json* here = &from;
    for (const char* key : keys) {
        if (!here->is_object() || !here->contains(key)) return {};
        here = &(*here)[key];
    }
    return *here;
}

void read_two(const Json& list, double* to) {
    if (!list.is_array() || list.size() != 2 || !list[0].is_number() || !list[1].is_number()) return;
    to[0] = list[0].get<double>();
    to[1] = list[1].get<double>();
}

UvTransform transform_of(const Json& extension) {
    UvTransform t;
    read_two(value_of(extension, {"offset"}), t.offset);
    read_two(value_of(extension, {"scale"}), t.scale);
    if (const Json turn = value_of(extension, {"rotation"}); turn.is_number()) t.rotation = turn.get<double>();
    if (const Json channel = value_of(extension, {"texCoord"}); channel.is_number_unsigned()) t.channel = channel.get<unsigned>();
    return t;
}

}  // namespace

aiVector3D UvTransform::operator()(const aiVector3D& uv) const {
    const double u = scale[0] * double(uv.x), v = scale[1] * (1 - double(uv.y)), c = std::cos(rotation), s = std::sin(rotation);
    return {float(offset[0] + c * u + s * v), float(1 - (offset[1] - s * u + c * v)), 0};
}

std::map<unsigned, UvTransform> gltf_transforms(const std::filesystem::path& file) {
    std::map<unsigned, UvTransform> all;
    const Json materials = value_of(description(file), {"materials"});
    for (std::size_t i = 0; materials.is_array() && i < materials.size(); ++i) {
        const Json extension =
            value_of(materials[i], {"pbrMetallicRoughness", "baseColorTexture", "extensions", "KHR_texture_transform"});
        if (extension.is_object()) all[unsigned(i)] = transform_of(extension);
    }
    return all;
}

}  // namespace lfdsim::reader
