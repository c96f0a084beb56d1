// Semi-apertures of a lens's surfaces from the beam that it was designed for. Floor 2.
#pragma once
#include "files/lenses/drawn_lens.h"

#include <vector>

namespace lfdsim {

/// Gives each surface without a semi-aperture the one that the beam needs, by paraxial rays: |height of the axial beam's edge| +
/// |height of the chief ray from the edge of the field|, on the stop the former alone. `indices`: of the medium after each surface.
/// Returns false, and changes nothing, where the file does not say enough. It needs a stop, the object at infinity, the field as an
/// angle, and a pupil, an f-number or the size of the stop.
bool fill_apertures(DrawnLens&, const std::vector<double>& indices);

}  // namespace lfdsim
