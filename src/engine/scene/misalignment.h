// The errors of an array as the tracer needs them. Floor 2.
#pragma once
#include "engine/scene/traced_display.h"

namespace lfdsim {

/// Computes the matrix that takes a vector's components in the array's frame to those in the frame turned about z alone: the
/// rotation Ry(wedge_y) Rx(wedge_x) about the panel's axes (docs/model.md, "Errors"); the identity without a wedge.
void wedge_of(const Errors&, const Geometry&, double (&wedge)[3][3]);

/// Returns the errors of all lenses, drawn and given, with the bow in their heights: row by row from the lower left. Throws
/// InputError if there is too little memory.
std::vector<LensError> lenses_as_built(const Display&, const Lattice<double>&);

/// Fills scene.misaligned, and scene.lenses that it points to, if the array has a wedge or its lenses differ. The rest of the scene
/// is filled before.
template <class S>
void place_lenses(const Display&, const Geometry&, StoredDisplay<S>&);

}  // namespace lfdsim
