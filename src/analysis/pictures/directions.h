// The display seen from several directions, beside the scene itself. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

std::int64_t directions_steps(const Subject&);
/// A contact sheet of views at seven angles, horizontally and vertically, over their reference photographs, and an animation of the
/// camera moving to and fro.
Result measure_directions(Subject&, Job&);

}  // namespace lfdsim
