// The light that an eye gathers, by the viewers that it is meant for. Floor 3.
#pragma once
#include "analysis/core/met_places.h"
#include "analysis/crosstalk/intended_panel.h"

#include <array>
#include <limits>
#include <vector>

namespace lfdsim {

/// Some of the light that an eye gathers.
struct LightPart {
    Sums light{};
    double open =
        0;  // it may be so much more or less: light of points on the border of elemental images, whose lens rounding chooses
};

/// Crosstalk in per cent. Where rounding decides on more than half of it, and on more than 1 %, it is NaN.
struct Crosstalk {
    Estimate percent;
    bool left_to_rounding = false;
};
/// 100 leak / signal: infinite where there is leak alone, NaN where there is no light. `missed`: the share of the light that may be
/// missed by chance. The error covers both lenses that light on the border of elemental images may belong to.
Crosstalk crosstalk_of(const LightPart& leak, const LightPart& signal, double missed);

/// The light that one eye gathers of a white panel, by the slopes that what shines there is meant for.
class MeantLight {
  public:
    /// Sorts the places that the eye's lines meet; the weights are those of the channels of each path.
    MeantLight(const MetPlaces&, const std::vector<ChannelWeights>&, const MeantPanel&);
    /// The light meant for slopes from low to high. Light exactly at either end counts half, and so does light on the border of
    /// elemental images of which one only has it there.
    LightPart between(double low, double high) const;
    LightPart all() const { return between(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()); }
    /// The weight of three lines of sight, as so many may be missed by chance, over all light.
    double missed() const { return 3 * brightest_ / total(all().light); }

  private:
    /// A line of sight that ends within an elemental image: the slope that its light is meant for.
    struct InnerRay {
        double slope;
        float light;  // sums of floats in double are exact, so that mirrored displays have the same sums
    };
    /// A line of sight that ends on the border of elemental images.
    struct BorderRay {
        MeantPanel::ViewerSlopes slopes;
        float light;
    };
    std::array<std::vector<InnerRay>, independent_sets> rays_;
    std::array<std::vector<BorderRay>, independent_sets> on_borders_;
    double brightest_ = 0;
};

}  // namespace lfdsim
