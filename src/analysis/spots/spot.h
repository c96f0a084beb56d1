// The measure of the spots of one lens over field and depth, and of the distortion of its elemental image. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns about how long it takes, in pictures of the camera's size.
std::int64_t spot_steps(const Subject&);
/// Measures spots and distortion (docs/measures.md, "Spots of one lens"). Throws Stopped.
Result measure_spot(Subject&, Job&);

}  // namespace lfdsim
