// The measure of resolution: the modulation transfer function of what a display shows, at several depths and angles. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns the depths of the edges, mm from the vertex plane: the option's, or nine, evenly on either side of the central depth
/// plane as far as the published depth of field is deep, but not nearer to the lenses than a tenth of the central depth nor
/// farther than 3/4 of the way to the eye; if the plane itself is farther, nine from the lenses to there.
std::vector<double> mtf_depths_mm(const Subject&);

/// Returns the angles of the views to the right, degrees: 0, a quarter and two fifths of the field of view (of strips along the
/// panel's rows), at most 30 and 45.
std::vector<double> mtf_angles_deg(const Subject&);

/// Returns the number of planes and directions.
std::int64_t mtf_steps(const Subject&);
/// Measures resolution (docs/measures.md, "Resolution"). Throws InputError if the eye is inside the display, or for edges at or
/// behind the eye; Stopped.
Result measure_mtf(Subject&, Job&);

}  // namespace lfdsim
