// Lens surfaces as POV-Ray's shapes: spheres, quadrics, planes and, for aspheres, isosurfaces; of strips, cylinders of these
// sections. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "interchange/pov/pov_cell.h"

#include <string>

namespace lfdsim::peers {

/// Returns the surface alone, within its aperture: a skin that encloses nothing. x and y are from the lens's axis, z from the
/// panel. The closing brace is left out, so that a material can be added.
std::string pov_skin(const PlacedSurface&, const LensArray&, const PovCell&);

/// Returns whether POV-Ray's normal of that skin points to the viewer: an interior_texture is that of the other side.
bool pov_faces_up(const PlacedSurface&);

/// Returns the space above a surface, or below it, near its vertex: valid within `reach` of the axis, of strips of its plane, and
/// for low <= z <= high.
std::string pov_space(const PlacedSurface&, const PovCell&, bool above, double reach, double low, double high);

}  // namespace lfdsim::peers
