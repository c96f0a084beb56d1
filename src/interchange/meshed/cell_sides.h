// The border of a cell of the array. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <vector>

namespace lfdsim {

/// Half the sides of the square that represents an infinite sheet: rays that pass beside it could only reach the panel at more than
/// 87 degrees from its normal.
double sheet_half(const Geometry&);

/// Half the sides of the box about a cell, and of the box about all cells. Strips, which have no end, end with the sheet, at whole
/// millimetres, which single precision holds.
std::array<double, 2> cell_half(const Display&, const Geometry&);
std::array<double, 2> array_half(const Display&, const Geometry&);

/// A side of a cell: it is normal to `out`, a unit vector in the array's frame.
struct CellSide {
    std::array<double, 2> out;
    double from_axis_mm, half_length_mm;
};

/// The sides of a rectangle, or of a hexagon with corners up and down, counter-clockwise from the right one.
std::vector<CellSide> cell_sides(const Display&, const Geometry&);

}  // namespace lfdsim
