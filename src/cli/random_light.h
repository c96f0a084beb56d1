// How much of a filtered picture single random rays made, and how noisy that is. Floor 5.
#pragma once
#include "engine/render.h"

namespace lfdsim::cli {

/// Found on a sample of at most 16 squares of 16 x 16 pixels, rendered again with other random numbers: what footprints shared by
/// blocks of pixels give stays the same to the last bit.
struct RandomLight {
    double share;  // of the sampled pixels that show light: those that change
    double
        noise_rms;  // standard deviation of their channels by the random rays, root of the mean square over those that show light
};

/// Of a picture by the filtered estimator without a target error. None where the sample shows no light, or the job is cancelled.
std::optional<RandomLight> random_light(const Display&, const Geometry&, const Pyramid& panel, const Rendering&, RenderOptions,
                                        const Job&);

}  // namespace lfdsim::cli
