// The colours of one lens's spots: what dispersion does to a panel point's light. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/spots/lens_spots.h"

namespace lfdsim {

/// Axial and lateral colour, and the spots of red, green and blue together. Only for displays that disperse.
void tell_colours(const Subject&, const std::vector<LensField>&, Result&);

}  // namespace lfdsim
