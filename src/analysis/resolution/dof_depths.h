// The depths at which a scene is shown to measure the depth of field. Floor 3.
#pragma once
#include "analysis/core/subject.h"

#include <string>
#include <vector>

namespace lfdsim {

/// Depths of the scene's centre, mm from the vertex plane, ascending, from behind the lenses to in front of them; and why they
/// end where they do.
struct DepthRun {
    std::vector<double> depths_mm;
    std::string why_low, why_high;
};

/// Returns the depths of the options; otherwise 31 over the depth of field by the lens or by the pixel and a quarter more, denser
/// near the lenses, whose plane is one of them (docs/measures.md, "Depth of field"). A range that reaches the viewer, or infinity
/// behind the lenses, counts to twice its beginning, or at least to a quarter of the viewing distance. Depths are cut where the
/// scene would reach the eye, and where it would be less than 16 rows high in the picture. Empty: nothing is left.
DepthRun dof_depths(const Subject&);

}  // namespace lfdsim
