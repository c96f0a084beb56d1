// A mesh as its file gives it: rotated to +y up, front towards +z, in the file's units. Floor 2, internal to content.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim {

/// How a texture continues beyond its borders.
enum class Wrap : std::int32_t { repeat, clamp, mirror };

/// What a surface reflects: colour x texture x vertex colour. It consists of plain bytes, since it is sent between processes.
struct Material {
    float colour[3] = {1, 1, 1};  // linear light
    std::int32_t texture = -1;    // index, -1: none
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    std::int32_t lit = 1;  // 0: the surface shows its colour without shading
    // 1: the texture's alpha is the share of light that it adds and hides; all triangles of such a material lie in one plane.
    std::int32_t see_through = 0;
};

/// A picture in sRGB codes, RGBA, row 0 at the top. v of a texture coordinate points up: (0, 0) is the lower left corner.
struct Texture {
    std::int32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// A triangle mesh with its materials and textures.
class Model {
  public:
    std::vector<float> positions;            // x, y, z of each vertex
    std::vector<float> normals;              // unit vectors, one for each vertex
    std::vector<float> uvs;                  // u, v of each vertex, in widths and heights of the texture
    std::vector<float> colours;              // r, g, b of each vertex, linear light; empty: white
    std::vector<std::uint32_t> indices;      // three vertices of each triangle
    std::vector<std::uint32_t> material_of;  // index of each triangle's material
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<std::string> notes;  // what was left out or repaired, in words
    std::vector<std::string> files;  // the files that were read: the model's own, and those that it names

    std::size_t vertices() const { return positions.size() / 3; }
    std::size_t triangles() const { return indices.size() / 3; }
};

/// Returns the bytes that a model's lists and textures take.
std::int64_t bytes_of(const Model&);

}  // namespace lfdsim
