// Positions at which each colour of a panel emits. Floor 0.
//
// The panel is a grid of pixels, and a cell of some pixels repeats over it. Positions are in pixels to the right of and below the
// cell's top left corner. docs/model.md, "Subpixels".
#pragma once
#include "display/display.h"

#include <array>
#include <complex>
#include <optional>
#include <vector>

namespace lfdsim {

/// The pixels of a panel at one position of every cell of `cell` columns and rows, counted from the cell's first pixel; a
/// position outside the cell lies in a neighbouring one.
struct PanelPlane {
    std::array<int, 2> cell{1, 1}, pixel{0, 0};
    std::array<bool, 2> whole{};  // black in cells that the panel's right border (x) or lower border (y) cuts
    auto operator<=>(const PanelPlane&) const = default;
};

/// A part of a subpixel that lies in one cell. A subpixel that extends beyond the cell's border has several parts.
struct LitPart {
    int channel;                     // 0, 1, 2; 3: all colours
    PanelPlane plane;                // the cell after which it repeats, and the pixel whose light it shows
    std::array<double, 2> from, to;  // x and y
    double share;                    // of its channel's light: areas of the panel over that of all parts of the channel

    /// Returns how many times brighter it is than its pixel's light, so that a white panel is white in the mean.
    double brightness() const { return share * plane.cell[0] * plane.cell[1] / ((to[0] - from[0]) * (to[1] - from[1])); }
};

/// Returns the parts of all subpixels of a valid panel, shrunk to its aperture ratio, each in the smallest cell after which its
/// channel repeats.
std::vector<LitPart> lit_parts(const Panel&);
/// Returns the same parts with all borders on a grid of `lines` lines a pixel: areas are as near to the true ones as whole sides
/// allow that leave black around each shrunk rectangle.
std::vector<LitPart> lit_parts_on_grid(const Panel&, int lines);

/// Returns the parts of the subpixels of a bounded panel: beyond its right and lower border nothing emits, also where the border
/// cuts a cell and a rectangle of a pixel on the panel lies there. The area of a part beyond the border is a separate part, whose
/// plane is black in such cells.
std::vector<LitPart> bounded_parts(const Panel&);

/// Weights of red, green and blue in a figure; the sum is 1.
using ChannelWeights = std::array<double, 3>;
inline constexpr ChannelWeights luminance_weights{0.2126, 0.7152, 0.0722};  // of linear sRGB
/// Returns weights with which one channel (0, 1, 2) counts alone.
constexpr ChannelWeights only(std::size_t channel) {
    ChannelWeights weights{};
    weights[channel] = 1;
    return weights;
}

/// A white panel whose red, green and blue light counts with given weights.
class WhitePanel {
  public:
    WhitePanel(const Panel&, const ChannelWeights&);
    /// Returns the weighted light at a position, in pixels to the right of and below the panel's top left corner.
    double at(double column, double row) const;
    /// Returns the mean weighted light.
    double mean() const { return weights_[0] + weights_[1] + weights_[2]; }
    /// Returns the amplitude of its harmonic with (k, l) periods in a cell(), c_kl of docs/measures.md, "Moire".
    std::complex<double> harmonic(int k, int l) const;
    /// Returns the size of the cell after which all channels repeat, pixels.
    std::array<int, 2> cell() const { return cell_; }
    /// Returns the order along each axis up to which harmonics are not small.
    std::array<int, 2> highest_order() const { return highest_; }

  private:
    double weight(const LitPart&) const;

    std::vector<LitPart> parts_;
    ChannelWeights weights_;
    std::array<int, 2> cell_{1, 1}, highest_{};
};

/// Returns the planes of a panel's parts, each once; the first is the panel itself.
std::vector<PanelPlane> planes(const Panel&);

/// Returns whether every point of a pixel emits the pixel's colour, so that there are no subpixels and no black matrix.
bool lights_whole_pixels(const Panel&);

/// Returns how many times brighter than the pixel's light the subpixels of a channel (0, 1, 2) emit, so that a white panel is
/// white in the mean: the cell's area over that of the channel's subpixels in it.
double gain(const Panel&, int channel);

/// Returns the largest gain of the three channels.
double peak(const Panel&);

/// A rectangle in which light is emitted, in pixels to the right and down of a pixel's centre, or of a place that is named.
struct SubpixelRect {
    std::array<double, 2> from, to;
    double area() const { return (to[0] - from[0]) * (to[1] - from[1]); }
};
/// Returns the rectangles of the pixel (column, row) in a channel (0, 1, 2), shrunk to the aperture ratio; none where the channel
/// has no subpixel there.
std::vector<SubpixelRect> lit_rects(const Panel&, int channel, std::int64_t column, std::int64_t row);

/// Returns the centroid of a channel's light of the pixel (column, row), from the pixel's centre: pixels to the right and down;
/// nothing where the channel has no subpixel there.
std::optional<std::array<double, 2>> centroid(const Panel&, int channel, std::int64_t column, std::int64_t row);

/// Returns the positions in its pixels for which a display's elemental images are made, as comparable numbers: the cell's size,
/// and centroid() of all of its pixels and channels; 99 where there is none. Empty: the pixels' centres.
std::vector<double> shown_places(const Display&);

/// The cell and the subpixels of a layout before they are shrunk. The layout `none` has no subpixels, in a cell of one pixel.
struct SubpixelCell {
    std::array<std::int64_t, 2> size;  // columns and rows, pixels
    std::vector<Subpixel> subpixels;
};
/// Returns the cell of a panel's layout.
SubpixelCell subpixel_cell(const Panel&);

/// Returns the numbers of two subpixels of a custom layout that overlap, in a cell or with those of a neighbouring one; the same
/// number twice if a subpixel overlaps its repetition; nothing if none overlap.
std::optional<std::pair<std::size_t, std::size_t>> overlapping(const Panel&);

}  // namespace lfdsim
