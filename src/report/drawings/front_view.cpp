#include "report/drawings/front_view.h"

#include "analysis/spots/aperture_wave.h"
#include "optics/lattice.h"
#include "report/drawings/side_scale.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace lfdsim {
namespace {

using Corners = ApertureShape::Corners;  // mm from a lens's axis, in the array's frame

/// Returns the corners of a cell; of strips over the length that is drawn.
Corners cell_of(Lattice<double> l, double length_mm) {
    if (l.strips) l.half_pitch[1] = 0.5 * length_mm;
    return cell_polygon(l);
}

}  // namespace

void draw_front(SvgDrawing& drawing, Point corner, double side, const Display& d, const Geometry& g) {
    const Lattice<double>& l = g.lattice;
    const double across = 2.5 * (l.strips ? l.pitch[0] : std::max(l.pitch[0], l.pitch[1])), scale = side / across;
    const optics::Cell<double> middle = optics::base_cell(l, {std::floor(l.count[0] / 2), std::floor(l.count[1] / 2)});
    const optics::Vec2<double> centre = optics::axis_in_array(l, middle);
    const Corners cell = cell_of(l, 2 * across), clear = aperture_shape(d, g).corners(2 * across);
    // Enough lenses about the middle to fill the square at any rotation.
    const auto about = [&](int axis) { return std::ceil(across / l.pitch[axis]) + 1; };
    drawing.add(fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\" viewBox=\"0 0 {2} {2}\" overflow=\"hidden\">\n",
                            px(corner[0]), px(corner[1]), px(side)));
    const double columns = about(0), rows = l.strips ? 0 : about(1);
    for (double j = -rows; j <= rows; ++j)
        for (double i = -columns; i <= columns; ++i) {
            const optics::Cell<double> lens{middle.i + i, middle.j + j};
            if (!optics::holds(l, lens)) continue;
            const optics::Vec2<double> axis = optics::axis_in_array(l, lens);
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
