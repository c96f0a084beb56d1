// The keys of a display that a page may change, with their values and ranges. Floor 5.
#pragma once
#include "analysis/core/result.h"
#include "display/display.h"

namespace lfdsim::view {

/// Returns the "controls" of the message "resolved" (docs/view-protocol.md), for a valid display. `described` is the display
/// without the page's changes: the ranges of sliders follow from its values, so that they do not move while a slider is dragged.
Json controls(const Display&, const Display& described);

}  // namespace lfdsim::view
