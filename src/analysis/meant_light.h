// The light that an eye gathers, by the viewers that it is meant for. Floor 3.
#pragma once
#include "analysis/estimate.h"
#include "analysis/eye_rays.h"
#include "content/pickup.h"

#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace lfdsim {

/// Independent sets of lines of sight, with each line its mirror image in the plane x = 0.
class LineSets {
  public:
    /// `count` lines in each set, and as many mirrored.
    LineSets(int count, std::int64_t seed);
    const std::array<std::vector<Choice>, independent_sets>& sets() const { return sets_; }
    static Choice mirrored(const Choice& c) { return {-c[0], c[1], -c[2], c[3], -c[4], c[5]}; }

  private:
    std::array<std::vector<Choice>, independent_sets> sets_;
};

/// The viewers that a panel point is meant for: the horizontal slope at which its elemental image's lens shows it, through its
/// nodal points, to a viewer in front of the screen's middle. A viewer at x, E from the principal plane, is meant to see the slope
/// x/E. Of strips, which number views by pixels, it is the slope that the centre of the whole pixel is meant for. Nothing: no lens
/// owns the point.
std::optional<double> meant_slope(const Pickup&, const Geometry&, double x_mm, double y_mm);

/// The light that one eye gathers of a white panel, by the slopes that its points are meant for.
class MeantLight {
  public:
    MeantLight(const EyeRays&, const Pickup&, const Geometry&, const Vec3d& eye, const LineSets&);
    /// Of the slopes from low to high. Light exactly at either end counts half.
    Sums between(double low, double high) const;
    Sums all() const { return between(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()); }
    /// Crosstalk in per cent, 100 leak / signal: infinite where there is leak alone, NaN where there is no light. The error is at
    /// least that of three lines of sight, as so many may be missed by chance.
    Estimate crosstalk_percent(const Sums& leak, const Sums& signal) const;

  private:
    struct Ray {
        double slope;
        float light;  // sums of floats in double are exact, so that mirrored displays have the same sums
    };
    std::array<std::vector<Ray>, independent_sets> rays_;
    double slope_tolerance_;
};

}  // namespace lfdsim
