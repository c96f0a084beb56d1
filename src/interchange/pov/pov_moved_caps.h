// A moulded sheet whose caps differ from each other, as POV-Ray's objects. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>

namespace lfdsim::peers {

/// Returns the array between the panel's layers and the camera; `Place` takes it from the array's frame to the display's.
std::string pov_moved_caps(const Display&, const Geometry&);

}  // namespace lfdsim::peers
