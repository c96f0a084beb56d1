// The parts that the two side views share: the scale from lengths to pixels, styles, and rays through the array. Floor 4.
#pragma once
#include "analysis/core/subject.h"
#include "optics/lattice.h"
#include "report/drawings/side_rays.h"
#include "report/plots/svg_drawing.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {

inline constexpr const char* backward_style = "stroke=\"#d55e00\" stroke-width=\"1.3\"";
inline constexpr const char* pixel_style = "stroke=\"#1f7fc0\" stroke-width=\"1.3\"";
inline constexpr const char* plane_style = "stroke=\"#1f7fc0\" stroke-dasharray=\"8 5\"";
inline constexpr const char* margin_style = "stroke=\"#1f7fc0\" stroke-opacity=\"0.7\" stroke-dasharray=\"2 4\"";
inline constexpr const char* diffuser_style = "stroke=\"#a8943a\" stroke-width=\"4\"";
inline constexpr const char* glass_style = "stroke=\"#3080a0\" fill=\"#3080a0\" fill-opacity=\"0.2\"";
inline constexpr const char* black_style = "stroke=\"currentColor\" fill=\"currentColor\"";

/// Returns a length in words, "-12.3 mm", with a true minus sign.
inline std::string mm(double x) { return fmt::format("{}{:.4g} mm", x < 0 ? "\u2212" : "", std::abs(x)); }

/// The map of millimetres to pixels: z to the right, y up.
struct SideScale {
    double left, middle;          // pixels: x of z = z0, and y of y = y0
    double z0, y0, per_z, per_y;  // mm; pixels per mm

    Point at(double y, double z) const { return {left + per_z * (z - z0), middle - per_y * (y - y0)}; }
    bool true_to_scale() const { return per_z == per_y; }
};

/// A lens of the column that is drawn.
struct SideLens {
    std::int64_t row;  // 0 at the bottom
    double y_mm;       // of its axis, in the display's frame
};
inline SideLens lens_at(const Lattice<double>& lattice, std::int64_t row) {
    return {row, lattice.offset[1] + optics::axis_in_array(lattice, optics::Cell<double>{0, double(row)}).y};
}
/// Returns the lens in whose cell a height y is, or the outermost one beside the array.
inline SideLens lens_near(const Lattice<double>& lattice, double y) {
    const double row = optics::lens_at(lattice, 0., y - lattice.offset[1]).j;
    return lens_at(lattice, std::int64_t(std::clamp(row, 0., lattice.count[1] - 1)));
}

/// Returns the path through the lens in whose cell the ray reaches the lenses; points are in the display's frame.
inline SidePath through_array(const Display& d, const Geometry& g, SideRay ray) {
    const double y = lens_near(g.lattice, ray.y_at(ray.dz > 0 ? g.base_z_mm : g.vertex_plane_mm)).y_mm;
    ray.y -= y;
    SidePath path = through_lens(d, g, ray);
    for (auto& point : path.points) point[0] += y;
    path.last.y += y;
    return path;
}

/// Draws a path and, if its ray passed the lens, the ray up to the height to_z; a ray that ended is drawn faintly.
inline void draw_path(SvgDrawing& drawing, const SideScale& scale, const SidePath& path, double to_z, std::string style) {
    std::vector<Point> points;
    for (const auto& [y, z] : path.points) points.push_back(scale.at(y, z));
    if (path.through && (to_z - path.last.z) * path.last.dz > 0) points.push_back(scale.at(path.last.y_at(to_z), to_z));
    if (!path.through) style += " stroke-opacity=\"0.4\"";
    drawing.path(points, style);
}

/// Returns the ray that comes from the eye, at a point (y, z) of the diffuser that turns it by `turn` radians.
inline SideRay scattered(const Display& d, double y, double z, double turn) {
    const Vec3d& eye = d.camera.position_mm;
    // The angle from the normal is kept below a right angle, so that the ray goes downwards.
    const double most = 1.55, angle = std::clamp(std::atan2(eye[1] - y, eye[2] - z) + turn, -most, most);
    return {y, z, -std::sin(angle), -std::cos(angle)};
}

}  // namespace lfdsim
