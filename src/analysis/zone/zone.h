// The measure of the viewing zone: the positions from which the whole screen shows its own elemental images. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns about how long it takes, in pictures of the camera's size.
std::int64_t zone_steps(const Subject&);
/// Measures the viewing zone (docs/measures.md, "Viewing zone"). Throws Stopped; InputError if the viewing distance is inside the
/// display.
Result measure_zone(Subject&, Job&);

}  // namespace lfdsim
