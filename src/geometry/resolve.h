// What only the library itself asks of a resolved display, beside geometry.h. Floor 0.
#pragma once
#include "geometry/geometry.h"

#include <vector>

namespace lfdsim {

/// The geometry for which elemental images are made: that of the display without its errors, but for content.made_for =
/// "built".
Geometry meant_geometry(const Display&, const Geometry& built);

/// Midway between the nearest and the furthest object's middle, from the viewer-side vertex plane as they; of one or more.
double middle_z_mm(const std::vector<SceneObject>&);

/// Whether a stop lies in the entrance plane: light then passes it before it meets the lens.
bool stop_at_entrance(const Display&, const Geometry&);

/// D along a lens's wider axis.
double widest_aperture_mm(const Geometry&);

}  // namespace lfdsim
