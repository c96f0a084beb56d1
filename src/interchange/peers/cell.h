// An array of lenses as triangles: the parts that are repeated in each cell, and those that exist once. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim::peers {

/// Triangles of one material. A black one absorbs; a glass one refracts between the medium on the front, from which its triangles
/// appear counter-clockwise, and the one on the back. z is measured from Geometry::base_z_mm.
struct Patch {
    std::string name;  // letters, digits and dashes
    bool black;
    double index_front = 1, index_back = 1;
    std::vector<float> vertices_mm, normals;  // three numbers each; normals towards the front
    std::vector<std::uint32_t> triangles;     // three vertices each
    bool of_lens = true;                      // false: a layer's, at which total reflection is black

    std::size_t count() const { return triangles.size() / 3; }
};

/// An array as triangles.
struct MeshedArray {
    std::vector<Patch> cell;   // the parts about the axis of each lens
    std::vector<Patch> sheet;  // the parts that exist once, about the middle of the array, in its frame
    std::size_t lens_triangles;
};

/// Returns the array with lenses of about this number of triangles. Throws InputError as mesh_lens() does.
MeshedArray mesh_array(const Display&, const Geometry&, std::int64_t triangles);

/// A black ring around each lens: at this height, from the panel, everything farther than the radius from the lens's axis absorbs
/// (0: outside its cell).
struct Ring {
    double z_mm, radius_mm;
};
/// Returns the rings of the black part between lenses, highest first; none unless the surround is opaque.
std::vector<Ring> black_rings(const Display&, const Geometry&);
/// Returns the ring of the stop, if there is one.
std::vector<Ring> stop_rings(const Display&, const Geometry&);
/// Returns a height, moved in front of a flat face of the lenses that is nearer to it than `gap_mm`.
double before_faces(const Geometry&, double z_mm, double gap_mm);

/// The heights of the lowest rim and the highest of a lens, and the widest radius, mm.
struct Rims {
    double low = INFINITY, high = -INFINITY, radius = 0;
};
/// Returns the rims of a lens's surfaces, in their frame.
Rims rims(const std::vector<PlacedSurface>&);

}  // namespace lfdsim::peers
