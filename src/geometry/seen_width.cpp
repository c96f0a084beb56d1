#include "geometry/seen_width.h"

#include "base/bisection.h"
#include "base/constants.h"
#include "geometry/diffuser_profile.h"

#include <cmath>

namespace lfdsim {

std::size_t array_axis(const Geometry& g, std::size_t k) {
    const bool on_side = std::abs(g.lattice.cos_turn) < std::abs(g.lattice.sin_turn);
    return g.lattice.strips ? 0 : on_side ? 1 - k : k;
}

double seen_through_lens_mm(const Geometry& g, double eye_mm) {
    const double power = std::isfinite(g.focal_length_mm) ? g.gap_mm / g.focal_length_mm : 0;
    return g.clear_aperture_mm[axis_of_eyes(g)] * std::abs(1 + g.gap_mm / eye_mm - power);
}

double even_width_of(Profile profile) {
    const ProfileFigures& figures = figures_of(profile);
    const auto inside = [&](double place) { return figures.below(place) < 0.5 + 0.5 * middle_share; };
    return 2 * bisected(0, figures.width, 40, inside).in / middle_share;
}

double seen_by_diffuser_mm(const Geometry& g, double eye_mm, Profile profile, double angle_deg, double above_mm) {
    return even_width_of(profile) * 2 * g.gap_mm * std::tan(angle_deg * degree / 2) * std::abs(1 - above_mm / eye_mm);
}

}  // namespace lfdsim
