// The viewing zone: from where all of the screen shows its own elemental images. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

std::int64_t zone_steps(const Subject&);
Result measure_zone(Subject&, Job&);

}  // namespace lfdsim
