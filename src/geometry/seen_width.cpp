#include "geometry/seen_width.h"

#include "base/constants.h"

#include <cmath>

namespace lfdsim {

std::size_t axis_of_eyes(const Geometry& g) {
    return !g.lattice.strips && std::abs(g.lattice.cos_turn) < std::abs(g.lattice.sin_turn) ? 1 : 0;
}

double seen_through_lens_mm(const Geometry& g, double eye_mm) {
    const double power = std::isfinite(g.focal_length_mm) ? g.gap_mm / g.focal_length_mm : 0;
    return g.clear_aperture_mm[axis_of_eyes(g)] * std::abs(1 + g.gap_mm / eye_mm - power);
}

double seen_by_diffuser_mm(const Geometry& g, double eye_mm, double angle_deg, double above_mm) {
    return 2 * g.gap_mm * std::tan(angle_deg * degree / 2) * std::abs(1 - above_mm / eye_mm);
}

}  // namespace lfdsim
