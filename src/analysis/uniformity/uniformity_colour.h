// Uniformity of the colour of a white panel, over the screen and over viewing angle. Floor 3.
#pragma once
#include "analysis/core/channel_pixels.h"
#include "analysis/core/chromaticity.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "analysis/core/result.h"
#include "analysis/core/screen_parts.h"

#include <span>

namespace lfdsim {

/// A white panel whose channels emit where their subpixels are, each traced at its wavelengths.
class ColouredWhite {
  public:
    explicit ColouredWhite(const Subject&);

    /// The mean light of a block of lenses in red, green and blue, relative to the panel's along its normal, over those lines of
    /// sight that are on the screen; and the share of the lines that are.
    struct BlockColour {
        std::array<double, 3> light{};
        double on_screen = 0;
    };
    /// Returns the light of a block that an eye sees along the given lines.
    BlockColour look(const Vec3d& eye, const ScreenParts&, const LensBlock&, std::span<const Choice>) const;
    /// Returns the factor by which more lines are needed, as EyeRays::more_for().
    int more_for(const Vec3d& eye) const { return paths_.front().rays.more_for(eye); }

  private:
    /// A path of light and the weights of the channels that take it.
    struct ColourPath {
        EyeRays rays;
        std::array<double, 3> weight;  // share of each channel's light that takes it
    };
    const Panel& panel_;
    std::array<ChannelPixels, 3> pixels_;
    std::vector<ColourPath> paths_;
};

/// The work of tell_colour_uniformity(): its parts, and about how many lines of sight it traces. 0 if colours do not differ.
struct ColourWork {
    int parts;
    std::int64_t lines;
};
ColourWork colour_work(const Subject&);
/// Adds the uniformity of colour to a result; if colours do not differ all distances are 0.
void tell_colour_uniformity(const Subject&, double viewing_distance_mm, Parts&, Result&);

}  // namespace lfdsim
