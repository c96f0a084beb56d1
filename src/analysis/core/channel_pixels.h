// One channel of a display: the rectangles of the panel that emit it, the points for which its content is made, and the path of
// its light. Floor 3.
#pragma once
#include "display/colour.h"
#include "display/display.h"
#include "geometry/geometry.h"
#include "geometry/subpixels.h"

#include <array>
#include <complex>
#include <optional>
#include <vector>

namespace lfdsim {

/// Whether colours have light paths, or places on the panel, of their own. Else one path serves all three.
bool has_colours(const Display&);

/// The display in light of one wavelength, and the share of the channel's light that has it.
struct LightPath {
    Geometry geometry;
    double weight;
};
/// The light paths of a channel; `green`: the display's own geometry, which is the only one where nothing disperses.
std::vector<LightPath> light_paths(const Display&, const Geometry& green, std::size_t channel);

class ChannelPixels {
  public:
    using Place = std::array<double, 2>;  // pixels to the right of and below the panel's top left corner

    ChannelPixels(const Display&, std::size_t channel);

    struct Shining {
        double brightness;  // over the pixel's own light: white is 1 in the mean
        Place shown;        // the point for which the content of the pixel that shines here is made
    };
    /// What shines at a position; nothing where the channel does not shine, as where a subpixel belongs to a pixel off the panel.
    std::optional<Shining> at(const Place&) const;

    /// The mean of exp(2 pi i nu (place - shown)) over its light, nu in periods per pixel to the right and down.
    std::complex<double> wave(double nu_x, double nu_y) const;

    /// The mean of place - shown.
    Place middle() const;

    /// The width in pixels of its narrowest part along a direction, parallel to the panel: to the first zero of its sinc.
    double narrowest(double x, double y) const;

    /// The largest brightness of the channel over white's mean.
    double gain() const;

  private:
    /// A shining rectangle of the channel and the points for which its content is made.
    struct ChannelRect {
        LitPart lit;
        Place shown, pixel;  // from the corner of the cell that it lies in
    };
    Place size_;  // of the panel
    std::vector<ChannelRect> parts_;
};

}  // namespace lfdsim
