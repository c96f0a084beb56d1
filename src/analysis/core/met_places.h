// The points of the panel on which the lines of sight of one eye end. Floor 3.
#pragma once
#include "analysis/core/channel_pixels.h"
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace lfdsim {

/// Independent sets of lines of sight. Each line has its mirror image in the plane x = 0 beside it, so that left and right agree
/// on a symmetric display.
class LineSets {
  public:
    /// Makes sets of `count` lines and as many mirrored ones. Their random numbers are those of the sets `first` to `first` + 7
    /// of that seed.
    LineSets(int count, std::int64_t seed, int first = 0);
    const std::array<std::vector<Choice>, independent_sets>& sets() const { return sets_; }
    static Choice mirrored(const Choice& c) { return {-c[0], c[1], -c[2], c[3], -c[4], c[5]}; }

  private:
    std::array<std::vector<Choice>, independent_sets> sets_;
};

/// The ends of those lines that bring light, for each set.
class MetPlaces {
  public:
    /// A point of the panel, and the light of the line that ends there.
    struct Met {
        double x, y, light;    // mm from the panel's centre; light: of a white panel whose pixels emit over their whole area
        std::size_t path = 0;  // number of the light path, of which EyePaths::weights() has the channels
    };
    /// Returns a line's end; nothing if it is blocked. Each of the paths traces an equal part of the lines of every set.
    using Look = std::function<std::optional<Met>(const Choice&, std::size_t path)>;
    MetPlaces(const LineSets&, std::size_t paths, const Look&);

    const std::array<std::vector<Met>, independent_sets>& sets() const { return met_; }

  private:
    std::array<std::vector<Met>, independent_sets> met_;
};

/// Eyes in front of a display, whose lines are traced in each channel's light where glass disperses.
class EyePaths {
  public:
    EyePaths(const Display&, const Geometry&);
    /// Which lines count: in `clear` and `plate` some pass between the lenses.
    enum class Counting { all, by_lens };
    /// Returns the points that an eye's lines meet; the eye in the display's frame, mm.
    MetPlaces look(const Vec3d& eye, const LineSets&, Counting = Counting::all) const;

    /// Returns, for each path, the weights by luminance of red, green and blue in its light.
    const std::vector<ChannelWeights>& weights() const { return weights_; }
    int more_for(const Vec3d& eye) const { return rays_.front().more_for(eye); }

  private:
    std::vector<EyeRays> rays_;  // of each path
    std::vector<ChannelWeights> weights_;
};

}  // namespace lfdsim
