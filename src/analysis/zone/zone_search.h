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

/// Shares of the lines of sight from one eye (docs/measures.md, "Viewing zone"). Wrong and mixed share are relative to the lines
/// that get through a lens whose elemental image has its middle on the panel (lenses at the screen's rim may be half in front of
/// the panel, and their images beside it), and NaN if there are none.
struct SightShares {
    // wrong: of lines that end elsewhere than on a pixel of their lens's elemental image; mixed: on the image of a different
    // neighbour than most lines do, so that in a repeated zone all lines are wrong and few are mixed; dark: of all lines,
    // blocked, beside the panel, or on a pixel that no lens owns, and 1 if no line gets through.
    double wrong, mixed, dark;
};
/// Returns the shares by the given lines of an eye, mm, display frame.
SightShares sight_shares(const EyeRays&, const Pickup&, const Display&, const Vec3d& eye, std::span<const Choice>);

/// The paraxial zone of the m lenses in front of the panel along one axis: viewers at slopes and distances from H'
/// (docs/model.md, "Theory").
struct ParaxialZone {
    double half_fov, fault_per_mm;  // p'/2g; (m - 1) p/2, the shift in slope per difference of inverse distances
    double made_for_mm;             // M, the distance for which elemental images are made
    /// Returns the slope to which the zone extends at the distance E: p'/2g - (m - 1)(p/2) |1/E - 1/M|, not below 0.
    double half_slope(double eye_mm) const {
        return std::max(half_fov - fault_per_mm * std::abs(1 / eye_mm - 1 / made_for_mm), 0.);
    }
    /// Returns by how much 1/E may differ from 1/M on the axis: p'/(p g (m - 1)).
    double reach_per_mm() const { return half_fov / fault_per_mm; }
    /// Returns the zone's nearest (-1) or farthest (1) distance on the axis, mm.
    double distance_mm(int side) const {
        const double inverse = 1 / made_for_mm - side * reach_per_mm();
        return inverse > 0 ? 1 / inverse : infinity;
    }
};

/// Returns the zone along x' (axis 0) or y' (1); of strips, along the panel's rows.
ParaxialZone paraxial_zone(const Subject&, std::size_t axis);

inline constexpr std::array zone_thresholds{0.01, 0.5};  // of the share of wrong rays

/// What eyes at several positions see, and the intervals of positions in which the wrong share is at most each threshold.
struct Zone {
    std::vector<double> places;  // mm
    std::vector<SightShares> shares;
    std::array<Interval, 2> limits;  // for each of zone_thresholds
    /// Returns one of the shares at all positions.
    std::vector<double> all(double SightShares::*share) const {
        std::vector<double> values;
        for (const SightShares& s : shares) values.push_back(s.*share);
        return values;
    }
};

/// Eyes about the viewing zone that look at the screen. Its functions throw Stopped.
class ZoneSearch {
  public:
    static constexpr int map_side = 61;  // positions of map() along each axis

    ZoneSearch(Subject&, Job&, std::int64_t steps);
    /// Returns the zone along x (axis 0) or y (1) in the plane at the viewing distance, searched to `half_mm` on either side.
    Zone sideways(std::size_t axis, double half_mm);
    /// Returns the zone along the display's axis: positions are distances from the panel, mm, the farthest first.
    Zone on_axis(const ParaxialZone& theory);
    /// Returns the shares at map_side x map_side positions of that plane, row by row, row 0 at the top.
    std::vector<SightShares> map(const std::array<double, 2>& half_mm);
    /// Returns the position, mm, of the k-th column or row of map(), ascending.
    static double map_place(int k, double half_mm) { return half_mm * ((2 * k + 1.) / map_side - 1); }

  private:
    /// Returns the shares of an eye by the first `rays` lines of a set.
    SightShares at(const Vec3d& eye, int rays, std::uint32_t set = 0) const;
    /// Returns the zone along a path, on which `eye_at` gives the eye for each position.
    Zone along(std::vector<double> places, const std::function<Vec3d(double)>& eye_at);

    const Subject& subject_;
    double distance_;
    EyeRays rays_;
    Pickup pickup_;
    int more_;
    std::array<std::vector<Choice>, independent_sets> choices_;  // the first set serves maps and curves
    Parts parts_;
};

}  // namespace lfdsim
