// Crosstalk: how much of what is meant for others an eye sees. Floor 3.
#pragma once
#include "analysis/result.h"
#include "analysis/subject.h"

namespace lfdsim {

std::int64_t crosstalk_steps(const Subject&);
Result measure_crosstalk(Subject&, Job&);

}  // namespace lfdsim
