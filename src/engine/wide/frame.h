// A picture's work as a wide machine takes it, such as a GPU: steps of thousands of equal items, each a thread's. Plain data.
// Floor 2.
#pragma once
#include "engine/kernel.h"

#include <cstddef>

namespace lfdsim::wide {

/// What an item of a step is. A step begins when all items of the one before are done.
enum class Step {
    points,   // point samples: a pixel
    even,     // filtered estimator: an even cut of the diffuser's angles
    blocks,   // a block: its place and its axes
    bundles,  // a stratum of a block
    survey,   // a block: what its bundles are
    places,   // a place of a block
    pixels    // a pixel of a block
};

/// A block that is picked out: its first pixel, and the square of refined_side x refined_side pixels of the output, one behind the
/// other, that the square of the frame goes to in which the block lies.
struct ListedBlock {
    std::int32_t x, y, square;
};

/// What every item of every step is given. Memory is the machine's.
struct Frame {
    optics::Scene<float> scene;
    optics::View view;
    optics::DirectionNumbers directions;
    Tile tile;  // but for scene, view and directions, which each item takes from above

    // The blocks of the frame, tile.block_side wide and high, that a step works on: those listed, or those of the rectangle that
    // holds the tile, row after row, from number `first_block` on.
    const ListedBlock* listed;
    std::int64_t first_block;
    std::int32_t first_column, first_row, columns;  // of the rectangle, in blocks

    // Filtered estimator: at `even` room for the even cuts, at `memory` bytes_per_block for each block at hand.
    void* even;
    std::byte* memory;
    std::size_t bytes_per_block;
};

}  // namespace lfdsim::wide
