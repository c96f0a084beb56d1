// The measure "directions": the display seen from several directions, beside the scene itself. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns about how long it takes, in pictures of the camera's size.
std::int64_t directions_steps(const Subject&);
/// Makes contact sheets of views at seven angles, horizontally and vertically, over their reference photographs, and an animation
/// in which the camera moves to and fro. Throws Stopped; InputError if there is no scene.
Result measure_directions(Subject&, Job&);

}  // namespace lfdsim
