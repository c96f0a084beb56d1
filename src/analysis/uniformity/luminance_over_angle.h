// The luminance of a white screen over the viewing angle. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/subject.h"

#include <array>
#include <vector>

namespace lfdsim {

/// Returns viewing angles from -80 to 80 degrees.
std::vector<double> luminance_angles_deg();

/// The mean luminance of a white screen that eyes at the viewing distance see.
class LuminanceOverAngle {
  public:
    /// `distance_mm`: of the eyes from the panel's centre. Keeps a reference to the rays.
    LuminanceOverAngle(const Subject&, const EyeRays&, double distance_mm);
    /// Returns the luminance relative to the panel's along its normal, for each set, of an eye at an angle along x (axis 0) or y
    /// (1); NaN if the eye would be inside the display or sees no panel through the array. Each line's mirror images in both
    /// planes are traced, too.
    Sums at(int axis, double angle_deg) const;
    /// Returns the angle, from the middle to one side (-1 or 1), at which the luminance first falls below half of that on axis;
    /// NaN if it does not. `light` is the luminance at `angles`.
    Estimate half_deg(int axis, const std::vector<double>& angles, const std::vector<double>& light, int side) const;

  private:
    Estimate half_between(int axis, double bright, double dark) const;

    const EyeRays& rays_;
    double distance_, nearest_;
    std::array<std::vector<Choice>, independent_sets> sets_;
};

}  // namespace lfdsim
