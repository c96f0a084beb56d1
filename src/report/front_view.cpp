#include "report/front_view.h"

#include "analysis/aperture_wave.h"
#include "model/numbers.h"
#include "optics/lattice.h"
#include "report/side_scale.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lfdsim {
namespace {

using Corners = std::vector<std::array<double, 2>>;  // mm from a lens's axis, in the array's frame

Corners box(double half_x, double half_y) { return {{half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}, {half_x, -half_y}}; }

/// Of that inradius, corners up and down.
Corners hexagon(double half) {
    const double corner = half * 2 / std::numbers::sqrt3;
    return {{half, corner / 2}, {0, corner}, {-half, corner / 2}, {-half, -corner / 2}, {0, -corner}, {half, -corner / 2}};
}

/// `reach`: half the length of strips that is drawn.
Corners cell_of(const Lattice<double>& l, double reach) {
    if (l.hexagonal) return hexagon(l.half_pitch[0]);
    return box(l.half_pitch[0], l.strips ? reach : l.half_pitch[1]);
}

Corners clear_part(const ApertureShape& aperture, double reach) {
    const double half_x = 0.5 * aperture.width_mm[0];
    Corners disk;
    switch (aperture.form) {
        case ApertureShape::Form::slit:
            return box(half_x, reach);
        case ApertureShape::Form::rectangle:
            return box(half_x, 0.5 * aperture.width_mm[1]);
        case ApertureShape::Form::hexagon:
            return hexagon(half_x);
        case ApertureShape::Form::disk:
            break;
    }
    for (int k = 0; k < 60; ++k) disk.push_back({half_x * std::cos(pi * k / 30), half_x * std::sin(pi * k / 30)});
    return disk;
}

}  // namespace

void draw_front(Drawing& drawing, Point corner, double side, const Display& d, const Geometry& g) {
    const Lattice<double>& l = g.lattice;
    const double across = 2.5 * (l.strips ? l.pitch[0] : std::max(l.pitch[0], l.pitch[1])), scale = side / across;
    const optics::Cell<double> middle = optics::base_cell(l, {std::floor(l.count[0] / 2), std::floor(l.count[1] / 2)});
    const optics::Place<double> centre = optics::axis_in_array(l, middle);
    const Corners cell = cell_of(l, across), clear = clear_part(aperture_shape(d, g), across);
    // As many about the middle as reach into the square, however it is turned
    const auto about = [&](int axis) { return std::ceil(across / l.pitch[axis]) + 1; };
    drawing.add(fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\" viewBox=\"0 0 {2} {2}\" overflow=\"hidden\">\n",
                            px(corner[0]), px(corner[1]), px(side)));
    const double columns = about(0), rows = l.strips ? 0 : about(1);
    for (double j = -rows; j <= rows; ++j)
        for (double i = -columns; i <= columns; ++i) {
            const optics::Cell<double> lens{middle.i + i, middle.j + j};
            if (!optics::holds(l, lens)) continue;
            const optics::Place<double> axis = optics::axis_in_array(l, lens);
            const auto draw = [&](const Corners& corners, const std::string& style) {
                std::vector<Point> points;
                for (const auto& [x, y] : corners) {
                    const auto at = optics::to_display(l, axis.x - centre.x + x, axis.y - centre.y + y);
                    points.push_back({0.5 * side + scale * at.x, 0.5 * side - scale * at.y});
                }
                drawing.path(points, style, true);
            };
            const bool here = i == 0 && j == 0;
            draw(clear, here ? "stroke=\"none\" fill=\"#3080a0\" fill-opacity=\"0.5\""
                             : "stroke=\"none\" fill=\"#3080a0\" fill-opacity=\"0.2\"");
            draw(cell, here ? "stroke-width=\"1.6\"" : "stroke-opacity=\"0.4\"");
        }
    drawing.add("</svg>\n");
}

}  // namespace lfdsim
