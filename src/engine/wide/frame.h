// A picture's work for a wide machine, such as a GPU: thousands of equal items, one for each thread. Plain data. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "optics/traced_display.h"

#include <cstdint>

namespace lfdsim::wide {

/// The first pixel of a square of the frame, refined_side pixels wide and high, that is to be rendered.
struct ListedSquare {
    std::int32_t x, y;
};

/// The input of every item, which renders a pixel by point samples. Pointers are to the machine's memory.
struct Frame {
    optics::TracedDisplay<float> display;
    optics::RayOrigin view;
    optics::DirectionNumbers directions;
    Tile tile;  // its display, view and directions are not used: each item takes those above

    // The squares of the frame that are rendered: those listed, whose pictures are stored one after another, or those of the
    // rectangle that holds the tile, row after row, from number `first_square` on.
    const ListedSquare* listed;
    std::int64_t first_square;
    std::int32_t first_column, first_row, columns;  // of the rectangle, in squares
};

}  // namespace lfdsim::wide
