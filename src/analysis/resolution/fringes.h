// Pictures of the colours that a viewer sees of what has none: a white screen, and an edge between black and white. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"

#include <vector>

namespace lfdsim {

/// A white screen from straight in front of it, and its middle from near by. None where colours do not differ. Throws Stopped.
void show_white_fringes(const Subject&, const Job&, Result&);

/// A slanted edge at a depth in front of the vertex plane, seen from the first and the last of these angles, each beside what
/// should be seen. None where colours do not differ. Throws Stopped.
void show_edge_fringes(const Subject&, double depth_mm, const std::vector<double>& angles_deg, const Job&, Result&);

}  // namespace lfdsim
