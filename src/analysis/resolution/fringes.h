// Pictures of the colours that a viewer sees of colourless content: a white screen, and an edge between black and white. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"

#include <vector>

namespace lfdsim {

/// Adds pictures of a white screen on axis, and of the 16 lenses in its middle; none if colours do not differ. Throws Stopped.
void show_white_fringes(const Subject&, const Job&, Result&);

/// Adds a picture of a slanted edge at a depth, mm from the vertex plane, seen from the first and the last of these angles, each
/// beside the edge itself; none if colours do not differ. Throws Stopped.
void show_edge_fringes(const Subject&, double depth_mm, const std::vector<double>& angles_deg, const Job&, Result&);

}  // namespace lfdsim
