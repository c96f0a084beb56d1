// The display that each eye of a visitor sees, and coarser stand-ins for it. Floor 5.
#pragma once
#include "view/painting/panels.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

/// The display as one eye sees it, and the display that its panel's light was made for, a different one where the elemental
/// images are held.
struct EyeDisplay {
    std::string lane;
    Display display;
    Geometry geometry;
    Display made_for;
    Geometry made_for_geometry;
    PanelContent source;
    PanelContent model;  // of the scene, for photographs; its name is empty where there is none
    PanelKey key;
};

/// Returns the displays of the eyes, the left one first. Throws InputError.
std::vector<EyeDisplay> seen(const Library&, const Wanted&);

/// The display with a panel of `divisor` times fewer columns and rows, of larger pixels: its elemental images are close to the
/// true ones. Nothing where such a display is not valid. divisor >= 1.
std::optional<EyeDisplay> with_coarse_panel(const EyeDisplay&, int divisor);

/// The fastest view of the same: columns and rows times `scale`, 0 .. 1, the fewest possible samples, and neither pixel filter nor
/// pupil, which would need many. `on_gpu`: a GPU renders it, which takes points alone and has time for many. Its geometry must be
/// resolved again.
Display coarse_view(Display, const Geometry&, double scale, bool on_gpu);

}  // namespace lfdsim::view
