#include "analysis/crosstalk/paraxial_lines.h"

#include "base/constants.h"
#include "geometry/diffuser_profile.h"
#include "geometry/layers.h"
#include "optics/diffuser.h"
#include "simd/elementary.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

ParaxialLines::ParaxialLines(const Display& d, const Geometry& g, const Vec3d& eye)
    : display_(d), geometry_(g), eye_(eye), aperture_(aperture_shape(d, g)) {
    if (d.diffuser) above_ = *g.diffuser_z_mm - g.rear_principal_mm;
    if (std::isfinite(g.focal_length_mm)) power_per_mm_ = 1 / g.focal_length_mm;
}

double ParaxialLines::angle(double number, std::size_t axis) const {
    const Diffuser& diffuser = *display_.diffuser;
    const double scale = figures_of(diffuser.profile).scale * diffuser.angle_deg[axis] * degree;
    return optics::scattering_angle(diffuser.profile, scale, number, 1.);
}

std::optional<ParaxialLines::LineSlopes> ParaxialLines::slopes(double x, double y, double a, double b) const {
    const double away = eye_[2] - geometry_.rear_principal_mm;
    const std::array<double, 2> slope{(eye_[0] - x) / away, (eye_[1] - y) / away};  // dx/dz, dy/dz, as those below
    if (!display_.diffuser) return LineSlopes{slope, slope};
    // About y, then about x, as of the direction down (-slope, -1)
    const double alpha = angle(a, 0), beta = angle(b, 1);
    const double to_x = -std::cos(alpha) * slope[0] - std::sin(alpha), level = std::sin(alpha) * slope[0] - std::cos(alpha),
                 to_y = -std::cos(beta) * slope[1] - std::sin(beta) * level,
                 to_z = -std::sin(beta) * slope[1] + std::cos(beta) * level;
    if (!(to_z < -1e-3)) return {};
    return LineSlopes{slope, {to_x / to_z, to_y / to_z}};
}

std::optional<optics::Vec2<double>> ParaxialLines::aim_at(double x, double y, double a, double b) const {
    const auto there = slopes(x, y, a, b);
    if (!there) return {};
    return optics::Vec2<double>{x - above_ * (there->before[0] - there->turned[0]),
                                y - above_ * (there->before[1] - there->turned[1])};
}

std::optional<ParaxialLine> ParaxialLines::look(double x, double y, double a, double b) const {
    const Lattice<double>& l = geometry_.lattice;
    const auto found = slopes(x, y, a, b);
    if (!found) return {};
    const auto& [slope, turned] = *found;
    const auto at =
        optics::to_array(l, x + above_ * (slope[0] - turned[0]) - l.offset[0], y + above_ * (slope[1] - turned[1]) - l.offset[1]);
    const optics::Cell<double> lens = optics::lens_at(l, at.x, at.y);
    if (!optics::holds(l, lens)) return {};
    const optics::Vec2<double> down = optics::to_array(l, turned[0], turned[1]);
    const optics::Vec2<double> axis = optics::axis_in_array(l, lens);
    const double qx = at.x - axis.x, qy = l.strips ? 0 : at.y - axis.y;
    const optics::Vec2<double> bent{down.x + power_per_mm_ * qx, down.y + power_per_mm_ * qy};
    const auto reach = reach_mm(bent.x * bent.x + bent.y * bent.y);
    return ParaxialLine{axis, at, down, {at.x - reach.x * bent.x, at.y - reach.y * bent.y}, aperture_.holds(qx, qy)};
}

optics::Vec2<double> ParaxialLines::reach_mm(double slope_squared) const {
    const Geometry& g = geometry_;
    if (display_.lens.is_thin()) {
        const double reach = reach_below_thin_lens_mm(g, slope_squared);
        return {reach, reach};
    }
    return {g.gap_mm, g.lattice.strips ? g.reduced_vertex_plane_mm + g.rear_principal_mm - g.vertex_plane_mm : g.gap_mm};
}

bool ParaxialLines::on_panel(const optics::Vec2<double>& place) const {
    const auto at = optics::in_display(geometry_.lattice, place);
    return 2 * std::abs(at.x) <= geometry_.panel_width_mm && 2 * std::abs(at.y) <= geometry_.panel_height_mm;
}

}  // namespace lfdsim
