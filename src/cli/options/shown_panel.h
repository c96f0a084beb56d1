// The panel's light, from what the command line says that it shows. Floor 5.
#pragma once
#include "cli/options/panel_source.h"

namespace lfdsim::cli {

struct PanelTexels {
    Texels texels;
    Json made = Json::object();  // how it was made, for what a command prints as JSON
};

/// The image file, the pattern, or the elemental images of the display's model. Throws InputError, and Interrupted where a signal
/// ends the making.
PanelTexels shown_panel(const PanelImageOption&, const PatternOption&, const Display&, const Geometry&, const PatternOptions&,
                        int threads, Progress&);

/// What tells that what the panel would show has changed: the image's file, or those of the display's model.
Json shown_stamp(const PanelImageOption&, const PatternOption&, const Display&);

}  // namespace lfdsim::cli
