// The viewing zone: from where all of the screen shows its own elemental images. Floor 3.
#pragma once
#include "analysis/core/eye_rays.h"
#include "analysis/core/result.h"
#include "content/pickup/pickup.h"

#include <span>

namespace lfdsim {

/// Of the lines of sight from one eye through the screen the share that is dark (blocked, beside the panel, or on a pixel that no
/// lens owns), 1 if there are none; and of those that get through a lens whose elemental image has its middle on the panel, NaN if
/// none does (lenses at the screen's rim may stand half in front of the panel, and their images beside it),
/// - the wrong share: ends elsewhere than on a pixel of its lens's own elemental image, on another's, so that views repeat, or on
/// none;
/// - the mixed share: ends on the image of another neighbour than most do. In a repeated zone all are wrong and few are mixed.
struct SightShares {
    double wrong, mixed, dark;
};
SightShares sight_shares(const EyeRays&, const Pickup&, const Display&, const Vec3d& eye, std::span<const Choice>);

std::int64_t zone_steps(const Subject&);
Result measure_zone(Subject&, Job&);

}  // namespace lfdsim
