// The measure of crosstalk: light that an eye sees and that is intended for other views or for the other eye. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns about how long it takes, in pictures of the camera's size.
std::int64_t crosstalk_steps(const Subject&);
/// Measures crosstalk between views and between the eyes (docs/measures.md, "Crosstalk"). Throws Stopped; InputError if the
/// viewing distance is inside the display.
Result measure_crosstalk(Subject&, Job&);

}  // namespace lfdsim
