#include "interchange/peers/array_frame.h"

#include "base/constants.h"

#include <cmath>

namespace lfdsim::peers {

ArrayFrame array_frame(const Display& d, const Geometry& g) {
    const auto& wedge = d.errors.wedge_deg;
    const double cx = std::cos(wedge[0] * degree), sx = std::sin(wedge[0] * degree), cy = std::cos(wedge[1] * degree),
                 sy = std::sin(wedge[1] * degree), c = g.lattice.cos_turn, s = g.lattice.sin_turn;
    const double about[3][3] = {{cy, sy * sx, sy * cx}, {0, cx, -sx}, {-sy, cy * sx, cy * cx}};
    // `about` is Ry Rx, about[row] times Rz a row of `turn`. The middle of the vertex plane, (0, 0, z_v), goes to (offset, z_v).
    ArrayFrame frame;
    for (int row = 0; row < 3; ++row) {
        const auto& [x, y, z] = about[row];
        frame.turn[row][0] = c * x + s * y;
        frame.turn[row][1] = c * y - s * x;
        frame.turn[row][2] = z;
        const double middle = row == 2 ? g.vertex_plane_mm : g.lattice.offset[row];
        frame.shift_mm[row] = middle - z * g.vertex_plane_mm;
    }
    return frame;
}

}  // namespace lfdsim::peers
