// Where on the panel the lines of sight of one eye end. Floor 3.
#pragma once
#include "analysis/core/channel_pixels.h"
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace lfdsim {

/// Independent sets of lines of sight, with each line its mirror image in the plane x = 0.
class LineSets {
  public:
    /// `count` lines in each set, and as many mirrored; their random numbers are those of sets from `first` on.
    LineSets(int count, std::int64_t seed, int first = 0);
    const std::array<std::vector<Choice>, independent_sets>& sets() const { return sets_; }
    static Choice mirrored(const Choice& c) { return {-c[0], c[1], -c[2], c[3], -c[4], c[5]}; }

  private:
    std::array<std::vector<Choice>, independent_sets> sets_;
};

/// The ends of those lines that bring light.
class MetPlaces {
  public:
    struct Met {
        double x, y, light;    // mm from the panel's middle; of a white panel whose pixels shine all over
        std::size_t path = 0;  // in which channels' light
    };
    /// A line's end, or nothing where it is blocked. Each of the paths takes an equal share of every set.
    using Look = std::function<std::optional<Met>(const Choice&, std::size_t path)>;
    MetPlaces(const LineSets&, std::size_t paths, const Look&);

    const std::array<std::vector<Met>, independent_sets>& sets() const { return met_; }

  private:
    std::array<std::vector<Met>, independent_sets> met_;
};

/// Eyes before a display whose channels are seen in their own light where glass disperses.
class EyePaths {
  public:
    EyePaths(const Display&, const Geometry&);
    MetPlaces look(const Vec3d& eye, const LineSets&) const;

    /// The weights of red, green and blue in the light of each path, by luminance.
    const std::vector<ChannelWeights>& weights() const { return weights_; }
    int more_for(const Vec3d& eye) const { return rays_.front().more_for(eye); }

  private:
    std::vector<EyeRays> rays_;  // of each path
    std::vector<ChannelWeights> weights_;
};

}  // namespace lfdsim
