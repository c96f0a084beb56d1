// The light of an eye's view as rows of a matrix: the shares of panel pixels in each element. Floor 3.
#pragma once
#include "engine/views/panel_rays.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lfdsim {

/// Rows of a matrix with few entries. An entry is a place in the panel's light and the share of that light: of a panel whose pixels
/// shine all over in light of any wavelength alike a pixel, of others four times a pixel plus a channel.
struct Rows {
    std::vector<std::uint32_t> start{0};  // of each row's entries, and behind the last
    std::vector<PanelRay> entries;        // of a row in the order of their places, each place once
    std::span<const PanelRay> row(std::size_t k) const { return std::span(entries).subspan(start[k], start[k + 1] - start[k]); }
    std::size_t bytes() const { return entries.size() * sizeof(PanelRay) + start.size() * sizeof(std::uint32_t); }
};

/// Whether an entry stands for a pixel, whose three channels have the same share, or for one channel of it.
bool entries_are_pixels(const Display&);

/// The rows of a display's camera: those of render() by the estimator `point`. May be used by several threads.
class ViewRows {
  public:
    /// `seen`: a display whose camera is the eye, with geometry = resolve(seen). Throws InputError.
    ViewRows(const Display& seen, const Geometry& geometry);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Rays of an element, of all wavelengths together.
    std::int64_t rays() const;
    /// The rows of elements in the picture's rows y0 to y1 - 1.
    Rows of(int y0, int y1) const;

  private:
    struct WavelengthRays {  // rays for light of one wavelength
        PanelRays rays;
        int channel;  // for which they are; -1: all
        float weight;
    };
    void add(const WavelengthRays&, const PanelRay&, std::vector<PanelRay>& row) const;

    int width_, height_;
    bool pixels_, subpixels_;
    std::vector<WavelengthRays> lights_;
};

}  // namespace lfdsim
