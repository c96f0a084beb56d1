// Where the panel's light goes. Floor 3.
#pragma once
#include "analysis/estimate.h"
#include "analysis/parallel.h"
#include "model/display.h"
#include "model/geometry.h"

#include <array>

namespace lfdsim {

/// Light of a white panel, W for a radiance of 1 W/(mm^2 sr) along its normal.
struct LightBudget {
    double emitted;        // by the panel, into its hemisphere: its area times 2 pi / (m + 2)
    double reaches_array;  // of it, the array's rectangle at the height of its lowest point
    double leaves;         // through the array's rectangle in the vertex plane, before the diffuser, in any direction
    double leaves_in_fov;  // of it, with slopes within p/2g along both axes of the array
};

constexpr int light_budget_parts = 128;

/// Rays traced backwards from all places before the array and in all directions, as many of each as carry equal shares of an even
/// radiance: what they find of the panel's, times pi and the area, is the light that leaves.
/// As each set of rays finds it.
std::array<LightBudget, independent_sets> light_budgets(const Display&, const Geometry&, Parts&);

/// The mean of all sets but one.
LightBudget mean_budget(const std::array<LightBudget, independent_sets>&, int without = -1);

}  // namespace lfdsim
