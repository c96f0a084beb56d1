// For which viewers the light of a white panel is meant, place by place. Floor 3.
#pragma once
#include "analysis/channel_pixels.h"
#include "content/pickup.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// A panel on which each pixel, or subpixel, shines as a whole for the viewer that its elemental image's lens shows its centre, or
/// centroid, to.
class MeantPanel {
  public:
    /// With subpixels, content may be made for each of them or for whole pixels.
    MeantPanel(const Display&, const Geometry&, ContentSampling);

    struct Meant {
        double light;  // with its channels' weights; 1 is the mean of white with weights of 1 together
        double slope;
    };
    /// Of a place on the panel, mm from its middle, in light of channels with these weights. Nothing: it is dark there, or no lens
    /// owns what shines.
    std::optional<Meant> at(double x_mm, double y_mm, const ChannelWeights&) const;

    /// The viewers that a pixel's centre is meant for.
    std::optional<double> slope_of_pixel(double column, double row) const { return slope({column + 0.5, row + 0.5}); }

  private:
    /// The horizontal slope at which a lens shows a point, through its nodal points, to a viewer in front of the screen's middle: a
    /// viewer at x, E from the principal plane, is meant to see the slope x/E. Nothing: no lens owns the point.
    std::optional<double> slope(const ChannelPixels::Place&) const;

    Pickup pickup_;
    std::vector<ChannelPixels> pixels_;  // of each channel, or of all three where they shine together
    std::array<double, 2> size_;         // of the panel, pixels
    double pixel_mm_, gap_mm_;
};

}  // namespace lfdsim
