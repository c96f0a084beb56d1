#include "geometry/screen.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

std::array<double, 2> screen_size_mm(const Geometry& g) {
    const double c = g.lattice.cos_turn, s = g.lattice.sin_turn;
    const auto [x, y] = g.lattice.offset;
    const std::array<double, 2> array{g.array_width_mm, g.array_height_mm},
        panel{g.panel_width_mm * std::abs(c) + g.panel_height_mm * std::abs(s),
              g.panel_width_mm * std::abs(s) + g.panel_height_mm * std::abs(c)},
        moved{c * x + s * y, c * y - s * x};  // the array's middle from the panel's
    std::array<double, 2> size{};
    for (std::size_t k = 0; k < 2; ++k) {
        if (k == 1 && g.lattice.strips) {  // they have no ends
            size[k] = panel[k];
            continue;
        }
        const double low = std::max(moved[k] - 0.5 * array[k], -0.5 * panel[k]),
                     high = std::min(moved[k] + 0.5 * array[k], 0.5 * panel[k]);
        size[k] = std::max(high - low, 0.);
    }
    return size;
}

double lenses_across(const Geometry& g, std::size_t axis) {
    return std::min(g.lattice.count[axis], std::max(std::ceil(screen_size_mm(g)[axis] / g.lattice.pitch[axis] - 1e-9), 1.));
}

}  // namespace lfdsim
