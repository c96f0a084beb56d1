// Semi-apertures of a lens's surfaces from the beam that it was designed for. Floor 2.
#pragma once
#include "files/lenses/drawn_lens.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// Gives each surface without a semi-aperture the one that the beam needs, by paraxial rays: |height of the axial beam's edge| +
/// |height of the chief ray from the edge of the field|, on the stop the former alone. `indices`: of the medium after each surface.
/// Returns nothing if that is done; where the file does not say enough, it changes nothing and returns what is missing, as a noun.
std::optional<std::string> fill_apertures(DrawnLens&, const std::vector<double>& indices);

}  // namespace lfdsim
