// The panel's picture of a scene, by whichever pick-up the display asks for. Floor 3.
#pragma once
#include "content/content.h"
#include "inverse/inverse.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// The boxes of eyes that the inverse pick-up serves: those of content.inverse.eyes_mm, else the zone, at the viewing distance, in
/// which at most 1 % of the rays are wrong (analysis/zone); where there is none half of them; else that of paraxial theory. Along y
/// it is flat for strips, and 40 mm high for lenses that image both ways. None if the job is cancelled.
std::vector<EyeBox> inverse_eyes(const Display&, const Geometry&, int threads, const Job&);

struct ShownContent {
    Picture picture;
    std::optional<InverseReport> inverse;  // of the inverse pick-up
};

/// elemental_images(), or invert() if content.pickup = "inverse". Throws InputError.
ShownContent shown_content(const Display&, const Geometry&, const ContentScene&, int threads, Job&);

}  // namespace lfdsim
