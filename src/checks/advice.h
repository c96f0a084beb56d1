// Advice on valid displays that may not be what was meant. Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// Returns a text for each likely mistake in a display, with its remedy, by theory alone (docs/model.md, "Advice"). The display
/// must be valid; geometry and theory are those of it. `model_half_size_mm`: half the extents of the posed model along the
/// display's axes, if it has been read; without them its width and depth are not checked.
std::vector<std::string> advice(const Display&, const Geometry&, const Theory&,
                                const std::optional<Vec3d>& model_half_size_mm = std::nullopt);

}  // namespace lfdsim
