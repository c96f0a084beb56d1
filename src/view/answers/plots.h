// The two plots that a page may ask for: small measurements, in seconds. Floor 5.
#pragma once
#include "analysis/core/result.h"
#include "content/content.h"

#include <string>

namespace lfdsim::view {

/// Returns the likeness (SSIM) of the simulated view to the scene against the horizontal angle, from small pictures, with the
/// theoretical field of view and the angle of the eye. It takes a few seconds at most. Throws InputError for panels of more than
/// 7680 x 4320 pixels, which would take longer; Stopped where the job is cancelled. `device` is that of renderings, as
/// RenderOptions has it.
Plot fov_plot(const Display&, const ContentScene&, const std::string& device, const Job&);

/// Returns the width of the spot of a panel point on the lens's axis, traced through the lens, against depth from the vertex plane,
/// with the width of a pixel's image; the central depth plane is marked. It takes milliseconds.
Plot spot_plot(const Display&);

}  // namespace lfdsim::view
