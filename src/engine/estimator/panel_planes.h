// What the renderer reads of a panel: its image and, for the filtered estimator, summed-area tables. Floor 2.
#pragma once
#include "engine/estimator/summed_panel.h"
#include "geometry/subpixels.h"

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

/// An image for each plane of the reading, made at the first call. Throws std::bad_alloc. May be called by several threads.
const std::vector<optics::SummedImage>& planes_of(const SummedPanel&, const PanelReading& = {});

/// The copies of such planes that GPUs hold, made at first use.
GpuPanels& gpu_panels_of(const SummedPanel&, const std::vector<optics::SummedImage>& planes);

}  // namespace lfdsim
