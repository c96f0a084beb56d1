// The keys of a display that a page may change, with their values and ranges. Floor 5.
#pragma once
#include "analysis/core/result.h"
#include "display/display.h"

namespace lfdsim::view {

/// The "controls" of the message "resolved" (docs/view-protocol.md), for a valid display. `described` is the display without the
/// page's changes: sliders have its values in the middle, so that their ranges do not move while they are dragged.
Json controls(const Display&, const Display& described);

}  // namespace lfdsim::view
