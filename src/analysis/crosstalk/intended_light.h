// The light that an eye receives, by the viewers for whom it is intended. Floor 3.
#pragma once
#include "analysis/core/met_places.h"
#include "analysis/crosstalk/intended_panel.h"

#include <array>
#include <limits>
#include <vector>

namespace lfdsim {

/// A part of the light that an eye receives, for each set of lines of sight.
struct LightPart {
    Sums light{};
    // Half of the light, of all sets, that belongs to the part by one of several lenses only: of points on the border of
    // elemental images, whose lens rounding chooses. The part may be greater or less by as much.
    double open = 0;
};

/// Crosstalk in per cent; NaN where rounding decides on more than half of it and on more than 1 %.
struct Crosstalk {
    Estimate percent;
    bool left_to_rounding = false;
};
/// Returns 100 leak / signal: infinite if there is only leak, NaN if there is no light. `missed` is the share of all light that
/// may be missed by chance, a lower bound of the error. The error covers each lens to which light on the border of elemental
/// images may belong.
Crosstalk crosstalk_of(const LightPart& leak, const LightPart& signal, double missed);

/// The light that one eye receives from a white panel, by the slopes for which it is intended.
class MeantLight {
  public:
    /// Assigns slopes to the points that an eye's lines meet; the weights are those of the channels of each path.
    MeantLight(const MetPlaces&, const std::vector<ChannelWeights>&, const MeantPanel&);
    /// Returns the light intended for slopes from low to high. Light exactly at either end counts half, as does light on the
    /// border of elemental images of which only one is intended for these slopes.
    LightPart between(double low, double high) const;
    LightPart all() const { return between(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()); }
    /// Returns the weight of the three brightest lines over all light: that much may be missed by chance.
    double missed() const { return 3 * brightest_ / total(all().light); }

  private:
    /// A line of sight that ends within an elemental image: the slope that its light is meant for.
    struct InnerRay {
        double slope;
        float light;  // float, whose sums in double are exact, so that mirrored displays have equal sums
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

/// The light that a view, or an eye, should show, and the light that it should not.
struct Leak {
    LightPart signal, leak;
};
/// Returns the light of the left (0) or the right eye (1), intended for slopes below or above 0, and the other eye's as its leak.
Leak leak_of_side(const MeantLight&, std::size_t side);
/// Returns the crosstalk of a part of this light.
Crosstalk crosstalk_of(const MeantLight&, const Leak&);

}  // namespace lfdsim
