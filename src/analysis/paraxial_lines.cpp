#include "analysis/paraxial_lines.h"

#include "model/numbers.h"
#include "optics/elementary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {

ParaxialLines::ParaxialLines(const Display& d, const Geometry& g, const Vec3d& eye)
    : display_(d), geometry_(g), eye_(eye), aperture_(aperture_shape(d, g)) {
    if (d.diffuser) above_ = *g.diffuser_z_mm - g.rear_principal_mm;
    if (std::isfinite(g.focal_length_mm)) power_ = g.gap_mm / g.focal_length_mm;
}

double ParaxialLines::angle(double number, std::size_t axis) const {
    const double full = display_.diffuser->angle_deg[axis] * degree, sigma = full / (2 * std::sqrt(2 * std::numbers::ln2));
    return display_.diffuser->profile == Profile::box ? 0.5 * full * number : sigma * std::numbers::sqrt2 * optics::erfinv(number);
}

std::optional<ParaxialLine> ParaxialLines::look(double x, double y, double a, double b) const {
    const Lattice<double>& l = geometry_.lattice;
    const double away = eye_[2] - geometry_.rear_principal_mm;
    const std::array<double, 2> slope{(eye_[0] - x) / away, (eye_[1] - y) / away};  // dx/dz, dy/dz, as those below
    std::array<double, 2> turned = slope;
    if (display_.diffuser) {  // about y, then about x, as of the direction down (-slope, -1)
        const double alpha = angle(a, 0), beta = angle(b, 1);
        const double to_x = -std::cos(alpha) * slope[0] - std::sin(alpha), level = std::sin(alpha) * slope[0] - std::cos(alpha),
                     to_y = -std::cos(beta) * slope[1] - std::sin(beta) * level,
                     to_z = -std::sin(beta) * slope[1] + std::cos(beta) * level;
        if (!(to_z < -1e-3)) return {};
        turned = {to_x / to_z, to_y / to_z};
    }
    const auto at =
        optics::to_array(l, x + above_ * (slope[0] - turned[0]) - l.offset[0], y + above_ * (slope[1] - turned[1]) - l.offset[1]);
    const optics::Cell<double> lens = optics::lens_at(l, at.x, at.y);
    if (!optics::holds(l, lens)) return {};
    const auto down = optics::to_array(l, turned[0], turned[1]);
    const optics::Place<double> axis = optics::axis_in_array(l, lens);
    const double qx = at.x - axis.x, qy = l.strips ? 0 : at.y - axis.y;
    const double along =
        l.strips ? geometry_.reduced_vertex_plane_mm + geometry_.rear_principal_mm - geometry_.vertex_plane_mm : geometry_.gap_mm;
    return ParaxialLine{
        axis, {at.x - geometry_.gap_mm * down.x - power_ * qx, at.y - along * down.y - power_ * qy}, aperture_.holds(qx, qy)};
}

bool ParaxialLines::on_panel(const optics::Place<double>& place) const {
    const auto at = optics::in_display(geometry_.lattice, place);
    return 2 * std::abs(at.x) <= geometry_.panel_width_mm && 2 * std::abs(at.y) <= geometry_.panel_height_mm;
}

}  // namespace lfdsim
