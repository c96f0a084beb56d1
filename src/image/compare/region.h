// Parts of a picture with one interval of pixels in each row. Floor 0.
#pragma once
#include "image/image.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lfdsim {

/// Pixels of a picture: columns [from, to) of each row from `top` on. Empty rows have from >= to.
struct Region {
    struct Row {
        int from, to;
    };
    int top = 0;
    std::vector<Row> rows;

    static Region of(const Rect&);
    /// Returns the pixels of a picture of width x height pixels whose centres lie in a convex polygon of at least three corners (x,
    /// y), pixels from the picture's upper left corner. Throws std::invalid_argument for fewer corners.
    static Region polygon(std::span<const std::array<double, 2>> corners, int width, int height);

    std::int64_t pixels() const;
    Rect bounds() const;  // of the rows that are not empty; 0, 0, 0, 0 if all are
    Region shifted(int columns, int rows) const;
    Region intersected(const Region&) const;
};

}  // namespace lfdsim
