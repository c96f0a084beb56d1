// Photograph and simulation for the eye. Floor 0.
#pragma once
#include "image/overlay/overlay.h"

namespace lfdsim {

/// Four pictures of the screen with labels: simulated, photograph; both as a checkerboard, in which edges that do not meet show
/// that the corners are off; half of each.
Image overlay_picture(const Match&, const Region& screen);

/// The luma of sRGB-encoded values, photograph less simulation: red is brighter, blue darker, white equal; the legend says how
/// much.
Image difference_picture(const Match&, const Region& screen);

}  // namespace lfdsim
