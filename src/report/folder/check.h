// What follows from a description: for scripts, and what is worth knowing of it. Floor 4.
#pragma once
#include "analysis/core/result.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// The faults of a display, the worst first: verdicts by tracing (analysis/core/verdicts.h), then advice (checks/advice.h).
std::vector<std::string> verdicts_and_advice(const Display&, const Geometry&, const Theory&,
                                             const std::optional<Vec3d>& model_half_size_mm = std::nullopt);

/// Returns the warnings of a display together with the faults of its content's files (their size, or that they cannot be read)
/// and of its glasses.
std::vector<std::string> worth_knowing(const Display&, const Geometry&, const Theory&);

/// Every key, every length, the theory, why figures are undefined, and what is worth knowing: what `lfdsim check --json` prints.
/// Names in it are fixed: scripts use them. Throws InputError for a display that is not valid. Without the warnings, for which rays
/// are traced and content is read, it takes microseconds.
Json check_json(const Display&, bool warnings = true);

}  // namespace lfdsim
