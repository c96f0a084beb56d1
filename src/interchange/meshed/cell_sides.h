// The borders of a cell of the array, of the array, and of what represents an infinite sheet. Floor 2.
#pragma once
#include "geometry/geometry.h"
#include "optics/lattice.h"

#include <array>
#include <vector>

namespace lfdsim {

/// Returns half the side, mm, of the square that represents an infinite sheet: rays that pass beside it could only reach the panel
/// at more than 87 degrees from its normal.
double sheet_half(const Geometry&);

/// Returns half the sides of the box about a cell, mm along x' and y'. Strips, which have no end, end with the sheet, at whole
/// millimetres, which single precision holds.
std::array<double, 2> cell_half(const Geometry&);
/// Returns half the sides of the box about all cells, mm along x' and y'; strips are as long as cell_half() says.
std::array<double, 2> array_half(const Geometry&);

/// Returns the corners of a cell, counter-clockwise; the right side is that from corner 0 to corner 1. Strips are as long as
/// cell_half() says.
optics::CellCorners<double> cell_corners(const Geometry&);

/// A side of a cell.
struct CellSide {
    std::array<double, 2> out;            // unit vector normal to it, outwards, in the array's frame
    double from_axis_mm, half_length_mm;  // its distance from the axis; half its length
};

/// Returns the sides of a cell, counter-clockwise from the right one.
std::vector<CellSide> cell_sides(const Geometry&);

}  // namespace lfdsim
