// Crosstalk: how much of what is meant for others an eye sees. Floor 3.
#pragma once
#include "analysis/eye_rays.h"
#include "analysis/result.h"
#include "content/pickup.h"

#include <limits>
#include <span>
#include <vector>

namespace lfdsim {

/// The light that one eye gathers of a white panel, told by whom its panel points are meant for: the horizontal slope at which
/// their elemental image's lens shows them, through its nodal points, to a viewer before the screen's middle. A viewer at x, E from
/// the principal plane, is meant to see the slope x/E.
class MeantLight {
  public:
    MeantLight(const EyeRays&, const Pickup&, const Geometry&, const Vec3d& eye, std::span<const Choice>);
    /// Of the slopes from low to high, high excluded.
    double between(double low, double high) const;
    double all() const { return between(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()); }

  private:
    struct Ray {
        double slope, light;
    };
    std::vector<Ray> rays_;
};

/// Woods 2012 for a panel whose black is black: leak / signal. Infinite or NaN where there is no signal.
double crosstalk_of(double leak, double signal);

std::int64_t crosstalk_steps(const Subject&);
Result measure_crosstalk(Subject&, Job&);

}  // namespace lfdsim
