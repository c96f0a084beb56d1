// What of a display a page may change: its keys, with their values and how far they may go. Floor 5.
#pragma once
#include "analysis/result.h"
#include "model/display.h"

namespace lfdsim::view {

/// The "controls" of the message "resolved" (docs/view-protocol.md), for a valid display. `described` is the display without what
/// the page has changed: sliders have its values in their middle, so that they do not move while one drags them.
Json controls(const Display&, const Display& described);

}  // namespace lfdsim::view
