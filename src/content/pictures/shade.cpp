// Shading of a packet of rays. docs/model.md, "Shading". Corners of triangles are fetched lane by lane; the arithmetic is in
// loops over all lanes without branches, which the compiler turns into SIMD.

#include "content/pictures/scene.h"
#include "simd/elementary.h"
#include "simd/simd.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int lanes = Lanes::count;

/// The triangles that the rays hit: numbers of their corners and barycentric weights.
struct TriangleHit {
    std::uint32_t triangle[lanes], corner[3][lanes];
    Lanes weight[3];

    TriangleHit(const Model& m, const RTCHit16& hit, const Lanes::Mask& valid) {
        for (int k = 0; k < lanes; ++k) {
            triangle[k] = hit.primID[k] & std::uint32_t(valid.of[k]);  // of a lane without a hit: the first triangle
            weight[1].of[k] = hit.u[k];
            weight[2].of[k] = hit.v[k];
            weight[0].of[k] = 1 - hit.u[k] - hit.v[k];
        }
        for (int k = 0; k < lanes; ++k)
            for (std::size_t c = 0; c < 3; ++c) corner[c][k] = m.indices[3 * std::size_t(triangle[k]) + c];
    }

    /// Interpolates vertex attributes of `size` components.
    template <int size>
    void interpolate(const std::vector<float>& of_vertices, Lanes* to) const {
        Lanes at[3][size];
        for (int k = 0; k < lanes; ++k) {
            for (int c = 0; c < 3; ++c) {
                const float* const from = &of_vertices[size * std::size_t(corner[c][k])];
                for (int i = 0; i < size; ++i) at[c][i].of[k] = from[i];
            }
        }
        for (int i = 0; i < size; ++i)
            for (int k = 0; k < lanes; ++k)
                to[i].of[k] =
                    weight[0].of[k] * at[0][i].of[k] + weight[1].of[k] * at[1][i].of[k] + weight[2].of[k] * at[2][i].of[k];
    }
};

}  // namespace

void ContentScene::Impl::shade(const RTCHit16& hit, const Lanes::Mask& valid, const Lanes& width_mm, Lanes* out,
                               Lanes* through) const {
    const Model& m = *model;
    const TriangleHit place(m, hit, valid);
    // shine = a + s max(0, n.l); n need not be a unit vector after interpolation.
    Lanes n[3], shine;
    place.interpolate<3>(m.normals, n);
    for (int k = 0; k < lanes; ++k) {
        const float x = n[0].of[k], y = n[1].of[k], z = n[2].of[k], length = std::sqrt(x * x + y * y + z * z);
        const float cosine = (x * light[0] + y * light[1] + z * light[2]) / length;
        shine.of[k] = ambient + strength * (length > 0 && cosine > 0 ? cosine : 0.f);
    }
    for (int k = 0; k < lanes; ++k) {
        const Material& material = m.materials[m.material_of[place.triangle[k]]];
        for (int c = 0; c < 3; ++c) out[c].of[k] = material.colour[c];
        if (!material.lit) shine.of[k] = 1;
    }
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k < lanes; ++k) out[c].of[k] *= shine.of[k];

    if (through) std::fill_n(through->of, lanes, 0.f);
    if (!textures.empty()) {
        // The filter's level is the logarithm of the ray's width in texels.
        Lanes uv[2], level;
        place.interpolate<2>(m.uvs, uv);
        for (int k = 0; k < lanes; ++k) level.of[k] = texels_per_mm[place.triangle[k]];
        using Four = optics::Lane<4>;
        for (int k = 0; k < lanes; k += 4) {
            const Four texels = optics::load<Four>(&width_mm.of[k]) * optics::load<Four>(&level.of[k]);
            const Four logarithm = optics::log2(optics::max(texels, Four(1.f)));
            for (int i = 0; i < 4; ++i) level.of[k + i] = logarithm.v[i];
        }
        for (int k = 0; k < lanes; ++k) {
            const Material& material = m.materials[m.material_of[place.triangle[k]]];
            if (!valid.of[k] || material.texture < 0) continue;
            const Texel texel = textures[std::size_t(material.texture)].sample(uv[0].of[k], uv[1].of[k], level.of[k],
                                                                               material.wrap_u, material.wrap_v);
            for (int c = 0; c < 3; ++c) out[c].of[k] *= texel[c];
            if (through && material.see_through) through->of[k] = 1 - texel[3];
        }
    }
    if (!m.colours.empty()) {
        Lanes colour[3];
        place.interpolate<3>(m.colours, colour);
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < lanes; ++k) out[c].of[k] *= colour[c].of[k];
    }
}

}  // namespace lfdsim
