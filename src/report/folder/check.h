// The results of `lfdsim check`: all that follows from a description, for scripts, and the warnings about it. Floor 4.
#pragma once
#include "analysis/core/result.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// Returns sentences on the faults of a display, the worst first: verdicts by tracing (analysis/verdicts/verdicts.h), then advice
/// (checks/advice.h), which takes the model's size into account where it is given.
std::vector<std::string> verdicts_and_advice(const Display&, const Geometry&, const Theory&,
                                             const std::optional<Vec3d>& model_half_size_mm = std::nullopt);

/// Returns the warnings of a display together with the faults of its content's files (their size, or that they cannot be read)
/// and of its glasses.
std::vector<std::string> worth_knowing(const Display&, const Geometry&, const Theory&);

/// Returns what `lfdsim check --json` prints: every key, every length, the theory, why figures are undefined, and the warnings.
/// Names in it are fixed, since scripts use them. Throws InputError for a display that is not valid. Without the warnings, for
/// which rays are traced and content is read, it takes microseconds.
Json check_json(const Display&, bool warnings = true);

}  // namespace lfdsim
