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

/// Returns whether the channels differ in their light paths (dispersion) or in their positions on the panel (subpixels). If not,
/// one path serves all three.
bool has_colours(const Display&);

/// The display in light of one wavelength, and that wavelength's share of the channel's light.
struct LightPath {
    Geometry geometry;
    double weight;
};
/// Returns the light paths of a channel; their weights add up to 1. `green` is the display's geometry, which is the only path
/// where nothing disperses.
std::vector<LightPath> light_paths(const Display&, const Geometry& green, std::size_t channel);

/// The rectangles of a panel that emit one channel, and the points for which their content is made.
class ChannelPixels {
  public:
    using Place = std::array<double, 2>;  // pixels to the right of and below the panel's top left corner

    ChannelPixels(const Display&, std::size_t channel);

    struct Shining {
        double brightness;  // over the pixel's own light: white is 1 in the mean
        Place shown;        // the point for which the content of the pixel that shines here is made
    };
    /// Returns what emits at a position; nothing where the channel does not, as between rectangles or where a subpixel belongs to
    /// a pixel off the panel.
    std::optional<Shining> at(const Place&) const;

    /// Returns the mean of exp(2 pi i nu.(place - shown)) over the channel's light, nu in periods per pixel to the right and
    /// down: sum of share sinc(nu_x w) sinc(nu_y h) exp(2 pi i nu.(M - shown)) over rectangles of width w, height h and middle M
    /// (docs/measures.md, "Resolution", colours).
    std::complex<double> wave(double nu_x, double nu_y) const;

    /// Returns the mean of place - shown over the channel's light, pixels.
    Place middle() const;

    /// Returns the width, pixels, of the channel's narrowest rectangle along a direction, a unit vector in the panel's plane: the
    /// inverse of the frequency of the first zero of its sinc.
    double narrowest(double x, double y) const;

    /// Returns the largest brightness of the channel's rectangles.
    double gain() const;

  private:
    /// A shining rectangle of the channel and the points for which its content is made.
    struct ChannelRect {
        LitPart lit;
        // From the corner of the cell in which the rectangle lies; pixel: top left corner of the pixel whose value it shows
        Place shown, pixel;
    };
    Place size_;  // of the panel
    std::vector<ChannelRect> parts_;
};

}  // namespace lfdsim
