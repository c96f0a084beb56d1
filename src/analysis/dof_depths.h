// The depths at which a scene is shown to find the depth of field. Floor 3.
#pragma once
#include "analysis/subject.h"

#include <string>
#include <vector>

namespace lfdsim {

/// Depths of the scene's centre in front of the vertex plane, rising, without a gap; and why they end where they do.
struct DepthRun {
    std::vector<double> depths_mm;
    std::string why_low, why_high;
};

/// Those of the options; else 31 in all, even over 1/z, over twice the range of theory's depth of field: one run behind the lenses,
/// one in front of them, or both where the range goes through infinity. They are cut where the scene would reach the eye, where it
/// would look smaller than 16 rows of the camera's picture, and at the lenses. Empty: nothing is left.
std::vector<DepthRun> dof_depths(const Subject&);

}  // namespace lfdsim
