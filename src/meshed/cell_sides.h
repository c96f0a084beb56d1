// The border of a cell of the array. Floor 2.
#pragma once
#include "model/display.h"
#include "model/lattice.h"

#include <array>
#include <cmath>
#include <vector>

namespace lfdsim {

/// A side of a cell: it is normal to `out`, a unit vector in the array's frame.
struct CellSide {
    std::array<double, 2> out;
    double from_axis_mm, half_length_mm;
};

/// The sides of a rectangle, or of a hexagon with corners up and down, counter-clockwise from the right one. Strips have no such
/// border.
inline std::vector<CellSide> cell_sides(const LensArray& array) {
    const double x = array.pitch_mm[0] / 2, y = array.pitch_mm[1] / 2;
    if (array.lattice != LatticeKind::hexagon) return {{{1, 0}, x, y}, {{0, 1}, y, x}, {{-1, 0}, x, y}, {{0, -1}, y, x}};
    const double c = 0.5, s = std::sqrt(0.75), half = outer_radius_mm(array) / 2;
    std::vector<CellSide> all;
    for (const std::array<double, 2>& out : {std::array{1.0, 0.0}, {c, s}, {-c, s}, {-1.0, 0.0}, {-c, -s}, {c, -s}})
        all.push_back({out, x, half});
    return all;
}

}  // namespace lfdsim
