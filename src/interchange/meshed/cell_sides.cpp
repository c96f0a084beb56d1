#include "interchange/meshed/cell_sides.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

double sheet_half(const Geometry& g) {
    // The array may be rotated and moved: its diagonal and the panel's serve for any angle. atan(20) is 87.1 degrees.
    const double wide = std::hypot(g.array_width_mm, g.array_height_mm), panel = std::hypot(g.panel_width_mm, g.panel_height_mm);
    return wide / 2 + panel / 2 + std::hypot(g.lattice.offset[0], g.lattice.offset[1]) + 20 * g.top_z_mm;
}

optics::CellCorners<double> cell_corners(const Geometry& g) {
    Lattice<double> finite = g.lattice;
    if (finite.strips) finite.half_pitch[1] = std::ceil(sheet_half(g));
    return optics::corners_of_cell(finite);
}

std::array<double, 2> cell_half(const Geometry& g) {
    const auto cell = cell_corners(g);
    return {*std::max_element(cell.x, cell.x + cell.count), *std::max_element(cell.y, cell.y + cell.count)};
}

std::array<double, 2> array_half(const Geometry& g) {
    return {g.array_width_mm / 2, g.lattice.strips ? cell_half(g)[1] : g.array_height_mm / 2};
}

std::vector<CellSide> cell_sides(const Geometry& g) {
    const auto cell = cell_corners(g);
    std::vector<CellSide> all;
    for (int k = 0; k < cell.count; ++k) {
        const int next = (k + 1) % cell.count;
        const double ex = cell.x[next] - cell.x[k], ey = cell.y[next] - cell.y[k], length = std::hypot(ex, ey);
        const std::array<double, 2> out{ey / length, 0 - ex / length};
        all.push_back({out, out[0] * cell.x[k] + out[1] * cell.y[k], length / 2});
    }
    return all;
}

}  // namespace lfdsim
