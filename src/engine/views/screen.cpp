#include "engine/views/screen.h"

#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "geometry/camera.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace lfdsim {

namespace {

/// The positions at which the camera sees points in front of it, pixels from its picture's upper left corner.
class CameraPoints {
  public:
    CameraPoints(const Display& display, const Geometry& geometry)
        : position_(display.camera.position_mm), axes_(camera_axes(display.camera)), view_(make_ray_origin(display, geometry)) {}
    /// Returns where the camera sees a point of the display's frame, mm; nothing if it is not in front of the camera.
    std::optional<std::array<double, 2>> of(const Vec3d& point) const {
        const Vec3d to = minus(point, position_);
        const double depth = dot(to, axes_.forward);
        if (depth <= 1e-9 * view_.distance) return {};
        const double pixels = view_.distance / depth / view_.pixel_mm;  // in the frame, of a millimetre at this depth
        return std::array{0.5 * view_.width + dot(to, axes_.right) * pixels, 0.5 * view_.height - dot(to, axes_.up) * pixels};
    }

  private:
    Vec3d position_;
    CameraAxes axes_;
    optics::RayOrigin view_;
};

using Polygon = std::vector<Point>;

/// A half of a plane: its points p have normal . p <= most.
struct HalfPlane {
    Point normal;
    double most;
    double beyond(const Point& p) const { return normal[0] * p[0] + normal[1] * p[1] - most; }
};

/// Returns a rectangle about the origin, from its top left corner on, clockwise.
Polygon rectangle(double half_width, double half_height) {
    return {{-half_width, half_height}, {half_width, half_height}, {half_width, -half_height}, {-half_width, -half_height}};
}

/// Returns the array's rectangle on the vertex plane, mm in the display's frame, from its top left corner on, clockwise. Quarter
/// turns of the array exchange width and height, so that the corner called top left is at the top left.
Polygon array_outline(const Geometry& g) {
    const double quarters = std::round(g.turn_deg / 90), rest = g.turn_deg - 90 * quarters;
    const double c = std::cos(rest * degree), s = std::sin(rest * degree);
    double half_width = g.array_width_mm / 2, half_height = g.array_height_mm / 2;
    if (std::fmod(quarters, 2) != 0) std::swap(half_width, half_height);
    Polygon outline = rectangle(half_width, half_height);
    for (Point& p : outline) p = {c * p[0] - s * p[1] + g.lattice.offset[0], s * p[0] + c * p[1] + g.lattice.offset[1]};
    return outline;
}

/// Returns the sides of the panel over which the array reaches by more than half a lens, as the camera sees them on the vertex
/// plane: a point P of the panel is seen there at P + z_v/z_c (C - P), C the camera's position over the panel and z_c its height.
std::vector<HalfPlane> panel_sides(const Geometry& g, const Vec3d& camera, const Polygon& array) {
    const Lattice<double>& l = g.lattice;
    const double on = g.vertex_plane_mm / camera[2];  // how much of the way from the panel to the camera
    std::vector<HalfPlane> sides;
    for (const std::size_t axis : {0u, 1u})
        for (const double sign : {-1., 1.}) {
            const double half_panel = 0.5 * (axis == 0 ? g.panel_width_mm : g.panel_height_mm);
            const double along_x = std::abs(axis == 0 ? l.cos_turn : l.sin_turn),
                         along_y = std::abs(axis == 0 ? l.sin_turn : l.cos_turn);
            const double half_lens = along_x * l.half_pitch[0] + (l.strips ? 0 : along_y * l.half_pitch[1]);
            const HalfPlane far{axis == 0 ? Point{sign, 0} : Point{0, sign}, half_panel + half_lens};
            if (std::ranges::all_of(array, [&](const Point& p) { return far.beyond(p) <= 1e-9 * half_panel; })) continue;
            sides.push_back({far.normal, half_panel + on * (sign * camera[axis] - half_panel)});
        }
    return sides;
}

/// Returns the point of the line through a and b at which the line through c and d meets it.
Point meeting(const Point& a, const Point& b, const Point& c, const Point& d) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1];
    const double t = ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / (ux * vy - uy * vx);
    return {a[0] + t * ux, a[1] + t * uy};
}

/// Returns the part of a convex polygon within a half plane.
Polygon cut(const Polygon& from, const HalfPlane& side) {
    Polygon to;
    for (std::size_t k = 0; k < from.size(); ++k) {
        const Point &a = from[k], &b = from[(k + 1) % from.size()];
        const double beyond_a = side.beyond(a), beyond_b = side.beyond(b);
        if (beyond_a <= 0) to.push_back(a);
        if ((beyond_a <= 0) == (beyond_b <= 0)) continue;
        const double t = beyond_a / (beyond_a - beyond_b);
        to.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
    return to;
}

/// Returns a polygon without its short edges, as long as it has more than four: the edges before and after each are extended until
/// they meet.
Polygon without_short_edges(Polygon p) {
    constexpr double part = 0.02;  // of the outline
    const auto length = [&](std::size_t k) {
        const Point &a = p[k], &b = p[(k + 1) % p.size()];
        return std::hypot(b[0] - a[0], b[1] - a[1]);
    };
    double outline = 0;
    for (std::size_t k = 0; k < p.size(); ++k) outline += length(k);
    while (p.size() > 4) {
        std::size_t least = 0;
        for (std::size_t k = 1; k < p.size(); ++k)
            if (length(k) < length(least)) least = k;
        if (!(length(least) < part * outline)) break;
        const std::size_t n = p.size(), next = (least + 1) % n;
        p[least] = meeting(p[(least + n - 1) % n], p[least], p[next], p[(next + 1) % n]);
        p.erase(p.begin() + std::ptrdiff_t(next));
    }
    return p;
}

/// Rotates the order of a polygon's corners so that the one farthest up and left comes first.
void begin_top_left(Polygon& p) {
    const auto [left, right] = std::ranges::minmax(p, {}, [](const Point& at) { return at[0]; });
    const auto [low, high] = std::ranges::minmax(p, {}, [](const Point& at) { return at[1]; });
    const double width = right[0] - left[0], height = high[1] - low[1];
    const auto first = std::ranges::max_element(p, {}, [&](const Point& at) { return at[1] / height - at[0] / width; });
    std::rotate(p.begin(), first, p.end());
}

/// Returns where the camera sees the four corners of an outline at a height; nothing if one is not in front of the camera.
std::optional<Corners> seen_corners(const Display& display, const Geometry& geometry, const Polygon& outline, double z_mm) {
    const CameraPoints camera(display, geometry);
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto at = camera.of({outline[k][0], outline[k][1], z_mm});
        if (!at) return {};
        corners[k] = *at;
    }
    return corners;
}

}  // namespace

ScreenCorners screen_corners(const Display& display, const Geometry& geometry) {
    constexpr const char* behind = "its camera does not have the whole screen in front of it";
    Polygon outline = array_outline(geometry);
    if (!(display.camera.position_mm[2] > geometry.vertex_plane_mm)) return {{}, behind};
    if (const std::vector<HalfPlane> sides = panel_sides(geometry, display.camera.position_mm, outline); !sides.empty()) {
        for (const HalfPlane& side : sides) outline = cut(outline, side);
        outline = without_short_edges(std::move(outline));
        if (outline.size() != 4)
            return {{},
                    outline.size() < 3
                        ? "no part of its lens array is in front of the panel"
                        : fmt::format("the part of its lens array in front of the panel has {} corners", outline.size())};
        begin_top_left(outline);
    }
    const std::optional<Corners> corners = seen_corners(display, geometry, outline, geometry.vertex_plane_mm);
    return {corners, corners ? "" : behind};
}

std::optional<Region> screen_region(const Display& display, const Geometry& geometry) {
    const auto array = seen_corners(display, geometry, array_outline(geometry), geometry.vertex_plane_mm);
    const Polygon whole = rectangle(geometry.panel_width_mm / 2, geometry.panel_height_mm / 2);
    const auto panel = seen_corners(display, geometry, whole, 0);
    if (!array || !panel) return {};
    const int width = int(display.camera.resolution[0]), height = int(display.camera.resolution[1]);
    return Region::polygon(*array, width, height).intersected(Region::polygon(*panel, width, height));
}

}  // namespace lfdsim
