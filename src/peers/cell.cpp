#include "peers/cell.h"

#include "meshed/lens_mesh.h"
#include "model/numbers.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim::peers {
namespace {

using Point = std::array<double, 3>;

// Black rings of neighbours overlap by this much, and lie this far in front of a flat face at the same height, so that no ray
// passes between.
constexpr double solid_overlap_mm = 1e-3;

std::uint32_t add_vertex(Patch& patch, const Point& at, const Point& normal) {
    for (const double p : at) patch.vertices_mm.push_back(float(p));
    for (const double p : normal) patch.normals.push_back(float(p));
    return std::uint32_t(patch.vertices_mm.size() / 3 - 1);
}

void add_triangle(Patch& patch, const Point& a, const Point& b, const Point& c, const Point& normal) {
    if (a == b || b == c || c == a) return;
    for (const Point& p : {a, b, c}) patch.triangles.push_back(add_vertex(patch, p, normal));
}

constexpr Point up{0, 0, 1};

double angle(const Point& p) { return std::atan2(p[1], p[0]); }

// The border of one surface of the lens, by its angle about the axis.
std::vector<Point> rim(const LensMesh& mesh, std::int32_t surface) {
    std::vector<std::uint64_t> edges;  // those that belong to only one triangle are the border
    for (std::size_t t = 0; t < mesh.count(); ++t) {
        if (mesh.surface_of[t] != surface) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax({mesh.triangles[3 * t + i], mesh.triangles[3 * t + (i + 1) % 3]});
            edges.push_back(std::uint64_t(low) << 32 | high);
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<Point> points;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i + 1 < edges.size() && edges[i] == edges[i + 1]) {
            ++i;
            continue;
        }
        for (const std::uint64_t v : {edges[i] >> 32, edges[i] & 0xffffffffu})
            points.push_back({mesh.vertices_mm[3 * v], mesh.vertices_mm[3 * v + 1], mesh.vertices_mm[3 * v + 2]});
    }
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return angle(a) < angle(b); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

std::vector<Point> circle(double radius, std::size_t count) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = 2 * pi * (double(i) / double(count) - 0.5);
        points.push_back({radius * std::cos(a), radius * std::sin(a), 0});
    }
    return points;
}

// The face from a polygon about the axis to the cell's border, and `wider` beyond it, all at one height; nothing where the polygon
// lies on the border.
void add_ring(Patch& patch, const std::vector<Point>& inner, double z, const std::array<double, 2>& half, double wider) {
    const double reach[] = {half[0] + wider, half[1] + wider};
    struct Pair {
        Point in, out;
    };
    std::vector<Pair> pairs;
    const auto on_border = [&](const Point& p) {
        const bool beside = std::abs(p[0]) * reach[1] >= std::abs(p[1]) * reach[0];
        const double scale = beside ? reach[0] / std::abs(p[0]) : reach[1] / std::abs(p[1]);
        return beside ? Point{std::copysign(reach[0], p[0]), p[1] * scale, z}
                      : Point{p[0] * scale, std::copysign(reach[1], p[1]), z};
    };
    for (const Point& p : inner) pairs.push_back({{p[0], p[1], z}, on_border(p)});
    const std::size_t count = pairs.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Pair &a = pairs[i], &b = pairs[(i + 1) % count];
        const auto border = [&](const Point& p) { return std::abs(p[0]) >= half[0] - 1e-6 || std::abs(p[1]) >= half[1] - 1e-6; };
        if (border(a.in) && border(b.in)) continue;
        add_triangle(patch, a.in, a.out, b.in, up);
        add_triangle(patch, b.in, a.out, b.out, up);
        if (std::abs(a.out[0]) == reach[0] && std::abs(b.out[1]) == reach[1] && std::abs(a.out[1]) != reach[1])
            add_triangle(patch, a.out, {a.out[0], b.out[1], z}, b.out, up);  // the corner between two sides
        else if (std::abs(a.out[1]) == reach[1] && std::abs(b.out[0]) == reach[0] && std::abs(a.out[0]) != reach[0])
            add_triangle(patch, a.out, {b.out[0], a.out[1], z}, b.out, up);
    }
}

// The face between a rectangle and a larger square, at one height.
void add_frame(Patch& patch, const std::array<double, 2>& inner, double z, double half) {
    const double x[4] = {-half, -inner[0], inner[0], half}, y[4] = {-half, -inner[1], inner[1], half};
    const auto rectangle = [&](int i0, int j0, int i1, int j1) {
        const Point a{x[i0], y[j0], z}, b{x[i1], y[j0], z}, c{x[i1], y[j1], z}, d{x[i0], y[j1], z};
        add_triangle(patch, a, b, c, up);
        add_triangle(patch, a, c, d, up);
    };
    rectangle(0, 0, 3, 1);
    rectangle(0, 2, 3, 3);
    rectangle(0, 1, 1, 2);
    rectangle(2, 1, 3, 2);
}

// A whole face as one triangle, wider than the sheet: at a seam a ray could be refracted twice.
void add_face(Patch& patch, double z, double half) {
    add_triangle(patch, {-half, -half, z}, {4 * half, -half, z}, {-half, 4 * half, z}, up);
}

class ArrayBuilder {
  public:
    ArrayBuilder(const Display& d, const Geometry& g, std::int64_t triangles)
        : display_(d), geometry_(g), mesh_(mesh_lens(d, g, triangles)), half_{d.array.pitch_mm[0] / 2, d.array.pitch_mm[1] / 2} {}

    MeshedArray build() {
        const Surround surround = display_.array.surround;
        for (std::size_t k = 0; k < geometry_.surfaces.size(); ++k) {
            rims_.push_back(rim(mesh_, std::int32_t(k)));
            add_surface(k);
        }
        if (surround == Surround::clear) {
            Patch wall{"wall", false, 1, geometry_.surfaces.front().index_above, {}, {}, {}};
            add_part(wall, LensMesh::wall);
            take(made_.cell, std::move(wall));
        }
        add_black();
        made_.lens_triangles = mesh_.count();
        return std::move(made_);
    }

  private:
    static void take(std::vector<Patch>& list, Patch&& patch) {
        if (patch.count() > 0) list.push_back(std::move(patch));
    }
    double local(double z) const { return z - geometry_.base_z_mm; }

    void add_part(Patch& patch, std::int32_t surface) const {
        constexpr std::uint32_t none = ~0u;
        std::vector<std::uint32_t> numbers(mesh_.vertices_mm.size() / 3, none);
        for (std::size_t t = 0; t < mesh_.count(); ++t) {
            if (mesh_.surface_of[t] != surface) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t v = mesh_.triangles[3 * t + i];
                if (numbers[v] == none) {
                    numbers[v] = std::uint32_t(patch.vertices_mm.size() / 3);
                    patch.vertices_mm.insert(patch.vertices_mm.end(), &mesh_.vertices_mm[3 * v], &mesh_.vertices_mm[3 * v] + 3);
                    patch.normals.insert(patch.normals.end(), &mesh_.normals[3 * v], &mesh_.normals[3 * v] + 3);
                }
                patch.triangles.push_back(numbers[v]);
            }
        }
    }

    void add_surface(std::size_t k) {
        const PlacedSurface& s = geometry_.surfaces[k];
        const bool clear = display_.array.surround == Surround::clear, down = s.index_below == 1;
        const std::string name = fmt::format("surface-{}", k + 1);
        if (is_plane(s) && !clear) {
            Patch face{name, false, s.index_above, s.index_below, {}, {}, {}};
            add_face(face, local(s.z_mm), sheet_half(display_, geometry_));
            return take(made_.sheet, std::move(face));
        }
        Patch cap{name, false, down ? s.index_below : s.index_above, down ? s.index_above : s.index_below, {}, {}, {}};
        add_part(cap, std::int32_t(k));
        take(made_.cell, std::move(cap));
        if (display_.array.surround != Surround::plate) return;
        Patch flat{fmt::format("flat-{}", k + 1), false, s.index_above, s.index_below, {}, {}, {}};
        add_ring(flat, rims_[k], local(rim_z(s)), half_, 0);
        take(made_.cell, std::move(flat));
        Patch beside{fmt::format("beside-{}", k + 1), false, s.index_above, s.index_below, {}, {}, {}};
        add_frame(beside, array_half(geometry_), local(rim_z(s)), sheet_half(display_, geometry_));
        take(made_.sheet, std::move(beside));
    }

    // This height, moved a little in front of a flat face at the same height.
    double before_faces(double z) const {
        for (const PlacedSurface& s : geometry_.surfaces)
            if (is_plane(s) && std::abs(s.z_mm - z) < solid_overlap_mm) z = s.z_mm + solid_overlap_mm;
        return z;
    }

    void add_black() {
        Patch black{"black", true, 1, 1, {}, {}, {}}, beside{"black-beside", true, 1, 1, {}, {}, {}};
        const auto& surfaces = geometry_.surfaces;
        const auto add = [&](const std::vector<Ring>& rings, bool all_beside) {
            for (const Ring& ring : rings) {
                const double z = local(before_faces(ring.z_mm));
                const auto same = std::find_if(surfaces.begin(), surfaces.end(),
                                               [&](const PlacedSurface& s) { return s.semi_aperture_mm == ring.radius_mm; });
                const bool of_surface = same != surfaces.end() && !all_beside;
                add_ring(black, of_surface ? rims_[std::size_t(same - surfaces.begin())] : circle(ring.radius_mm, 512), z, half_,
                         solid_overlap_mm);
                if (all_beside || &ring == &rings.front() || &ring == &rings.back())
                    add_frame(beside, array_half(geometry_), z, 100 * sheet_half(display_, geometry_));
            }
        };
        add(black_rings(display_, geometry_), false);
        add(stop_rings(display_, geometry_), true);
        if (display_.array.surround == Surround::opaque) {
            for (std::size_t k = 0; k + 1 < rims_.size(); ++k) add_barrel(black, rims_[k], rims_[k + 1]);
            // The rim of a square lens varies in height: its walls are extended to the faces of the black part.
            if (display_.array.aperture == Aperture::cell) {
                const std::vector<Ring> rings = black_rings(display_, geometry_);
                add_barrel(black, at_height(rims_.front(), local(rings.back().z_mm)), rims_.front());
                add_barrel(black, rims_.back(), at_height(rims_.back(), local(rings.front().z_mm)));
            }
        }
        take(made_.cell, std::move(black));
        take(made_.sheet, std::move(beside));
    }

    static std::vector<Point> at_height(std::vector<Point> polygon, double z) {
        for (Point& p : polygon) p[2] = z;
        return polygon;
    }

    // Rims have their points at the same angles, except square apertures that are cut at different places.
    static void add_barrel(Patch& patch, const std::vector<Point>& low, const std::vector<Point>& high) {
        const std::size_t count = std::min(low.size(), high.size());
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t j = (i + 1) % count;
            const Point out{low[i][0], low[i][1], 0};
            add_triangle(patch, low[i], low[j], high[j], out);
            add_triangle(patch, low[i], high[j], high[i], out);
        }
    }

    const Display& display_;
    const Geometry& geometry_;
    const LensMesh mesh_;
    const std::array<double, 2> half_;
    std::vector<std::vector<Point>> rims_;
    MeshedArray made_{};
};

}  // namespace

double rim_z(const PlacedSurface& s) { return s.z_mm + sag_mm(s.curvature_per_mm, s.conic, s.even_asphere, s.semi_aperture_mm); }

bool is_plane(const PlacedSurface& s) {
    return s.curvature_per_mm == 0 && std::all_of(s.even_asphere.begin(), s.even_asphere.end(), [](double a) { return a == 0; });
}

std::vector<Ring> black_rings(const Display& display, const Geometry& geometry) {
    if (display.array.surround != Surround::opaque) return {};
    std::vector<Ring> rings;
    double top = -INFINITY, bottom = INFINITY;
    for (const PlacedSurface& s : geometry.surfaces) {
        rings.push_back({rim_z(s), s.semi_aperture_mm});
        top = std::max(top, rim_z(s));
        bottom = std::min(bottom, rim_z(s));
    }
    // A surface concave to the outside lies inside the black part: light also has to pass the hole in that part's face.
    rings.push_back({top, geometry.surfaces.back().semi_aperture_mm});
    rings.push_back({bottom, geometry.surfaces.front().semi_aperture_mm});
    std::sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.z_mm > b.z_mm; });
    const auto same = [](const Ring& a, const Ring& b) { return a.z_mm - b.z_mm < 1e-9 && a.radius_mm == b.radius_mm; };
    rings.erase(std::unique(rings.begin(), rings.end(), same), rings.end());
    return rings;
}

std::vector<Ring> stop_rings(const Display& display, const Geometry& geometry) {
    if (!display.lens.stop_radius_mm) return {};
    return {{geometry.stop_z_mm, *display.lens.stop_radius_mm}};
}

std::array<double, 2> array_half(const Geometry& g) { return {g.array_width_mm / 2, g.array_height_mm / 2}; }

double sheet_half(const Display& display, const Geometry& g) {
    // the array may be turned and moved: its diagonal and the panel's hold for any angle
    const double wide = std::hypot(g.array_width_mm, g.array_height_mm), panel = std::hypot(g.panel_width_mm, g.panel_height_mm);
    const auto [x, y] = display.array.offset_mm;
    return wide / 2 + panel / 2 + std::hypot(x, y) + 20 * g.top_z_mm;
}

MeshedArray mesh_array(const Display& display, const Geometry& geometry, std::int64_t triangles) {
    return ArrayBuilder(display, geometry, triangles).build();
}

}  // namespace lfdsim::peers
