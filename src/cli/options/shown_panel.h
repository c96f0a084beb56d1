// The panel's light, by the options of panel_source.h. Floor 5.
#pragma once
#include "cli/options/panel_source.h"

namespace lfdsim::cli {

struct PanelTexels {
    Texels texels;
    Json made = Json::object();           // how it was made, for --json
    std::string text = {};                // what a reader should know of it: "; ..." or nothing
    std::vector<std::string> files = {};  // from which its models were read
};

/// Returns the light of the image file, the pattern, or the elemental images of the display's model. Throws InputError, and
/// Interrupted where a signal stops the work.
PanelTexels shown_panel(const PanelImageOption&, const PatternOption&, const Display&, const Geometry&, const PatternOptions&,
                        int threads, Progress&);

/// Returns the stamps (report/folder/run_settings.h) of the files that the command line and the description name, and of which
/// pictures of the display are made.
Json shown_stamps(const PanelImageOption&, const PatternOption&, const Display&);

}  // namespace lfdsim::cli
