// Estimates of the time that a picture takes, and the choice of a size that takes a given time. Floor 5.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <algorithm>

namespace lfdsim::view {

/// Returns roughly the seconds that rendering the camera's picture takes on one core of a laptop: only the ratio between sizes
/// matters. The filtered estimator shares its rays over blocks of pixels, which must be smaller where pixels see more of a lens: a
/// small picture may take longer than a large one. `rough`: as of RenderOptions.
double render_cost(const Display&, const Geometry&, bool rough = false);

/// Conversion of costs to true seconds, learned from each picture: the last one counts half, those before it the other half.
class Pace {
  public:
    explicit Pace(double seconds_per_cost) : seconds_per_cost_(seconds_per_cost) {}
    void learn(double cost, double seconds) {
        seconds_per_cost_ = known_ ? 0.5 * (seconds_per_cost_ + seconds / cost) : seconds / cost;
        known_ = true;
    }
    double seconds(double cost) const { return cost * seconds_per_cost_; }

  private:
    double seconds_per_cost_;
    bool known_ = false;
};

/// Returns the first of `count` choices, ordered from the best, that takes at most most_seconds; where none does, the first that
/// takes at most 1.5 times as long as the quickest. A choice better than `last`, the previous one, must take at most 0.8 of the
/// time, so that pictures do not flicker between two sizes. seconds(k) is the time of choice k.
template <class Seconds>
int best_in_time(int count, int last, double most_seconds, const Seconds& seconds) {
    double quickest = seconds(0);
    for (int k = 1; k < count; ++k) quickest = std::min(quickest, seconds(k));
    const auto fits = [&](int k) { return seconds(k) <= std::max((k < last ? 0.8 : 1) * most_seconds, 1.5 * quickest); };
    int k = 0;
    while (!fits(k)) ++k;
    return k;
}

}  // namespace lfdsim::view
