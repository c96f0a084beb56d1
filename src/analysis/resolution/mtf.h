// The modulation transfer function of what a display shows, from slanted edges at several depths and angles. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Depths of the edges in front of the vertex plane: those of the options, else nine, evenly on both sides of the central depth
/// plane to twice as far as the depth of field reaches, but not nearer than a tenth of the central depth or farther than 3/4 of the
/// way to the eye; where the plane itself is farther, nine from the lenses to there.
std::vector<double> mtf_depths_mm(const Subject&);

/// Angles of the views, to the right: 0, a quarter and two fifths of the field of view (of strips, along the panel's rows), the
/// last 45 at most.
std::vector<double> mtf_angles_deg(const Subject&);

std::int64_t mtf_steps(const Subject&);
/// Throws InputError where the eye stands inside the display, or edges at or behind the eye are asked for.
Result measure_mtf(Subject&, Job&);

}  // namespace lfdsim
