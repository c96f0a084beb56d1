// Pictures that show a photograph and a simulation together. Floor 0.
#pragma once
#include "image/overlay/overlay.h"

namespace lfdsim {

/// Returns four pictures of the screen with labels: simulated; photograph; both as a checkerboard, in which edges that do not meet
/// show that the corners are off; half of each.
Image overlay_picture(const Match&, const Region& screen);

/// Returns the difference of the luma of sRGB-encoded values, photograph less simulation: red is brighter, blue darker, white
/// equal. The legend has the scale.
Image difference_picture(const Match&, const Region& screen);

}  // namespace lfdsim
