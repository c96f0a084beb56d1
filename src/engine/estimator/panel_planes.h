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
    bool summed = true;                            // with tables, for the filtered estimator; single rays need none
    std::vector<PanelPlane> planes{PanelPlane()};  // of its subpixels; the first is the panel itself
    auto operator<=>(const PanelReading&) const = default;
};
/// Returns what the pictures of a display read of its panel.
PanelReading panel_reading(const Display&);

/// Returns an image for each plane of the reading, made at the first call; the reference is valid as long as the panel. Throws
/// std::bad_alloc. May be called by several threads.
const std::vector<optics::SummedImage>& planes_of(const SummedPanel&, const PanelReading& = {});

/// Returns the copies on GPUs of planes that planes_of() has returned for this panel, made at first use. Throws std::logic_error
/// for other planes.
GpuPanels& gpu_panels_of(const SummedPanel&, const std::vector<optics::SummedImage>& planes);

}  // namespace lfdsim
