// A lens of the array as triangles, whose vertices lie on its surfaces. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// The surfaces of a lens and the walls of its glass. Each body of glass is closed: its parts meet in the same points, to the bit,
/// but share no vertices, since their normals differ.
struct LensMesh {
    static constexpr std::int32_t wall = -1;

    std::vector<float> vertices_mm;        // x, y from the lens's axis, z from its lowest point (Geometry::base_z_mm)
    std::vector<float> normals;            // of the true surface at each vertex, unit length, out of the glass
    std::vector<std::uint32_t> triangles;  // three vertices each, counter-clockwise as seen from outside of the glass
    std::vector<std::int32_t> surface_of;  // of each triangle: its number in Geometry::surfaces, or `wall`

    std::size_t count() const { return surface_of.size(); }
};

/// The least and the greatest number of triangles that mesh_lens() accepts.
inline constexpr std::int64_t least_lens_triangles = 8, most_lens_triangles = 4'000'000;

/// Returns a lens of about this number of triangles: within 10 % for 500 and more, else as close as possible. A curved surface is a
/// fan about its pole and rings, equally spaced along the surface, each with the same number of vertices more than the last, so
/// that triangles are about as wide as long. A flat surface is a fan to the vertices of its rim. Where lenses fill their cells
/// outlines are rectangles or hexagons, cut by the semi-apertures. A strip, as long as cell_half() says, has slats, in pieces 64
/// times as long as wide. A surface between two glasses, or glued on, faces the viewer. Throws InputError for a thin lens and for a
/// number beyond the limits.
LensMesh mesh_lens(const Display&, const Geometry&, std::int64_t triangles);

}  // namespace lfdsim
