// An array of lenses as triangles: what stands in each cell, and what stands once. Floor 2.
#pragma once
#include "model/display.h"
#include "model/geometry.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim::peers {

/// Triangles of one matter. A black one absorbs; a glass one refracts between the medium on the side that its triangles show
/// counter-clockwise (front) and the one behind. z counts from Geometry::base_z_mm.
struct Patch {
    std::string name;  // letters, digits and dashes
    bool black;
    double index_front = 1, index_back = 1;
    std::vector<float> vertices_mm, normals;  // normals towards the front
    std::vector<std::uint32_t> triangles;

    std::size_t count() const { return triangles.size() / 3; }
};

struct MeshedArray {
    std::vector<Patch> cell;   // about the axis of each lens
    std::vector<Patch> sheet;  // about the middle of the array, in its frame
    std::size_t lens_triangles;
};

/// Throws InputError as mesh_lens() does.
MeshedArray mesh_array(const Display&, const Geometry&, std::int64_t triangles);

/// Black rings beside the lenses: at this height everything further than the radius from a lens's axis (0: beside its cell)
/// absorbs.
struct Ring {
    double z_mm, radius_mm;
};
/// Those of the black part between lenses, highest first, none unless the surround is opaque; and that of the stop.
std::vector<Ring> black_rings(const Display&, const Geometry&);
std::vector<Ring> stop_rings(const Display&, const Geometry&);

/// Height of a surface at the rim of its aperture.
double rim_z(const PlacedSurface&);
bool is_plane(const PlacedSurface&);

/// Half the sides of the array's rectangle, and of what stands for an infinite sheet: no ray that passes beside it can reach the
/// panel less steep than 87 degrees off its normal.
std::array<double, 2> array_half(const Geometry&);
double sheet_half(const Display&, const Geometry&);

}  // namespace lfdsim::peers
