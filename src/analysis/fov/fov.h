// The field of view, from pictures. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// The angles of the views, horizontally and vertically: those of the options, else 61 views or more as far as one and a half times
/// the edge that theory predicts; from 20.5 degrees on every degree as far as 10 beyond it, 80 at most. No eye is inside the
/// display.
std::vector<double> fov_angles_deg(const Subject&);

/// Depth of the scene's centre: as described, but near enough to the lenses to be seen against the screen from 2 degrees beyond the
/// edge that theory predicts, along both axes.
double fov_depth_mm(const Subject&);

std::int64_t fov_steps(const Subject&);
/// Throws InputError for angles that are not on both sides of 0, or that put an eye inside the display.
Result measure_fov(Subject&, Job&);

}  // namespace lfdsim
