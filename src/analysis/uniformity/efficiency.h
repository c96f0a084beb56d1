// Where the panel's light goes. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/parallel.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>

namespace lfdsim {

/// Light of a white panel, W for a basic radiance (radiance over n^2) of 1 W/(mm^2 sr) along its normal.
struct LightBudget {
    double emitted;        // by the panel, into its hemisphere: n^2, of what lies on it, times its area times 2 pi / (m + 2)
    double reaches_array;  // of it, the array's rectangle at the height of its lowest point, in the medium below that
    double leaves;         // through the array's rectangle in the vertex plane, without the diffuser, in any direction
    double leaves_in_fov;  // of it, with slopes within p/2g along both axes of the array
};

constexpr int light_budget_parts = 128;

/// The budget by each set of rays. Rays are traced backwards from all places in front of the array and in all directions, so that
/// each stands for an equal share of a uniform radiance: the panel's radiance that they find, times pi and the area, is the light
/// that leaves. Likewise what reaches the array is sought backwards through the layers; where lenses are glued on, in the
/// top layer (or in their own glass on the panel itself), times n^2: radiance over n^2 is what layers and lenses pass on.
std::array<LightBudget, independent_sets> light_budgets(const Display&, const Geometry&, Parts&);

/// The mean of all sets but one.
LightBudget mean_budget(const std::array<LightBudget, independent_sets>&, int without = -1);

}  // namespace lfdsim
