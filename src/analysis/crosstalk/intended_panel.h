// Viewers for whom the light of a white panel is intended, point by point. Floor 3.
#pragma once
#include "analysis/core/channel_pixels.h"
#include "content/pickup/pickup.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lfdsim {

/// A panel on which each pixel, or subpixel, shines as a whole for the viewer that its elemental image's lens shows its centre, or
/// centroid, to.
class MeantPanel {
  public:
    /// The panel of a display. With subpixels, content may be made for each of them or for whole pixels.
    MeantPanel(const Display&, const Geometry&, ContentSampling);

    /// The viewers that a point's light is meant for, as slopes. A point on the border of elemental images has those of each of
    /// their lenses, as rounding chooses one; NaN: that lens does not exist, and the point is dark.
    class ViewerSlopes {
      public:
        explicit ViewerSlopes(double slope) : slopes_{slope} {}
        std::span<const double> all() const { return {slopes_.data(), count_}; }
        double chosen() const { return slopes_.front(); }
        void add(double slope);

      private:
        std::array<double, 4> slopes_;
        std::size_t count_ = 1;
    };
    /// A shining point: its light and the viewers that it is meant for.
    struct ShiningPoint {
        double light;  // with its channels' weights; 1 is the mean of white with weights of 1 together
        ViewerSlopes slopes;
    };
    /// What shines at a place on the panel, mm from its middle, in light of channels with these weights. Nothing: it is dark
    /// there, or no lens owns what shines.
    std::optional<ShiningPoint> at(double x_mm, double y_mm, const ChannelWeights&) const;

    /// The viewers that a pixel's centre is meant for.
    std::optional<double> slope_of_pixel(double column, double row) const {
        const double slope = this->slope(mm({column + 0.5, row + 0.5}));
        return std::isnan(slope) ? std::nullopt : std::optional(slope);
    }

    /// The share of the panel's light whose centres lie on the border of two lenses' elemental images, or within a fiftieth of a
    /// pixel of it.
    double share_on_borders() const;

  private:
    using Point = std::array<double, 2>;  // mm from the panel's middle
    Point mm(const ChannelPixels::Place& place) const {
        return {(place[0] - 0.5 * size_[0]) * pixel_mm_, (0.5 * size_[1] - place[1]) * pixel_mm_};
    }
    /// The horizontal slope at which a lens shows a point, through its nodal points, to a viewer in front of the screen's middle: a
    /// viewer at x, E from the principal plane, is meant to see the slope x/E. NaN: no lens owns the point.
    double slope(const Point&) const;
    /// The slopes of all lenses whose elemental images are nearer than `margin` mm.
    ViewerSlopes slopes(const Point&, double margin) const;

    Pickup pickup_;
    std::vector<ChannelPixels> pixels_;  // of each channel, or of all three where they shine together
    std::array<double, 2> size_;         // of the panel, pixels
    double pixel_mm_, gap_mm_;
};

}  // namespace lfdsim
