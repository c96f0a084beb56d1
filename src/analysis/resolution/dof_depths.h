// The depths at which a scene is shown to find the depth of field. Floor 3.
#pragma once
#include "analysis/core/subject.h"

#include <string>
#include <vector>

namespace lfdsim {

/// Depths of the scene's centre in front of the vertex plane, rising, from behind the lenses to in front of them; and why they end
/// where they do.
struct DepthRun {
    std::vector<double> depths_mm;
    std::string why_low, why_high;
};

/// Those of the options; else 31 over what theory calls sharp by the lens or by the pixel, and a quarter more, the closer the
/// nearer to the lenses; the lenses' own plane is one of them. Of depths that are sharp as far as the viewer, or without end behind
/// the lenses, those to twice the first, or to a quarter of the viewing distance. Cut where the scene would reach the eye, and
/// where it would look smaller than 16 rows of the camera's picture. Empty: nothing is left.
DepthRun dof_depths(const Subject&);

}  // namespace lfdsim
