// A mesh as its file gives it: turned to +y up, front towards +z, in the file's own units. Floor 2, internal to content.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim {

enum class Wrap : std::int32_t { repeat, clamp, mirror };

/// What a surface reflects: colour x texture x vertex colour. Plain bytes: it travels between processes.
struct Material {
    float colour[3] = {1, 1, 1};  // linear light
    std::int32_t texture = -1;    // index, -1: none
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    std::int32_t lit = 1;          // 0: shines in its own colour, whatever the light
    std::int32_t see_through = 0;  // 1: the texture's alpha is the share of light that it adds, and hides; such triangles of one
                                   // material lie in one plane
};

/// sRGB codes, RGBA, row 0 at the top; v of a texture coordinate points up, (0, 0) is the lower left corner.
struct Texture {
    std::int32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

class Model {
  public:
    std::vector<float> positions;            // x, y, z of each vertex
    std::vector<float> normals;              // unit vectors, one for each vertex
    std::vector<float> uvs;                  // u, v of each vertex
    std::vector<float> colours;              // r, g, b of each vertex, linear light; empty: white
    std::vector<std::uint32_t> indices;      // three vertices for each triangle
    std::vector<std::uint32_t> material_of;  // of each triangle
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<std::string> notes;  // what was dropped or repaired
    std::vector<std::string> files;  // that were read: the model's own, and those that it names

    std::size_t vertices() const { return positions.size() / 3; }
    std::size_t triangles() const { return indices.size() / 3; }
};

/// Memory that it takes.
std::int64_t bytes_of(const Model&);

}  // namespace lfdsim
