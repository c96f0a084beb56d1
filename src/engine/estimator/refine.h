// Rendering until the error is small enough: `--target-error` in docs/model.md, "What a default picture is made of". Floor 2.
#pragma once
#include "base/job.h"
#include "engine/devices/kernel.h"

#include <array>
#include <optional>
#include <vector>

namespace lfdsim {

/// The colours of a block of refined_side x refined_side pixels, row by row.
using RefinedPicture = std::array<float, refined_side * refined_side * 3>;
/// The place of such a block in the frame.
struct RefinedBlock {
    std::int32_t x, y;  // first pixel, multiples of refined_side
};

/// Renders blocks of 16 x 16 pixels, whole even where a crop cuts through them, so that no pixel depends on the crop; pixels
/// outside the frame are left as they are. May stop once the job is cancelled.
class BlockPainter {
  public:
    virtual ~BlockPainter() = default;
    /// Renders each block with `points` points a pixel, by the numbers of `seed`. `pictures` has one for each block.
    virtual void paint(const std::vector<RefinedBlock>&, std::uint32_t points, std::uint64_t seed,
                       std::vector<RefinedPicture>& pictures) = 0;
};

/// Renders the blocks that overlap a tile, each with more and more samples until its estimated error, linear light, is below
/// `target` in all groups of 4 x 4 pixels (root mean square over a group and its colours), or the samples are at their limit.
/// Each group's error of each colour is written to `error`, laid out as the picture. Returns the number of samples taken, or
/// nothing where the job was cancelled on the way: a small target may take long. The order in which blocks are done changes no
/// bit.
///
/// Samples are points, in independent repetitions with different seeds, twice as many each time; the error is the standard error of
/// their mean.
std::optional<std::int64_t> refine_tile(BlockPainter&, const Tile& tile, double target, float* error, const Job&);

/// Refines with a CPU kernel, block after block.
std::optional<std::int64_t> refine_tile(Kernel, const Tile& tile, double target, float* error, const Job&);

}  // namespace lfdsim
