// Crosstalk: how much light an eye sees that is meant for other views or for the other eye. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

std::int64_t crosstalk_steps(const Subject&);
Result measure_crosstalk(Subject&, Job&);

}  // namespace lfdsim
