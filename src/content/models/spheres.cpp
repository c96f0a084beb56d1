// The built-in model, with which a display can be looked at and measured without a mesh file: five chequered spheres at five
// depths, whose squares show where a picture is blurred or repeated.
#include "base/constants.h"
#include "content/content.h"
#include "content/models/model.h"

#include <array>
#include <cmath>

namespace lfdsim {
namespace {

/// A sphere of the model, in its units.
struct Sphere {
    std::array<float, 3> middle;
    float radius;
    std::array<std::uint8_t, 3> light, dark;  // sRGB codes of its squares
};
// The spheres fill a cube: the box reaches from -1 to 1 along every axis.
constexpr Sphere spheres[] = {
    {{0, 0, 0}, 0.42f, {235, 235, 235}, {40, 40, 40}},
    {{-0.62f, 0.62f, -0.62f}, 0.38f, {230, 90, 60}, {60, 20, 10}},
    {{0.62f, 0.62f, 0.31f}, 0.38f, {240, 200, 60}, {70, 50, 10}},
    {{-0.62f, -0.62f, -0.31f}, 0.38f, {70, 150, 240}, {10, 30, 70}},
    {{0.62f, -0.62f, 0.62f}, 0.38f, {80, 200, 110}, {10, 50, 20}},
};
// Squares around and from pole to pole; texels along a square
constexpr int squares_round = 16, squares_up = 8, square_texels = 16;
constexpr int steps_round = 128, steps_up = 64;  // of the mesh

Texture chequered(const Sphere& s) {
    Texture t{squares_round * square_texels, squares_up * square_texels, {}};
    for (int row = 0; row < t.height; ++row)
        for (int column = 0; column < t.width; ++column) {
            const auto& codes = (row / square_texels + column / square_texels) % 2 ? s.dark : s.light;
            t.rgba.insert(t.rgba.end(), {codes[0], codes[1], codes[2], 255});
        }
    return t;
}

/// Adds a sphere as a mesh of latitudes and longitudes.
void add(Model& m, const Sphere& s) {
    const auto first = std::uint32_t(m.vertices()), material = std::uint32_t(m.materials.size());
    for (int j = 0; j <= steps_up; ++j)
        for (int i = 0; i <= steps_round; ++i) {
            const double u = double(i) / steps_round, v = double(j) / steps_up;
            const double turn = 2 * pi * u, up = pi * (v - 0.5);
            const float n[3] = {float(std::cos(up) * std::sin(turn)), float(std::sin(up)), float(-std::cos(up) * std::cos(turn))};
            for (std::size_t k = 0; k < 3; ++k) {
                m.normals.push_back(n[k]);
                m.positions.push_back(s.middle[k] + s.radius * n[k]);
            }
            m.uvs.insert(m.uvs.end(), {float(u), float(v)});
        }
    const auto vertex = [&](int i, int j) { return first + std::uint32_t(j * (steps_round + 1) + i); };
    for (int j = 0; j < steps_up; ++j)
        for (int i = 0; i < steps_round; ++i) {
            // Triangles are counter-clockwise from outside; those at the poles that have no area are left out.
            if (j > 0) m.indices.insert(m.indices.end(), {vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)});
            if (j + 1 < steps_up) m.indices.insert(m.indices.end(), {vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
        }
    m.material_of.resize(m.triangles(), material);
    m.materials.push_back({{1, 1, 1}, std::int32_t(m.textures.size()), Wrap::repeat, Wrap::clamp});
    m.textures.push_back(chequered(s));
}

}  // namespace

std::shared_ptr<const Model> built_in_model() {
    static const std::shared_ptr<const Model> made = [] {
        auto model = std::make_shared<Model>();
        for (const Sphere& s : spheres) add(*model, s);
        return model;
    }();
    return made;
}

}  // namespace lfdsim
