// How much of a filtered picture single random rays made, and how noisy that is. Floor 5.
#pragma once
#include "cli/output.h"
#include "engine/render.h"

#include <optional>
#include <string>

namespace lfdsim::cli {

/// Found on a sample of at most 16 squares of 16 x 16 pixels, rendered again with other random numbers: what footprints shared by
/// blocks of pixels give stays the same to the last bit.
struct RandomLight {
    double share;  // of the sampled pixels that show light: those that change
    double
        noise_rms;  // standard deviation of their channels by the random rays, root of the mean square over those that show light
};

/// Of a picture by the filtered estimator without a target error. None where the sample shows no light, or the job is cancelled.
std::optional<RandomLight> random_light(const Display&, const Geometry&, const SummedPanel& panel, const Rendering&, RenderOptions,
                                        const Job&);

/// "12 % of pixels by random rays of their own: noise 0.03"; empty where next to none are.
std::string words_of(const RandomLight&);
Json json_of(const RandomLight&);

}  // namespace lfdsim::cli
