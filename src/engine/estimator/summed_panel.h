// The panel as the renderer reads it: its image and, for the filtered estimator, summed-area tables. Floor 2.
#pragma once
#include "geometry/subpixels.h"
#include "image/texels.h"

#include <memory>
#include <vector>

namespace lfdsim {

class GpuPanels;  // gpu.h

namespace optics {  // optics/traced_display.h
struct SummedImage;
}

/// The planes and tables of a panel that a display's pictures read.
struct PanelReading {
    bool summed = true;                            // the filtered estimator; single rays do without tables
    std::vector<PanelPlane> planes{PanelPlane()};  // of its subpixels; the first is the panel itself
    auto operator<=>(const PanelReading&) const = default;
};
PanelReading panel_reading(const Display&);

/// A panel image and what is made of it at first use: a summed-area table for each plane. A table takes as much memory as the image
/// it sums, 16 bytes a pixel. The panel image must outlive it, unchanged.
class SummedPanel {
  public:
    /// Keeps a reference to the panel; tables are made at first use. `threads`: those that make them, 0: all.
    explicit SummedPanel(const Texels& panel, int threads = 0);
    ~SummedPanel();
    SummedPanel(SummedPanel&&) noexcept;
    SummedPanel& operator=(SummedPanel&&) noexcept;

    /// An image for each plane of the reading, made at the first call. Throws std::bad_alloc. May be called by several threads.
    const std::vector<optics::SummedImage>& planes(const PanelReading& = {}) const;

    /// The copies of such planes that GPUs hold, made at first use.
    GpuPanels& on_gpus(const std::vector<optics::SummedImage>& planes) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace lfdsim
