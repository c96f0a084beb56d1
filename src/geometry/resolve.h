// Functions of a resolved display that the library alone uses, in addition to geometry.h. Floor 0.
#pragma once
#include "geometry/geometry.h"

#include <cstddef>
#include <vector>

namespace lfdsim {

/// Returns the geometry for which elemental images are made: that of the display without its errors, unless content.made_for is
/// "built".
Geometry meant_geometry(const Display&, const Geometry& built);

/// Returns the depth midway between those of the nearest and the furthest of at least one object, mm from the vertex plane.
double middle_z_mm(const std::vector<SceneObject>&);

/// Returns whether there is a stop in the entrance plane: rays from the viewer's side then pass it before they meet the lens.
bool stop_at_entrance(const Display&, const Geometry&);

/// Returns the lens pitch p of the array as built, mm along x' (axis 0) or y' (1); hexagons and strips have one.
double lens_pitch_mm(const Geometry&, std::size_t axis);

/// Returns the height of a cell per lens pitch along y': 2/sqrt(3) of hexagons, from corner to corner, else 1.
double height_per_pitch(const Geometry&);

/// Returns the radius of the smallest disk around a cell of the array as built, mm; of strips p/2.
double outer_radius_mm(const Display&, const Geometry&);

/// Returns the clear aperture D, mm, along that axis of the array along which it is wider.
double widest_aperture_mm(const Geometry&);

}  // namespace lfdsim
