// Rendering until the error is small enough. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "model/job.h"

#include <optional>

namespace lfdsim {

/// Renders a tile in blocks of 16 x 16 pixels of the frame, each with more and more samples until its estimated error, linear
/// light, is below `target` in all groups of 4 x 4 pixels (root mean square over a group and its colours), or the samples are at
/// their limit. `error`, laid out as the picture, takes each group's error of each colour. Returns the number of samples taken,
/// or nothing where the job was cancelled on the way: a small target may take long.
///
/// Points: independent repetitions with seeds of their own, twice as many each time; the error is the standard error of their mean.
/// Filtered: at least twice as many rows and columns of strata each time; the error is the difference from the time before, which
/// is that of the coarser picture.
std::optional<std::int64_t> refine_tile(Kernel, const Tile&, double target, float* error, const Job&);

}  // namespace lfdsim
