// The light budget of a white panel: how much reaches the array, and how much leaves it. Floor 3. docs/measures.md, "Uniformity
// and efficiency".
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/parallel.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>

namespace lfdsim {

/// Light of a white panel, W, for a basic radiance (radiance over n^2) of 1 W/(mm^2 sr) along the panel's normal.
struct LightBudget {
    double emitted;        // by the panel into its hemisphere: n^2 2 pi/(m + 2) times its area, n of the medium on it
    double reaches_array;  // through the array's rectangle at the lenses' lowest point, in the medium below that
    double leaves;         // through the array's rectangle in the vertex plane, without the diffuser, in any direction
    double leaves_in_fov;  // the part of `leaves` with slopes within p/2g along both axes of the array
};

/// The number of parts that light_budgets() runs.
constexpr int light_budget_parts = 128;

/// Returns the budget by each set of rays. Rays are traced backwards from all positions in front of the array in cosine-weighted
/// directions: the mean of the basic radiance that they find, times n^2 pi and the area, is the light that crosses the plane.
/// That is done behind the lenses, with n = 1, and at their lowest point, where n is that of the top layer if lenses are glued
/// onto it (of their own glass on the panel itself): what layers and lenses conserve is radiance over n^2.
std::array<LightBudget, independent_sets> light_budgets(const Display&, const Geometry&, Parts&);

/// Returns the mean of all sets, or of all but one.
LightBudget mean_budget(const std::array<LightBudget, independent_sets>&, int without = -1);

}  // namespace lfdsim
