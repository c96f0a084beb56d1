// Lenses that differ from each other, in a black sheet, as POV-Ray's objects. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>

namespace lfdsim::peers {

/// Returns the array between the panel's layers and the camera; `Place` takes it from the array's frame to the display's.
std::string pov_placed(const Display&, const Geometry&);

/// Number of hits of a ray that passes such a lens, beyond those of a perfect one: on walls and faces of neighbours that do not
/// concern it.
inline constexpr int pov_passed_by = 16;

}  // namespace lfdsim::peers
