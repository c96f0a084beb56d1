// Viewers for whom the light of a white panel is intended, point by point. Floor 3.
#pragma once
#include "analysis/core/channel_pixels.h"
#include "content/pickup/pickup.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lfdsim {

/// A panel on which each pixel, or subpixel, emits as a whole for those viewers to whom the lens of its elemental image shows its
/// centre, or its centroid.
class MeantPanel {
  public:
    /// The panel of a display with content made for each subpixel or for whole pixels.
    MeantPanel(const Display&, const Geometry&, ContentSampling);

    /// The viewers for whom a point's light is intended, as slopes. On the border of elemental images rounding chooses one lens:
    /// such a point has a slope for each of the neighbouring lenses; NaN: that lens does not exist, and the point is dark. At
    /// most four.
    class ViewerSlopes {
      public:
        explicit ViewerSlopes(double slope) : slopes_{slope} {}
        std::span<const double> all() const { return {slopes_.data(), count_}; }
        /// Returns the slope for the lens that rounding chooses.
        double chosen() const { return slopes_.front(); }
        /// Adds a slope unless it is there, or four are.
        void add(double slope);

      private:
        std::array<double, 4> slopes_;
        std::size_t count_ = 1;
    };
    /// A point that emits: its light and the viewers for whom it is intended.
    struct ShiningPoint {
        double light;  // with its channels' weights; 1 is the mean of white with weights of 1 together
        ViewerSlopes slopes;
    };
    /// Returns what emits at a point of the panel, mm from its centre, in light of channels with these weights; nothing if it is
    /// dark there, or if what emits belongs to no lens.
    std::optional<ShiningPoint> at(double x_mm, double y_mm, const ChannelWeights&) const;

    /// Returns the slope for which a pixel's centre is intended; nothing if no lens owns it.
    std::optional<double> slope_of_pixel(double column, double row) const {
        const double slope = this->slope(mm({column + 0.5, row + 0.5}));
        return std::isnan(slope) ? std::nullopt : std::optional(slope);
    }

    /// Returns the share of the panel's light of pixels, or subpixels, whose centres lie within a/50 of the border of two lenses'
    /// elemental images.
    double share_on_borders() const;

  private:
    using Point = std::array<double, 2>;  // mm from the panel's centre
    /// Returns a position in pixels, rows downwards, in mm from the panel's centre.
    Point mm(const ChannelPixels::Place& place) const {
        return {(place[0] - 0.5 * size_[0]) * pixel_mm_, (0.5 * size_[1] - place[1]) * pixel_mm_};
    }
    /// Returns the horizontal slope s = (e C - P)/g at which the lens at C shows the point P, through its nodal points, from the
    /// screen's middle: a viewer at x, at the distance E from H', should see it for s = x/E. On slanted strips along the panel's
    /// rows. NaN: no lens owns the point.
    double slope(const Point&) const;
    /// Returns the slopes for all lenses whose elemental images are nearer than `margin` mm.
    ViewerSlopes slopes(const Point&, double margin) const;

    Pickup pickup_;
    std::vector<ChannelPixels> pixels_;  // for each channel, or one for all without subpixels
    std::array<double, 2> size_;         // of the panel, pixels
    double pixel_mm_, gap_mm_;
};

}  // namespace lfdsim
