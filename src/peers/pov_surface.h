// Lens surfaces as POV-Ray's shapes: spheres, quadrics, planes and, for aspheres, surfaces of equations. Floor 2.
#pragma once
#include "model/display.h"
#include "model/geometry.h"

#include <string>

namespace lfdsim::peers {

/// The surface alone, within its aperture: a skin that encloses nothing. Lens-local x, y; z from the panel. Without the closing
/// brace, so that matter can be added.
std::string pov_skin(const PlacedSurface&, const LensArray&);

/// All space above a surface, or below it, near its vertex: for what lies within `reach` of the axis and low <= z <= high.
std::string pov_space(const PlacedSurface&, bool above, double reach, double low, double high);

}  // namespace lfdsim::peers
