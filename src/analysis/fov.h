// The field of view, from pictures. Floor 3.
#pragma once
#include "analysis/result.h"
#include "analysis/subject.h"

namespace lfdsim {

/// The angles of the views, horizontally and vertically: those of the options, else 61 views or more as far as one and a half times
/// the edge that theory expects; from 20.5 degrees on every degree as far as 10 beyond it, 80 at most. No eye is inside the
/// display.
std::vector<double> fov_angles_deg(const Subject&);

/// Depth of the scene's centre: as described, but no farther from the lenses than lets it be seen before the screen from 2 degrees
/// beyond the edge that theory expects, along both axes.
double fov_depth_mm(const Subject&);

std::int64_t fov_steps(const Subject&);
/// Throws InputError for angles that do not go to both sides or into the display.
Result measure_fov(Subject&, Job&);

}  // namespace lfdsim
