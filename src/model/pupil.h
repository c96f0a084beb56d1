// What of a lens a viewer can look through: its pupil. docs/model.md, "Pupil". Floor 0.
#pragma once
#include "model/geometry.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// Of a lens's surfaces. The stop, if there is one, stands in the plane of a vertex.
Pupil pupil(const std::vector<PlacedSurface>&, std::optional<double> stop_radius_mm, double stop_z_mm);

}  // namespace lfdsim
