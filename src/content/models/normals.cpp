#include "content/models/normals.h"

#include "geometry/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lfdsim {
namespace {

using Corners = std::array<Vec3d, 3>;

Corners corners_of(const Model& m, std::size_t triangle) {
    Corners all;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 3; ++c) all[k][c] = double(m.positions[3 * std::size_t(m.indices[3 * triangle + k]) + c]);
    return all;
}

// Returns the unit vector along v; (0, 0, 0) if v is too short or too long to have a direction.
Vec3d unit_or_zero(const Vec3d& v) {
    const double size = length(v);
    return size > 0 && std::isfinite(size) ? times(1 / size, v) : Vec3d{};
}

Vec3d face_normal(const Corners& p) { return unit_or_zero(cross(minus(p[1], p[0]), minus(p[2], p[0]))); }

// Returns the triangle's angle at corner k, radians.
double angle_at(const Corners& p, std::size_t k) {
    const Vec3d a = unit_or_zero(minus(p[(k + 1) % 3], p[k])), b = unit_or_zero(minus(p[(k + 2) % 3], p[k]));
    return std::acos(std::clamp(dot(a, b), -1., 1.));
}

// Expands a list with an entry for each vertex to one with an entry for each corner of the triangles.
void spread(std::vector<float>& of_vertices, const std::vector<std::uint32_t>& indices, std::size_t size) {
    std::vector<float> of_corners;
    of_corners.reserve(indices.size() * size);
    for (const std::uint32_t v : indices)
        for (std::size_t c = 0; c < size; ++c) of_corners.push_back(of_vertices[std::size_t(v) * size + c]);
    of_vertices = std::move(of_corners);
}

// Returns for each vertex the first one at the same position.
std::vector<std::uint32_t> first_at_place(const Model& m) {
    std::vector<std::uint32_t> order(m.vertices()), first(m.vertices());
    std::iota(order.begin(), order.end(), 0u);
    const auto place = [&](std::uint32_t v) {
        const float* const p = &m.positions[3 * std::size_t(v)];
        return std::array{p[0], p[1], p[2]};
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto pa = place(a), pb = place(b);
        return pa < pb || (pa == pb && a < b);
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

}  // namespace

void make_flat(Model& m) {
    spread(m.positions, m.indices, 3);
    spread(m.uvs, m.indices, 2);
    if (!m.colours.empty()) spread(m.colours, m.indices, 3);
    std::iota(m.indices.begin(), m.indices.end(), 0u);
    m.normals.clear();
    for (std::size_t t = 0; t < m.triangles(); ++t) {
        const Vec3d n = face_normal(corners_of(m, t));
        for (int k = 0; k < 3; ++k) m.normals.insert(m.normals.end(), {float(n[0]), float(n[1]), float(n[2])});
    }
}

void make_smooth(Model& m) {
    const std::vector<std::uint32_t> first = first_at_place(m);
    std::vector<Vec3d> sum(m.vertices());
    for (std::size_t t = 0; t < m.triangles(); ++t) {
        const Corners p = corners_of(m, t);
        const Vec3d n = face_normal(p);
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3d& to = sum[first[m.indices[3 * t + k]]];
            const double angle = angle_at(p, k);
            for (std::size_t c = 0; c < 3; ++c) to[c] += angle * n[c];
        }
    }
    for (std::size_t v = 0; v < m.vertices(); ++v) {
        const Vec3d n = unit_or_zero(sum[first[v]]);
        for (std::size_t c = 0; c < 3; ++c) m.normals[3 * v + c] = float(n[c]);
    }
}

}  // namespace lfdsim
