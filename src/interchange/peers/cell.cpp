#include "interchange/peers/cell.h"

#include "base/constants.h"
#include "geometry/prescription.h"
#include "interchange/meshed/cell_sides.h"
#include "interchange/meshed/lens_mesh.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim::peers {
namespace {

using Point = std::array<double, 3>;

// Black rings of neighbours overlap by this much, and lie this far in front of a flat face at the same height, so that no ray
// passes between.
constexpr double solid_overlap_mm = 1e-3;

/// Appends a vertex and returns its number.
std::uint32_t add_vertex(Patch& patch, const Point& at, const Point& normal) {
    for (const double p : at) patch.vertices_mm.push_back(float(p));
    for (const double p : normal) patch.normals.push_back(float(p));
    return std::uint32_t(patch.vertices_mm.size() / 3 - 1);
}

/// Appends a triangle with three vertices that no other triangle shares, unless two of them are one point in single precision.
void add_triangle(Patch& patch, const Point& a, const Point& b, const Point& c, const Point& normal) {
    const auto same = [](const Point& p, const Point& q) {
        return std::equal(p.begin(), p.end(), q.begin(), [](double x, double y) { return float(x) == float(y); });
    };
    if (same(a, b) || same(b, c) || same(c, a)) return;
    for (const Point& p : {a, b, c}) patch.triangles.push_back(add_vertex(patch, p, normal));
}

constexpr Point up{0, 0, 1};

double angle(const Point& p) { return std::atan2(p[1], p[0]); }

/// Returns the vertices on the border of one surface of the lens, in the order of their angles about the axis.
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

/// Returns evenly spaced points of a circle about the axis, from the angle -pi on.
std::vector<Point> circle(double radius, std::size_t count) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = 2 * pi * (double(i) / double(count) - 0.5);
        points.push_back({radius * std::cos(a), radius * std::sin(a), 0});
    }
    return points;
}

/// Returns the corner between a side of the cell and the next one, both moved out by `wider`.
Point corner_after(const std::vector<CellSide>& sides, std::size_t number, double wider, double z) {
    const CellSide &a = sides[number], &b = sides[(number + 1) % sides.size()];
    const double da = a.from_axis_mm + wider, db = b.from_axis_mm + wider, det = a.out[0] * b.out[1] - a.out[1] * b.out[0];
    return {(da * b.out[1] - db * a.out[1]) / det, (a.out[0] * db - b.out[0] * da) / det, z};
}

/// Appends the face from a polygon about the axis to the cell's border, and `wider` beyond it, all at one height; nothing where the
/// polygon lies on the border.
void add_ring(Patch& patch, const std::vector<Point>& inner, double z, const std::vector<CellSide>& sides, double wider) {
    struct CornerPair {
        Point in, out;
        std::size_t side;
    };
    // Each point of the polygon, and the point of the border in its direction from the axis, with the side that this is on
    const auto towards = [](const CellSide& side, const Point& p) { return side.out[0] * p[0] + side.out[1] * p[1]; };
    std::vector<CornerPair> pairs;
    for (const Point& p : inner) {
        double scale = INFINITY;
        std::size_t nearest = 0;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            const double to_side = towards(sides[k], p), reach = sides[k].from_axis_mm + wider;
            if (to_side > 0 && reach / to_side < scale) scale = reach / to_side, nearest = k;
        }
        pairs.push_back({{p[0], p[1], z}, {scale * p[0], scale * p[1], z}, nearest});
    }
    const auto along_border = [&](const Point& a, const Point& b) {
        return std::any_of(sides.begin(), sides.end(), [&](const CellSide& side) {
            return std::min(towards(side, a), towards(side, b)) >= side.from_axis_mm - 1e-6;
        });
    };
    // Between neighbouring points two triangles, and one more for each corner of the cell between their directions
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const CornerPair &a = pairs[i], &b = pairs[(i + 1) % pairs.size()];
        if (along_border(a.in, b.in)) continue;
        add_triangle(patch, a.in, a.out, b.in, up);
        Point from = a.out;
        for (std::size_t k = a.side; k != b.side; k = (k + 1) % sides.size()) {
            const Point corner = corner_after(sides, k, wider, z);
            add_triangle(patch, b.in, from, corner, up);
            from = corner;
        }
        add_triangle(patch, b.in, from, b.out, up);
    }
}

/// Appends the places in the box about all cells that no cell of staggered rows covers, at one height, in the array's frame.
void add_between(Patch& patch, const Geometry& g, double z) {
    const Lattice<double>& lattice = g.lattice;
    if (!lattice.staggered) return;
    const auto [x, y] = array_half(g);
    const double p = lattice.pitch[0], up_to = cell_half(g)[1];
    const double beside = cell_corners(g).y[1];  // half the height of a cell's left and right side
    const auto columns = std::int64_t(lattice.count[0]), rows = std::int64_t(lattice.count[1]);
    for (std::int64_t j = 0; j < rows; ++j) {
        // Half a cell at the row's end: of even rows, which are shifted to the left, on the right
        const double sign = j % 2 == 0 ? 1 : -1, row = (double(j) - 0.5 * double(rows - 1)) * lattice.pitch[1];
        const Point a{sign * (x - p / 2), row - sign * beside, z}, b{sign * x, row - sign * up_to, z},
            c{sign * x, row + sign * up_to, z}, e{sign * (x - p / 2), row + sign * beside, z};
        add_triangle(patch, a, b, c, up);
        add_triangle(patch, a, c, e, up);
        // Between the upper and between the lower corners of hexagons, at the array's border
        for (const int end : {-1, 1}) {
            if (beside == up_to || j != (end < 0 ? 0 : rows - 1)) continue;
            for (std::int64_t i = -1; i < columns; ++i) {
                const double axis = (double(i) - 0.5 * double(columns - 1)) * p - sign * p / 4;
                const Point left{std::max(axis, -x), end * y, z}, right{std::min(axis + p, x), end * y, z},
                    valley{axis + p / 2, end * (y - beside), z};
                end > 0 ? add_triangle(patch, left, valley, right, up) : add_triangle(patch, left, right, valley, up);
            }
        }
    }
}

/// Appends the face between a rectangle and a larger square, at one height; `inner` and `half`: half the sides.
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

/// Appends a whole face as one triangle, wider than the sheet: at a seam between two a ray could be refracted twice.
void add_face(Patch& patch, double z, double half) {
    add_triangle(patch, {-half, -half, z}, {4 * half, -half, z}, {-half, 4 * half, z}, up);
}

/// Builds the triangles of an array: lens surfaces and walls, the flat parts of a plate, layers, and the black parts.
class ArrayBuilder {
  public:
    ArrayBuilder(const Display& d, const Geometry& g, std::int64_t triangles)
        : display_(d), geometry_(g), mesh_(mesh_lens(d, g, triangles)), sides_(cell_sides(g)) {}

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
        add_layers();
        add_black();
        made_.lens_triangles = mesh_.count();
        return std::move(made_);
    }

  private:
    /// Appends a patch to a list, unless it has no triangle.
    static void take(std::vector<Patch>& list, Patch&& patch) {
        if (patch.count() > 0) list.push_back(std::move(patch));
    }
    /// Returns a height from the panel in the patches' frame.
    double local(double z) const { return z - geometry_.base_z_mm; }

    /// Copies a surface of the lens's mesh, or its walls, to a patch, with the vertices that its triangles use.
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

    /// Adds surface k: a plane as one face for all lenses, except in `clear`; else in each cell, of a plate with the flat part.
    void add_surface(std::size_t k) {
        const PlacedSurface& s = geometry_.surfaces[k];
        const bool clear = display_.array.surround == Surround::clear, down = s.index_below == 1;
        const std::string name = fmt::format("surface-{}", k + 1);
        if (geometry_.glued && k == 0 && geometry_.layers.empty()) return;  // the panel itself lies there
        if (is_plane(s) && !clear) {
            Patch face{name, false, s.index_above, s.index_below, {}, {}, {}};
            add_face(face, local(s.z_mm), sheet_half(geometry_));
            return take(made_.sheet, std::move(face));
        }
        Patch cap{name, false, down ? s.index_below : s.index_above, down ? s.index_above : s.index_below, {}, {}, {}};
        add_part(cap, std::int32_t(k));
        take(made_.cell, std::move(cap));
        if (display_.array.surround != Surround::plate) return;
        Patch flat{fmt::format("flat-{}", k + 1), false, s.index_above, s.index_below, {}, {}, {}};
        add_ring(flat, rims_[k], local(rim_z_mm(s)), sides_, 0);
        take(made_.cell, std::move(flat));
        Patch beside{fmt::format("beside-{}", k + 1), false, s.index_above, s.index_below, {}, {}, {}};
        add_frame(beside, array_half(geometry_), local(rim_z_mm(s)), sheet_half(geometry_));
        add_between(beside, geometry_, local(rim_z_mm(s)));
        take(made_.sheet, std::move(beside));
    }

    /// Adds the layers' upper faces, except where a lens's glued face is the top layer's.
    void add_layers() {
        const std::vector<PlacedLayer>& layers = geometry_.layers;
        double z = geometry_.layers_top_mm, above = 1;
        for (std::size_t k = layers.size(); k-- > 0; z -= layers[k].thickness_mm) {
            Patch face{fmt::format("layer-{}", k + 1), false, above, layers[k].index, {}, {}, {}, false};
            above = layers[k].index;
            if (!geometry_.glued || k + 1 < layers.size()) {
                add_face(face, local(z), sheet_half(geometry_));
                take(made_.sheet, std::move(face));
            } else if (display_.array.surround == Surround::clear) {
                add_ring(face, rims_.front(), local(z), sides_, 0);
                Patch beside{face.name + "-beside", false, 1, above, {}, {}, {}, false};
                add_frame(beside, array_half(geometry_), local(z), sheet_half(geometry_));
                add_between(beside, geometry_, local(z));
                take(made_.cell, std::move(face));
                take(made_.sheet, std::move(beside));
            }
        }
    }

    /// Returns the border of a stop's hole or slit.
    std::vector<Point> hole(double radius) const {
        if (!geometry_.lattice.strips) return circle(radius, 512);
        const double y = cell_half(geometry_)[1];
        return {{-radius, -y, 0}, {radius, -y, 0}, {radius, y, 0}, {-radius, y, 0}};
    }

    /// Adds what absorbs: rings between lenses, beside the array the highest and the lowest of them, the stop's sheet, and in
    /// `opaque` the barrels between surfaces, from rim to rim.
    void add_black() {
        Patch black{"black", true, 1, 1, {}, {}, {}}, beside{"black-beside", true, 1, 1, {}, {}, {}};
        const auto& surfaces = geometry_.surfaces;
        const auto add = [&](const std::vector<Ring>& rings, bool all_beside) {
            for (const Ring& ring : rings) {
                const double z = local(before_faces(geometry_, ring.z_mm, solid_overlap_mm));
                const auto same = std::find_if(surfaces.begin(), surfaces.end(),
                                               [&](const PlacedSurface& s) { return s.semi_aperture_mm == ring.radius_mm; });
                const bool of_surface = same != surfaces.end() && !all_beside;
                add_ring(black, of_surface ? rims_[std::size_t(same - surfaces.begin())] : hole(ring.radius_mm), z, sides_,
                         solid_overlap_mm);
                if (all_beside || &ring == &rings.front() || &ring == &rings.back()) {
                    add_frame(beside, array_half(geometry_), z, 100 * sheet_half(geometry_));
                    add_between(beside, geometry_, z);
                }
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

    /// Appends the wall between two rims. They have their points at the same angles, except square apertures that are cut at
    /// different places.
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
    const std::vector<CellSide> sides_;
    std::vector<std::vector<Point>> rims_;
    MeshedArray made_{};
};

}  // namespace

std::vector<Ring> black_rings(const Display& display, const Geometry& geometry) {
    if (display.array.surround != Surround::opaque) return {};
    std::vector<Ring> rings;
    for (const PlacedSurface& s : geometry.surfaces) rings.push_back({rim_z_mm(s), s.semi_aperture_mm});
    const Rims all = rims(geometry.surfaces);
    // A surface concave to the outside lies inside the black part: light also has to pass the hole in that part's face.
    rings.push_back({all.high, geometry.surfaces.back().semi_aperture_mm});
    rings.push_back({all.low, geometry.surfaces.front().semi_aperture_mm});
    std::sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.z_mm > b.z_mm; });
    const auto same = [](const Ring& a, const Ring& b) { return a.z_mm - b.z_mm < 1e-9 && a.radius_mm == b.radius_mm; };
    rings.erase(std::unique(rings.begin(), rings.end(), same), rings.end());
    return rings;
}

std::vector<Ring> stop_rings(const Display& display, const Geometry& geometry) {
    if (!display.lens.stop_radius_mm) return {};
    return {{geometry.stop_z_mm, *display.lens.stop_radius_mm}};
}

double before_faces(const Geometry& geometry, double z_mm, double gap_mm) {
    for (const PlacedSurface& s : geometry.surfaces)
        if (is_plane(s) && std::abs(s.z_mm - z_mm) < gap_mm) z_mm = s.z_mm + gap_mm;
    return z_mm;
}

Rims rims(const std::vector<PlacedSurface>& surfaces) {
    Rims of;
    for (const PlacedSurface& s : surfaces) {
        of.low = std::min(of.low, rim_z_mm(s));
        of.high = std::max(of.high, rim_z_mm(s));
        of.radius = std::max(of.radius, s.semi_aperture_mm);
    }
    return of;
}

MeshedArray mesh_array(const Display& display, const Geometry& geometry, std::int64_t triangles) {
    return ArrayBuilder(display, geometry, triangles).build();
}

}  // namespace lfdsim::peers
