#include "interchange/meshed/cell_sides.h"

#include "geometry/resolve.h"

#include <cmath>

namespace lfdsim {

double sheet_half(const Geometry& g) {
    // The array may be rotated and moved: its diagonal and the panel's serve for any angle. atan(20) is 87.1 degrees.
    const double wide = std::hypot(g.array_width_mm, g.array_height_mm), panel = std::hypot(g.panel_width_mm, g.panel_height_mm);
    return wide / 2 + panel / 2 + std::hypot(g.lattice.offset[0], g.lattice.offset[1]) + 20 * g.top_z_mm;
}

std::array<double, 2> cell_half(const Display& display, const Geometry& g) {
    const double x = g.lattice.pitch[0] / 2;
    if (g.lattice.strips) return {x, std::ceil(sheet_half(g))};
    return {x, g.lattice.hexagonal ? outer_radius_mm(display, g) : g.lattice.pitch[1] / 2};
}

std::array<double, 2> array_half(const Display& display, const Geometry& g) {
    return {g.array_width_mm / 2, g.lattice.strips ? cell_half(display, g)[1] : g.array_height_mm / 2};
}

std::vector<CellSide> cell_sides(const Display& display, const Geometry& g) {
    const auto [x, y] = cell_half(display, g);
    if (!g.lattice.hexagonal) return {{{1, 0}, x, y}, {{0, 1}, y, x}, {{-1, 0}, x, y}, {{0, -1}, y, x}};
    const double c = 0.5, s = std::sqrt(0.75);
    std::vector<CellSide> all;
    for (const std::array<double, 2>& out : {std::array{1.0, 0.0}, {c, s}, {-c, s}, {-1.0, 0.0}, {-c, -s}, {c, -s}})
        all.push_back({out, x, y / 2});
    return all;
}

}  // namespace lfdsim
