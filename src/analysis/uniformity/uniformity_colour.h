// How even the colour of a white panel is, over the screen and over viewing angle. Floor 3.
#pragma once
#include "analysis/core/channel_pixels.h"
#include "analysis/core/chromaticity.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "analysis/core/result.h"
#include "analysis/core/screen_parts.h"

#include <span>

namespace lfdsim {

/// A white panel whose channels shine where their subpixels are, each seen at its wavelengths.
class ColouredWhite {
  public:
    explicit ColouredWhite(const Subject&);

    /// The mean light of a block of lenses in red, green and blue over the panel's own, as an eye sees it by such lines of sight,
    /// and the share of the lines that are on the screen, over which the mean is taken.
    struct BlockColour {
        std::array<double, 3> light{};
        double on_screen = 0;
    };
    BlockColour look(const Vec3d& eye, const ScreenParts&, const LensBlock&, std::span<const Choice>) const;
    /// The factor by which more lines are needed, as EyeRays::more_for().
    int more_for(const Vec3d& eye) const { return paths_.front().rays.more_for(eye); }

  private:
    /// A path of light and the weights of the channels that take it.
    struct ColourPath {
        EyeRays rays;
        std::array<double, 3> weight;  // of the channels whose light takes it
    };
    const Panel& panel_;
    std::array<ChannelPixels, 3> pixels_;
    std::vector<ColourPath> paths_;
};

/// The work of tell_colour_uniformity(): parts, and about how many lines of sight. 0 where colours do not differ.
struct ColourWork {
    int parts;
    std::int64_t lines;
};
ColourWork colour_work(const Subject&);
/// Adds the uniformity of colour to a result; where colours do not differ all distances are 0.
void tell_colour_uniformity(const Subject&, double viewing_distance_mm, Parts&, Result&);

}  // namespace lfdsim
