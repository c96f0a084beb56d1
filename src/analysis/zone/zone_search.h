// Search for the viewing zone, in which the whole screen shows its own elemental images, by lines of sight from viewers about the
// zone. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "analysis/fov/thresholds.h"
#include "base/constants.h"
#include "content/pickup/pickup.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace lfdsim {

/// The dark share of the lines of sight from one eye through the screen (blocked, beside the panel, or on a pixel that no lens
/// owns), 1 if there are none; and of those that get through a lens whose elemental image has its middle on the panel, NaN if
/// none does (lenses at the screen's rim may stand half in front of the panel, and their images beside it),
/// - the wrong share: ends elsewhere than on a pixel of its lens's own elemental image, on another's, so that views repeat, or on
/// none;
/// - the mixed share: ends on the image of another neighbour than most do. In a repeated zone all are wrong and few are mixed.
struct SightShares {
    double wrong, mixed, dark;
};
SightShares sight_shares(const EyeRays&, const Pickup&, const Display&, const Vec3d& eye, std::span<const Choice>);

/// The paraxial zone of m lenses: slopes of viewers at distance eye_mm from H', made for made_for_mm; and the inverse distances.
struct ParaxialZone {
    double half_fov, fault_per_mm;  // p'/2g; (m - 1) p/2 per difference of inverse distances
    double made_for_mm;
    double half_slope(double eye_mm) const {
        return std::max(half_fov - fault_per_mm * std::abs(1 / eye_mm - 1 / made_for_mm), 0.);
    }
    double reach_per_mm() const { return half_fov / fault_per_mm; }
    double distance_mm(int side) const {  // -1: the nearest, 1: the farthest
        const double inverse = 1 / made_for_mm - side * reach_per_mm();
        return inverse > 0 ? 1 / inverse : infinity;
    }
};

ParaxialZone paraxial_zone(const Subject&, std::size_t axis);

inline constexpr std::array zone_thresholds{0.01, 0.5};  // of the share of wrong rays

/// A zone has what eyes at some places, mm, see, and from where to where no more is wrong than each threshold.
struct Zone {
    std::vector<double> places;
    std::vector<SightShares> shares;
    std::array<Interval, 2> limits;
    std::vector<double> all(double SightShares::*share) const {
        std::vector<double> values;
        for (const SightShares& s : shares) values.push_back(s.*share);
        return values;
    }
};

/// ZoneSearch looks at the screen from eyes about the zone. Throws Stopped.
class ZoneSearch {
  public:
    static constexpr int map_side = 61;

    ZoneSearch(Subject&, Job&, std::int64_t steps);
    /// Looks from eyes along x (axis 0) or y (1) in the plane at the viewing distance, as far as `half_mm`.
    Zone sideways(std::size_t axis, double half_mm);
    /// Looks from eyes on the axis: places are distances from the panel, the farthest first.
    Zone on_axis(const ParaxialZone& theory);
    /// Looks from all over that plane: map_side x map_side places, row 0 at the top.
    std::vector<SightShares> map(const std::array<double, 2>& half_mm);
    static double map_place(int k, double half_mm) { return half_mm * ((2 * k + 1.) / map_side - 1); }

  private:
    SightShares at(const Vec3d& eye, int rays, std::uint32_t set = 0) const;
    /// Looks from the eyes that `eye_at` gives for each place, and seeks the limits there.
    Zone along(std::vector<double> places, const std::function<Vec3d(double)>& eye_at);

    const Subject& subject_;
    double distance_;
    EyeRays rays_;
    Pickup pickup_;
    int more_;
    std::array<std::vector<Choice>, independent_sets> choices_;  // the first of them draws maps and curves
    Parts parts_;
};

}  // namespace lfdsim
