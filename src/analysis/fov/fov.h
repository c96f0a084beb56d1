// The measure of the field of view, by geometry and from pictures. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns the angles of the views, degrees, horizontally and vertically: the option's, or 61 and more as far as one and a half
/// times the edge by theory; from 20.5 degrees on one every degree to 10 beyond it, 80 at most. No eye is inside the display.
std::vector<double> fov_angles_deg(const Subject&);

/// Returns the depth of the scene's centre, mm from the vertex plane: as described, but near enough to the lenses that it is seen
/// against the screen from 2 degrees beyond the edge by theory, along both axes.
double fov_depth_mm(const Subject&);

/// Returns about how long the measure takes, in pictures of the camera's size.
std::int64_t fov_steps(const Subject&);
/// Measures the field of view (docs/measures.md, "Field of view"). Throws InputError for angles that are not on both sides of 0
/// or that put an eye inside the display; Stopped.
Result measure_fov(Subject&, Job&);

}  // namespace lfdsim
