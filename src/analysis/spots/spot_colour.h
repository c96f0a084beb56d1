// The colours of one lens's spots: the effect of dispersion on a panel point's light. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/spots/lens_spots.h"

namespace lfdsim {

/// Adds axial and lateral colour, and diagrams of the spots of red, green and blue together, if the display disperses
/// (docs/measures.md, "Colour of one lens").
void tell_colours(const Subject&, const std::vector<LensField>&, Result&);

}  // namespace lfdsim
