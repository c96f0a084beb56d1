// The measure of the depth of field: from pictures, by the traced spot, by diffraction, and by paraxial theory. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns about how long it takes, in pictures of the camera's size.
std::int64_t dof_steps(const Subject&);
/// Measures the depth of field (docs/measures.md, "Depth of field"). Throws InputError for requested depths inside the lenses or
/// fewer than three of them; Stopped.
Result measure_dof(Subject&, Job&);

}  // namespace lfdsim
