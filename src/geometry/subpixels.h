// Where each colour of a panel shines. Floor 0.
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

/// One pixel of each cell of so many columns and rows, counted from the cell's first; a neighbouring cell's where that lies
/// outside.
struct PanelPlane {
    std::array<int, 2> cell{1, 1}, pixel{0, 0};
    std::array<bool, 2> whole{};  // black in cells that the panel's right border (x) or lower border (y) cuts
    auto operator<=>(const PanelPlane&) const = default;
};

/// A part of a subpixel that lies in one cell. Where a subpixel hangs over the cell's border it has several parts.
struct LitPart {
    int channel;                     // 0, 1, 2; 3: all colours
    PanelPlane plane;                // the cell after which it repeats, and the pixel whose light it shows
    std::array<double, 2> from, to;  // x and y
    double share;                    // of its channel's light: areas of the panel over that of all parts of the channel

    /// How much brighter it is than its pixel's light.
    double brightness() const { return share * plane.cell[0] * plane.cell[1] / ((to[0] - from[0]) * (to[1] - from[1])); }
};

/// The parts of all subpixels of a valid panel, shrunk to its aperture ratio, each in the least cell after which its channel
/// repeats.
std::vector<LitPart> lit_parts(const Panel&);

/// The subpixels of a panel that ends: beyond its right and lower border nothing shines, also where the border cuts a cell and
/// a rectangle of a pixel on the panel lies there. What of a part lies beyond is a part of its own, whose plane is black in
/// such cells.
std::vector<LitPart> bounded_parts(const Panel&);

/// What counts of red, green and blue in a figure; the sum is 1.
using ChannelWeights = std::array<double, 3>;
inline constexpr ChannelWeights luminance_weights{0.2126, 0.7152, 0.0722};  // of linear sRGB
constexpr ChannelWeights only(std::size_t channel) {
    ChannelWeights weights{};
    weights[channel] = 1;
    return weights;
}

/// A white panel of which red, green and blue count with these weights.
class WhitePanel {
  public:
    WhitePanel(const Panel&, const ChannelWeights&);
    /// At a place, in pixels to the right of and below the panel's top left corner.
    double at(double column, double row) const;
    double mean() const { return weights_[0] + weights_[1] + weights_[2]; }
    /// The amplitude of its wave with (k, l) periods in a cell().
    std::complex<double> harmonic(int k, int l) const;
    std::array<int, 2> cell() const { return cell_; }
    /// Up to this order harmonics are not small.
    std::array<int, 2> highest_order() const { return highest_; }

  private:
    double weight(const LitPart&) const;

    std::vector<LitPart> parts_;
    ChannelWeights weights_;
    std::array<int, 2> cell_{1, 1}, highest_{};
};

/// The planes of a panel's parts, each once; the first is the panel itself.
std::vector<PanelPlane> planes(const Panel&);

/// Whether every point of a pixel shines in the pixel's own colour.
bool shines_all_over(const Panel&);

/// How much brighter than the pixel's light a point shines that shines at all in a channel (0, 1, 2), so that white is white in
/// the mean: the cell's area over that of the channel's subpixels in it.
double gain(const Panel&, int channel);

/// The largest gain.
double peak(const Panel&);

/// Where the pixel (column, row) shines in a channel: rectangles from its centre, pixels to the right and down. None where the
/// channel has no subpixel there.
struct LitRect {
    std::array<double, 2> from, to;
    double area() const { return (to[0] - from[0]) * (to[1] - from[1]); }
};
std::vector<LitRect> lit_rects(const Panel&, int channel, std::int64_t column, std::int64_t row);

/// The middle of a channel's light of the pixel (column, row), from the pixel's centre: pixels to the right and down. Nothing
/// where the channel has no subpixel there.
std::optional<std::array<double, 2>> centroid(const Panel&, int channel, std::int64_t column, std::int64_t row);

/// For what places of its pixels a display's elemental images are made, as numbers that can be compared: the cell's size, and
/// centroid() of all of its pixels and channels; 99 where there is none. Empty: for the pixels' centres.
std::vector<double> shown_places(const Display&);

/// The cell and the subpixels of a layout before they are shrunk. Of `none` there are none, in a cell of one pixel.
struct SubpixelCell {
    std::array<std::int64_t, 2> size;
    std::vector<Subpixel> subpixels;
};
SubpixelCell subpixel_cell(const Panel&);

/// The numbers of two subpixels of a custom layout that overlap, here or in a cell repeated; twice the same one where it
/// overlaps its own repetition.
std::optional<std::pair<std::size_t, std::size_t>> overlapping(const Panel&);

}  // namespace lfdsim
