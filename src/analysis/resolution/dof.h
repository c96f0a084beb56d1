// The depth of field: from pictures, by the traced spot, by diffraction, and by paraxial theory. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

std::int64_t dof_steps(const Subject&);
/// Throws InputError for requested depths inside the lenses, or fewer than three of them.
Result measure_dof(Subject&, Job&);

}  // namespace lfdsim
