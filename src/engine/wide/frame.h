// A picture's work for a wide machine, such as a GPU: steps of thousands of equal items, one for each thread. Plain data. Floor 2.
#pragma once
#include "engine/kernel.h"

#include <cstddef>

namespace lfdsim::wide {

/// The steps, and what one item of each is. A step begins when all items of the step before are done. A worker takes every n-th
/// entry of a list (WorkList), n being their number.
enum class Step {
    points,   // point samples: a pixel
    even,     // filtered estimator: an even cut of the diffuser's angles
    blocks,   // a block: its place and its axes; lists its bundles
    bundles,  // a worker: bundles, one for each stratum of a block
    survey,   // a block: what its bundles are; lists blocks whose pixels look for light by themselves
    places,   // a place of a block
    soft,     // a pixel of a block that is not listed: light between places
    pixels,   // a worker: pixels of the listed blocks, whose other light is shared
    alone     // a worker: pixels of the listed blocks in which nothing is shared
};

/// What a later step has to do, found out by an earlier one, in any order.
struct WorkList {
    std::uint32_t* count;
    std::uint32_t* number;
};

/// A block of the frame to be rendered: its first pixel, and the number of the output square (refined_side x refined_side pixels,
/// stored one after another) for the square of the frame in which the block lies.
struct ListedBlock {
    std::int32_t x, y, square;
};

/// The input of every item of every step. Pointers are to the machine's memory.
struct Frame {
    optics::Scene<float> scene;
    optics::View view;
    optics::DirectionNumbers directions;
    Tile tile;  // except for scene, view and directions, which each item takes from above

    // The blocks of the frame, tile.block_side wide and high, that a step works on: those listed, or those of the rectangle that
    // holds the tile, row after row, from number `first_block` on.
    const ListedBlock* listed;
    std::int64_t first_block;
    std::int32_t first_column, first_row, columns;  // of the rectangle, in blocks

    // Filtered estimator: `even` has room for the even cuts, `memory` bytes_per_block for each block at hand.
    void* even;
    std::byte* memory;
    std::size_t bytes_per_block;
    WorkList bundles;      // block x strata of the room for a block + stratum
    WorkList busy, alone;  // blocks
    std::int64_t workers;  // of the steps that take their work from a list
};

}  // namespace lfdsim::wide
