// The luminance of a white screen against the viewing angle. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/subject.h"

#include <array>
#include <vector>

namespace lfdsim {

/// Returns viewing angles from -80 to 80 degrees.
std::vector<double> luminance_angles_deg();

/// Eyes at the viewing distance see this mean luminance of a white screen.
class LuminanceOverAngle {
  public:
    LuminanceOverAngle(const Subject&, const EyeRays&, double distance_mm);
    /// The luminance is NaN where eyes cannot be, or see no panel through the array. Each line's mirror images in both planes are
    /// traced too.
    Sums at(int axis, double angle_deg) const;
    /// Finds where, from the middle to one side (-1 or 1), the luminance first falls below half of that on axis; NaN: nowhere.
    /// `light` is that at `angles`.
    Estimate half_deg(int axis, const std::vector<double>& angles, const std::vector<double>& light, int side) const;

  private:
    Estimate half_between(int axis, double bright, double dark) const;

    const EyeRays& rays_;
    double distance_, nearest_;
    std::array<std::vector<Choice>, independent_sets> sets_;
};

}  // namespace lfdsim
