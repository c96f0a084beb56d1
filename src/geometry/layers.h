// How steep rays go through the layers on the panel. Floor 0.
#pragma once
#include "geometry/geometry.h"

namespace lfdsim {

/// How far aside, for each unit of its slope, a ray goes from a thin lens's plane to the panel, by Snell's law through air and
/// layers: g for small slopes, less for steep ones.
double reach_below_thin_lens_mm(const Geometry&, double slope_squared);

}  // namespace lfdsim
