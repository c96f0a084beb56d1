// The light that an eye gathers, by the viewers that it is meant for. Floor 3.
#pragma once
#include "analysis/meant_panel.h"
#include "analysis/met_places.h"

#include <array>
#include <limits>
#include <vector>

namespace lfdsim {

/// The light that one eye gathers of a white panel, by the slopes that what shines there is meant for.
class MeantLight {
  public:
    /// Of what the eye's lines meet; for each path what its channels count.
    MeantLight(const MetPlaces&, const std::vector<ChannelWeights>&, const MeantPanel&);
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
    double brightest_ = 0;
};

}  // namespace lfdsim
