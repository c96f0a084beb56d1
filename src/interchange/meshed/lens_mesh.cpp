#include "interchange/meshed/lens_mesh.h"

#include "base/constants.h"
#include "geometry/prescription.h"
#include "geometry/resolve.h"
#include "geometry/vec.h"
#include "interchange/meshed/cell_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double touching = 1e-6;  // of the semi-aperture: rims closer together than this coincide

/// Returns the upward unit normal at this distance s from the axis: its components away from the axis and along z. It is along
/// (-dz/ds, 1), with dz/ds = c s/root + 4 a4 s^3 + ...; multiplied by root = sqrt(1 - (1 + k) c^2 s^2) it is finite at a half
/// ball's rim.
std::array<double, 2> normal(const PlacedSurface& s, double distance) {
    const double c = s.curvature_per_mm, d2 = distance * distance, root = std::sqrt(std::max(0.0, 1 - (1 + s.conic) * c * c * d2));
    double polynomial = 0;
    for (std::size_t i = s.even_asphere.size(); i-- > 0;) polynomial = polynomial * d2 + double(2 * (i + 2)) * s.even_asphere[i];
    const double across = -(c * distance + polynomial * d2 * distance * root), length = std::hypot(across, root);
    return {across / length, root / length};
}

/// The border of a surface in projection along the axis.
class Outline {
  public:
    Outline(const PlacedSurface& s, const Display& d, const Geometry& g, const std::vector<CellSide>& sides)
        : radius_(s.semi_aperture_mm),
          round_(d.array.aperture == Aperture::circle),
          reach_(round_ ? radius_ : std::min(radius_, outer_radius_mm(d, g))),
          sides_(sides) {}
    /// Returns the point at this share of the way round, counter-clockwise. A cell's outline begins in a corner; its sides have
    /// equal shares.
    std::array<double, 2> point(double share) const {
        if (round_) {
            const double angle = 2 * pi * share;
            return {radius_ * std::cos(angle), radius_ * std::sin(angle)};
        }
        const double sides = double(sides_.size());
        const std::size_t number = std::min(std::size_t(sides * share), sides_.size() - 1);
        const CellSide& side = sides_[number];
        const double out = side.from_axis_mm, along = side.half_length_mm * (2 * (sides * share - double(number)) - 1),
                     scale = std::min(1.0, radius_ / std::hypot(out, along));
        const double x = scale * out, y = scale * along;
        return {x * side.out[0] - y * side.out[1], x * side.out[1] + y * side.out[0]};
    }
    std::array<double, 2> middle_of_side() const { return point(0.5 / double(sides_.size())); }
    double reach() const { return reach_; }

  private:
    double radius_;  // semi-aperture
    bool round_;
    double reach_;  // greatest distance from the axis
    const std::vector<CellSide>& sides_;
};

/// The division of a curved surface: ring k has sectors x k vertices; the last ring is the rim.
struct Grid {
    int sectors, rings;
    int rim() const { return sectors * rings; }
};

/// A strip's slats, each cut into pieces along it: on very long triangles single precision loses points.
struct Slats {
    std::uint32_t across, along;
    std::uint32_t rim() const { return 2 * (across + along); }
};
constexpr double longest_slat = 64;  // times its width

/// Returns the distances from the axis that divide the surface's meridian evenly, the last one `reach`.
std::vector<double> ring_distances(const PlacedSurface& s, double reach, int rings) {
    constexpr int steps = 4096;
    const auto distance = [&](int i) { return reach * std::sin(0.5 * pi * i / steps); };  // dense at a steep rim
    std::vector<double> length(steps + 1, 0.0);
    for (int i = 1; i <= steps; ++i)
        length[i] = length[i - 1] + std::hypot(distance(i) - distance(i - 1), sag_mm(s, distance(i)) - sag_mm(s, distance(i - 1)));
    std::vector<double> all;
    for (int k = 1, i = 1; k < rings; ++k) {
        const double wanted = length[steps] * k / rings;
        while (length[i] < wanted) ++i;
        const double part = (wanted - length[i - 1]) / (length[i] - length[i - 1]);
        all.push_back(distance(i - 1) + part * (distance(i) - distance(i - 1)));
    }
    all.push_back(reach);
    return all;
}

/// Builds the mesh of a lens: its surfaces, from the panel's side, then the walls of each body of glass between two of them.
class Builder {
  public:
    Builder(const Display& display, const Geometry& geometry)
        : display_(display), geometry_(geometry), sides_(cell_sides(geometry)) {}

    LensMesh build(Grid grid) {
        const auto& surfaces = geometry_.surfaces;
        for (std::size_t k = 0; k < surfaces.size(); ++k) add_surface(int(k), grid);
        for (std::size_t k = 0; k + 1 < surfaces.size(); ++k)
            if (surfaces[k].index_above != 1) add_wall(rims_[k], rims_[k + 1], grid.rim(), touching * surfaces[k].semi_aperture_mm);
        return std::move(mesh_);
    }

    LensMesh build_strip(Slats slats) {
        const auto& surfaces = geometry_.surfaces;
        for (std::size_t k = 0; k < surfaces.size(); ++k) add_slats(int(k), slats);
        for (std::size_t k = 0; k + 1 < surfaces.size(); ++k)
            if (surfaces[k].index_above != 1)
                add_wall(rims_[k], rims_[k + 1], int(slats.rim()), touching * surfaces[k].semi_aperture_mm);
        return std::move(mesh_);
    }
    Slats slats(std::uint32_t across) const {
        const double along = sides_[0].half_length_mm / (longest_slat * sides_[0].from_axis_mm) * across;
        return {across, std::uint32_t(std::max(1.0, std::ceil(along)))};
    }
    /// Returns the slats whose number of triangles is closest to the wanted one.
    Slats choose_slats(double wanted) const {
        double bodies = 0;
        for (std::size_t k = 0; k + 1 < geometry_.surfaces.size(); ++k) bodies += geometry_.surfaces[k].index_above != 1;
        const auto excess = [&](std::uint32_t across) {
            const Slats s = slats(across);
            return 2 * double(geometry_.surfaces.size()) * s.across * s.along + 2 * bodies * s.rim() - wanted;
        };
        std::uint32_t across = 1;
        while (excess(across + 1) < -excess(across)) ++across;
        return slats(across);
    }

    /// Returns the number of triangles of such a mesh; exact but for walls of lenses that fill their cells, whose rims touch in
    /// parts.
    double count(Grid grid) const {
        double sum = 0;
        const auto& surfaces = geometry_.surfaces;
        for (std::size_t k = 0; k < surfaces.size(); ++k) {
            sum += double(grid.rim()) * (is_plane(surfaces[k]) ? 1 : grid.rings);
            if (k + 1 < surfaces.size() && surfaces[k].index_above != 1 && !rims_touch(surfaces[k], surfaces[k + 1]))
                sum += 2.0 * grid.rim();
        }
        return sum;
    }

  private:
    /// Returns whether the rims of two surfaces coincide, so that there is no wall between them.
    bool rims_touch(const PlacedSurface& a, const PlacedSurface& b) const {
        // Most points of a cell's outline are closer to the axis than its corners: the middle of a side represents them.
        const auto middle = Outline(a, display_, geometry_, sides_).middle_of_side();
        const double x = std::hypot(middle[0], middle[1]);
        const double near = touching * a.semi_aperture_mm;
        return std::abs(a.semi_aperture_mm - b.semi_aperture_mm) < near &&
               std::abs(a.z_mm + sag_mm(a, x) - b.z_mm - sag_mm(b, x)) < near;
    }

    std::uint32_t add_vertex(double x, double y, double z, const Vec3d& n) {
        for (const double p : {x, y, z}) mesh_.vertices_mm.push_back(float(p));
        for (const double p : n) mesh_.normals.push_back(float(p));
        return std::uint32_t(mesh_.vertices_mm.size() / 3 - 1);
    }
    bool same_place(std::uint32_t a, std::uint32_t b) const {
        return std::equal(&mesh_.vertices_mm[3 * a], &mesh_.vertices_mm[3 * a] + 3, &mesh_.vertices_mm[3 * b]);
    }
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::int32_t surface) {
        if (same_place(a, b) || same_place(b, c) || same_place(c, a)) return;
        mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
        mesh_.surface_of.push_back(surface);
    }

    /// Adds a surface, and the first vertex of its rim to rims_.
    void add_surface(int number, Grid grid) {
        const PlacedSurface& s = geometry_.surfaces[std::size_t(number)];
        const Outline outline(s, display_, geometry_, sides_);
        const bool plane = is_plane(s), down = s.index_below == 1;
        const double vertex_z = s.z_mm - geometry_.base_z_mm, sense = down ? -1 : 1;
        const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            down ? add_triangle(a, c, b, number) : add_triangle(a, b, c, number);
        };
        const std::vector<double> distances = plane ? std::vector{outline.reach()} : ring_distances(s, outline.reach(), grid.rings);
        std::uint32_t inner = add_vertex(0, 0, vertex_z, {0, 0, sense});  // first vertex of the ring within
        for (std::size_t k = 1; k <= distances.size(); ++k) {
            const auto around = std::uint32_t(plane ? grid.rim() : grid.sectors * int(k));
            const auto outer = std::uint32_t(mesh_.vertices_mm.size() / 3);
            for (std::uint32_t j = 0; j < around; ++j) {
                const auto [border_x, border_y] = outline.point(double(j) / around);
                const double scale = distances[k - 1] / outline.reach(), x = scale * border_x, y = scale * border_y;
                const double distance = std::hypot(x, y);
                const auto [across, up] = normal(s, distance);
                add_vertex(x, y, vertex_z + sag_mm(s, distance),
                           {sense * across * x / distance, sense * across * y / distance, sense * up});
            }
            // Triangles to the ring within: a fan about the pole, then sectors of 2 k - 1 triangles
            if (k == 1) {
                for (std::uint32_t j = 0; j < around; ++j) face(inner, outer + j, outer + (j + 1) % around);
            } else {
                const auto step = std::uint32_t(k), within = around - std::uint32_t(grid.sectors);
                for (int sector = 0; sector < grid.sectors; ++sector) {
                    const auto a = [&](std::uint32_t j) { return outer + (std::uint32_t(sector) * step + j) % around; };
                    const auto b = [&](std::uint32_t j) { return inner + (std::uint32_t(sector) * (step - 1) + j) % within; };
                    for (std::uint32_t j = 0; j < step; ++j) {
                        face(b(j), a(j), a(j + 1));
                        if (j + 1 < step) face(b(j), a(j + 1), b(j + 1));
                    }
                }
            }
            inner = outer;
        }
        rims_.push_back(inner);
    }

    /// Adds a surface of a strip, a section extruded along y, and the first vertex of its rim to rims_. The section's points are
    /// closer to each other towards the rim, where it may be steep.
    void add_slats(int number, Slats slats) {
        const PlacedSurface& s = geometry_.surfaces[std::size_t(number)];
        const bool down = s.index_below == 1;
        const double r = s.semi_aperture_mm,
                     half = display_.array.aperture == Aperture::cell ? std::min(r, sides_[0].from_axis_mm) : r,
                     sense = down ? -1 : 1;
        const auto first = std::uint32_t(mesh_.vertices_mm.size() / 3), n = slats.across, m = slats.along;
        const auto add = [&](std::uint32_t i, std::uint32_t j) {
            const double x = half * std::sin(0.5 * pi * (2.0 * i / n - 1)), y = sides_[0].half_length_mm * (2.0 * j / m - 1);
            const auto [across, up] = normal(s, std::abs(x));
            add_vertex(x, y, s.z_mm - geometry_.base_z_mm + sag_mm(s, std::abs(x)),
                       {sense * (x < 0 ? -across : across), 0, sense * up});
        };
        // The rim first, counter-clockwise
        for (std::uint32_t i = 0; i < n; ++i) add(i, 0);
        for (std::uint32_t j = 0; j < m; ++j) add(n, j);
        for (std::uint32_t i = n; i > 0; --i) add(i, m);
        for (std::uint32_t j = m; j > 0; --j) add(0, j);
        for (std::uint32_t j = 1; j < m; ++j)
            for (std::uint32_t i = 1; i < n; ++i) add(i, j);
        // The number of the vertex at column i of n and row j of m, which depends on the side of the rim that it is on
        const auto at = [&](std::uint32_t i, std::uint32_t j) {
            if (j == 0) return first + i;
            if (i == n) return first + n + j;
            if (j == m) return first + n + m + (n - i);
            if (i == 0) return first + 2 * n + m + (m - j);
            return first + slats.rim() + (j - 1) * (n - 1) + (i - 1);
        };
        for (std::uint32_t j = 0; j < m; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
                down ? add_triangle(a, c, b, number) : add_triangle(a, b, c, number);
                down ? add_triangle(a, d, c, number) : add_triangle(a, c, d, number);
            }
        rims_.push_back(first);
    }

    /// Adds the wall between the rims of two surfaces, each of `around` vertices in sequence. Where the rims are closer than `near`
    /// they are joined and there is no wall.
    void add_wall(std::uint32_t lower, std::uint32_t upper, int around, double near) {
        for (std::uint32_t k = 0; k < std::uint32_t(around); ++k) {
            const float* from = &mesh_.vertices_mm[3 * (lower + k)];
            float* to = &mesh_.vertices_mm[3 * (upper + k)];
            if (std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) < near) std::copy(from, from + 3, to);
        }
        for (std::uint32_t k = 0; k < std::uint32_t(around); ++k) {
            const std::uint32_t next = (k + 1) % std::uint32_t(around);
            const std::uint32_t corner[4] = {lower + k, lower + next, upper + next, upper + k};
            Vec3d at[4];
            for (int i = 0; i < 4; ++i)
                for (std::size_t c = 0; c < 3; ++c) at[i][c] = mesh_.vertices_mm[3 * corner[i] + c];
            std::uint32_t copy[4];
            for (int i = 0; i < 4; ++i) copy[i] = add_vertex(at[i][0], at[i][1], at[i][2], wall_normal(at, i));
            add_triangle(copy[0], copy[1], copy[2], LensMesh::wall);
            add_triangle(copy[0], copy[2], copy[3], LensMesh::wall);
        }
    }

    /// Returns the normal at corner i of a wall's quadrilateral, lower edge first: a round wall is a cone, a cell's has flat sides.
    Vec3d wall_normal(const Vec3d (&at)[4], int i) const {
        Vec3d n;
        if (display_.array.aperture == Aperture::circle && !is_strips(display_.array)) {
            const Vec3d &low = at[i == 0 || i == 3 ? 0 : 1], &high = at[i == 0 || i == 3 ? 3 : 2];
            const double out = std::hypot(at[i][0], at[i][1]), rise = high[2] - low[2];
            n = {rise * at[i][0] / out, rise * at[i][1] / out, std::hypot(low[0], low[1]) - std::hypot(high[0], high[1])};
        } else {
            // From the diagonals: neither vanishes where the wall ends in a point.
            n = cross(minus(at[2], at[0]), minus(at[3], at[1]));
        }
        return length(n) > 0 ? normalised(n) : Vec3d{};
    }

    const Display& display_;
    const Geometry& geometry_;
    const std::vector<CellSide> sides_;
    LensMesh mesh_;
    std::vector<std::uint32_t> rims_;  // first vertex of each surface's rim
};

/// Returns the grid whose number of triangles is closest to the wanted one; among equally close ones that of the best shape: six
/// sectors, or two to a rectangle's side. `sides`: of the cells that lenses fill; 0 for round lenses.
Grid choose_grid(const Builder& builder, int sides, double wanted) {
    Grid best{};
    double least = INFINITY;
    const std::vector<int> choice = sides == 0   ? std::vector{3, 4, 5, 6, 7, 8}
                                    : sides == 4 ? std::vector{4, 8, 12, 16}
                                                 : std::vector{6, 12, 18};
    for (const int sectors : choice) {
        int rings = 1;  // the most that do not give too many triangles
        for (int step = 1024; step > 0; step /= 2)
            if (builder.count({sectors, rings + step}) <= wanted) rings += step;
        for (const int more : {0, 1}) {
            const Grid grid{sectors, rings + more};
            const double cost = std::abs(std::log(builder.count(grid) / wanted)) + 0.01 * std::abs(sectors - (sides == 4 ? 8 : 6));
            if (cost < least) least = cost, best = grid;
        }
    }
    return best;
}

}  // namespace

LensMesh mesh_lens(const Display& display, const Geometry& geometry, std::int64_t triangles) {
    if (geometry.surfaces.front().form == SurfaceForm::thin)
        throw InputError("lens.type", "an ideal lens or a pinhole has no surfaces to make triangles of; give a real lens");
    if (triangles < least_lens_triangles || triangles > most_lens_triangles)
        throw InputError("--lens-mesh",
                         fmt::format("{} triangles; allowed: {} to {}", triangles, least_lens_triangles, most_lens_triangles));
    Builder builder(display, geometry);
    if (is_strips(display.array)) return builder.build_strip(builder.choose_slats(double(triangles)));
    const int sides = display.array.aperture == Aperture::circle ? 0 : cell_corners(geometry).count;
    return builder.build(choose_grid(builder, sides, double(triangles)));
}

}  // namespace lfdsim
