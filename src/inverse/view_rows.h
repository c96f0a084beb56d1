// The light of an eye's view as rows of a matrix: the shares of panel pixels in each element. Floor 3.
#pragma once
#include "engine/views/panel_rays.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lfdsim {

/// Rows of a matrix with few entries. An entry is a place in the panel's light and the share of that light. The place is the number
/// of a pixel where its three channels have the same share (entries_are_pixels()), else four times that number plus the channel.
struct Rows {
    std::vector<std::uint32_t> start{0};  // of each row's entries, and behind the last
    std::vector<PanelRay> entries;        // of a row in the order of their places, each place once
    std::span<const PanelRay> row(std::size_t k) const { return std::span(entries).subspan(start[k], start[k + 1] - start[k]); }
    /// Returns the bytes that the rows take.
    std::size_t bytes() const { return entries.size() * sizeof(PanelRay) + start.size() * sizeof(std::uint32_t); }
};

/// Returns whether an entry stands for a pixel, whose three channels have the same share; with subpixels or dispersion it stands
/// for one channel.
bool entries_are_pixels(const Display&);

/// The matrix M of a display's camera, whose product with the panel's light is the picture that render() makes by the estimator
/// `point`. An element is a pixel of that picture. May be used by several threads.
class ViewRows {
  public:
    /// `seen`: a display whose camera is the eye, with geometry = resolve(seen). Throws InputError.
    ViewRows(const Display& seen, const Geometry& geometry);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Returns the rays of an element, of all wavelengths together.
    std::int64_t rays() const;
    /// Returns the rows of the matrix for the elements in the picture's rows y0 to y1 - 1, one after the other.
    Rows of(int y0, int y1) const;

  private:
    struct WavelengthRays {  // rays for light of one wavelength
        PanelRays rays;
        int channel;   // for which they are; -1: all
        float weight;  // of this wavelength in the channel
    };
    /// Appends a ray's entries, one for each channel that it has light of; one in all where entries are pixels.
    void add(const WavelengthRays&, const PanelRay&, std::vector<PanelRay>& row) const;

    int width_, height_;
    bool pixels_, subpixels_;
    std::vector<WavelengthRays> lights_;
};

}  // namespace lfdsim
