// The depth of field: from pictures, by the traced spot, by diffraction, and by paraxial theory. Floor 3.
#pragma once
#include "analysis/result.h"
#include "analysis/subject.h"

namespace lfdsim {

/// Depths of the scene's centre before the vertex plane: those of the options, else 31, a centimetre apart from 150 mm before the
/// central depth plane, but 10 mm at least; behind a display whose central depth plane lies there, the same mirrored.
std::vector<double> dof_depths_mm(const Subject&);

std::int64_t dof_steps(const Subject&);
Result measure_dof(Subject&, Job&);

}  // namespace lfdsim
