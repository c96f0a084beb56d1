// The pupil: the part of a lens through which a viewer can see. docs/model.md, "Pupil". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <optional>
#include <vector>

namespace lfdsim {

/// Returns the pupil of a lens's surfaces: the least s/|h| of all apertures of semi-aperture s, h the height at which a paraxial
/// ray passes it that enters parallel to the axis at the height 1. The stop, if there is one, is in the plane of a vertex; all z
/// in mm from the panel.
Pupil pupil(const std::vector<PlacedSurface>&, std::optional<double> stop_radius_mm, double stop_z_mm);

/// Returns the width D_L = D L/(L - z_p), mm along the array's x' and y', at which light of the panel's point on a lens's axis
/// leaves the plane of the rear principal point, by paraxial optics: at the depth z its spot is D_L |1 - z/L| wide. It differs
/// from D where the pupil is at a distance z_p in front of that plane.
std::array<double, 2> light_width_mm(const Display&, const Geometry&);

}  // namespace lfdsim
