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

/// The depths of the options; otherwise 31 over the depth of field by the lens or by the pixel and a quarter more, denser near
/// the lenses, whose plane is one of them. Of depths that are sharp as far as the viewer, or without end behind the lenses, those
/// to twice the first, or to a quarter of the viewing distance. Cut where the scene would reach the eye, and where it would look
/// smaller than 16 rows of the camera's picture. Empty: nothing is left.
DepthRun dof_depths(const Subject&);

}  // namespace lfdsim
