// Pictures of displays with evenly spread light that sum up to that of a display with a gaussian diffuser. Floor 2.
#pragma once
#include "display/display.h"

#include <vector>

namespace lfdsim {

struct EvenPart {
    Display display;
    float weight;
};

/// The filtered estimator's blocks take light to be spread evenly over the diffuser's angles, and a bell would have no end: of a
/// bell these are displays with box diffusers (geometry/diffuser_profile.h), the more and the finer rendered the more samples are
/// wanted; of any other display, and for point samples, the display itself. Weights sum to 1.
std::vector<EvenPart> even_parts(const Display&);

}  // namespace lfdsim
