// Spot diagrams of one lens over field and depth, and the distortion of its elemental image. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

std::int64_t spot_steps(const Subject&);
Result measure_spot(Subject&, Job&);

}  // namespace lfdsim
