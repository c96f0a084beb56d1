// What is possible but perhaps not meant: a valid display that may disappoint. Floor 0.
#pragma once
#include "model/display.h"
#include "model/geometry.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// A sentence for each, with what would mend it. The display must be valid. `model_half_size_mm`: half the extents of the posed
/// model, where it has been read; without them its width and depth are not judged.
std::vector<std::string> advice(const Display&, const Geometry&, const Theory&,
                                const std::optional<Vec3d>& model_half_size_mm = std::nullopt);

}  // namespace lfdsim
