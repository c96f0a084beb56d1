// How steep rays go through the layers on the panel. Floor 0.
#pragma once
#include "geometry/geometry.h"

namespace lfdsim {

/// Returns the lateral distance, mm for each unit of its slope m in air, that a ray covers from a thin lens's plane to the panel,
/// by Snell's law: the air's height plus the sum of thickness/sqrt(n^2 + (n^2 - 1) m^2) over the layers. It is g for small slopes,
/// less for steep ones. `slope_squared` is m^2.
double reach_below_thin_lens_mm(const Geometry&, double slope_squared);

}  // namespace lfdsim
