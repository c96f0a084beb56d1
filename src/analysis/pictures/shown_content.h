// The panel's picture of a scene, by the pick-up that the display states. Floor 3.
#pragma once
#include "content/content.h"
#include "inverse/inverse.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// Returns the boxes of eyes that the inverse pick-up serves: those of content.inverse.eyes_mm; else the zone at the viewing
/// distance in which at most 1 % of the rays are wrong (analysis/zone), or at most half of them if there is none, or that of
/// paraxial theory. Along y the zone is flat for strips, and 40 mm high for lenses that image along both axes. Empty if the job
/// is cancelled.
std::vector<EyeBox> inverse_eyes(const Display&, const Geometry&, int threads, const Job&);

/// The panel's picture of a scene.
struct ShownContent {
    Picture picture;
    std::optional<InverseReport> inverse;  // with the inverse pick-up
};

/// Returns what elemental_images() returns, or invert() with content.pickup = "inverse". Throws InputError. If the job is
/// cancelled the picture is marked incomplete.
ShownContent shown_content(const Display&, const Geometry&, const ContentScene&, int threads, Job&);

}  // namespace lfdsim
