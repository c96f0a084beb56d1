// How wide a lens's surfaces must be for the light that it is drawn for. Floor 2.
#pragma once
#include "files/lenses/drawn_lens.h"

#include <vector>

namespace lfdsim {

/// Gives each surface without a semi-aperture the one that the beam needs, by paraxial rays: that of the axis's beam and of the
/// field's chief ray together, on the stop that of the axis's beam. `indices`: of the medium behind each surface. False, and
/// nothing is changed: the file does not say enough (a pupil, f-number or size of the stop; the field as an angle; an object at
/// infinity).
bool fill_apertures(DrawnLens&, const std::vector<double>& indices);

}  // namespace lfdsim
