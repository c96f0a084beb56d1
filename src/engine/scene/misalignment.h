// The errors of an array as the tracer needs them. Floor 2.
#pragma once
#include "engine/scene/traced_display.h"

namespace lfdsim {

/// The rotation Ry(wedge y) Rx(wedge x) from the frame turned about z only to that of the array; the identity without a wedge.
void wedge_of(const Errors&, const Geometry&, double (&wedge)[3][3]);

/// Errors of all lenses, drawn and given, with the bow in their heights: row by row from the lower left.
std::vector<LensError> lenses_as_built(const Display&, const Lattice<double>&);

/// Fills the scene's placement, if the array has a wedge or its lenses differ.
template <class S>
void place_lenses(const Display&, const Geometry&, StoredDisplay<S>&);

}  // namespace lfdsim
