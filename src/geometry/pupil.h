// What of a lens a viewer can look through: its pupil. docs/model.md, "Pupil". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <optional>
#include <vector>

namespace lfdsim {

/// Finds the pupil of a lens's surfaces. The stop, if there is one, stands in the plane of a vertex.
Pupil pupil(const std::vector<PlacedSurface>&, std::optional<double> stop_radius_mm, double stop_z_mm);

/// The width along the array's x' and y' at which light of the panel's point on a lens's axis leaves the plane of the rear
/// principal point, by paraxial optics: at the depth z its spot is as wide times |1 - z/L|. It is the pupil's as seen from the
/// central depth plane, which is not D where the pupil stands before or behind that plane.
std::array<double, 2> light_width_mm(const Display&, const Geometry&);

}  // namespace lfdsim
