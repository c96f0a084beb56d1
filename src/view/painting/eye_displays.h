// The display for each eye of a visitor, and coarser stand-ins for it. Floor 5.
#pragma once
#include "view/painting/panels.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

/// A display whose camera is one eye.
struct EyeDisplay {
    std::string lane;  // "one", "left", "right"
    Display display;
    Geometry geometry;
    Display made_for;  // for which the panel's light is made: another display where elemental images are held (Shown::hold)
    Geometry made_for_geometry;
    PanelContent source;
    PanelContent model;  // of the scene, for photographs; its name is empty where there is none
    PanelKey key;        // of the panel's light
};

/// Returns the displays of the eyes, the left one first. Throws InputError.
std::vector<EyeDisplay> seen(const Library&, const Wanted&);

/// Returns the display with a panel of `divisor` >= 1 times fewer columns and rows, of larger pixels: its elemental images are
/// close to the true ones. Nothing where such a display is not valid.
std::optional<EyeDisplay> with_coarse_panel(const EyeDisplay&, int divisor);

/// Returns a display with the fastest view of the same: columns and rows times `scale`, 0 to 1, the fewest possible samples, and
/// neither pixel filter nor pupil, which would need many. `on_gpu`: a GPU renders it, by points only, of which it has time for
/// many. Its geometry must be resolved again.
Display coarse_view(Display, const Geometry&, double scale, bool on_gpu);

}  // namespace lfdsim::view
