// The colours of one lens's spots: what dispersion does to a panel point's light. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/spots/spot.h"

namespace lfdsim {

/// A point of the panel under a lens, whose spots are looked at.
struct SpotField {
    std::string name, title;
    Point panel;
};

/// Axial and lateral colour, and the spots of red, green and blue together. Only for displays that disperse.
void tell_colours(const Subject&, const std::vector<SpotField>&, Result&);

}  // namespace lfdsim
