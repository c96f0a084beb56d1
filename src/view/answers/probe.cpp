#include "view/answers/probe.h"

#include "analysis/core/eye_rays.h"
#include "base/constants.h"
#include "base/counted.h"
#include "engine/scene/traced_display.h"
#include "geometry/geometry.h"
#include "geometry/vec.h"
#include "report/drawings/side_scale.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

namespace lfdsim::view {
namespace {

using Place = std::array<double, 2>;
using Number = std::array<std::int64_t, 2>;

constexpr int fan_rays = 5, cone_rays = 65;

/// Returns the unit direction from the camera through a point of its picture.
Vec3d direction(const optics::RayOrigin& view, Place at) {
    const double right = (at[0] - 0.5) * view.width * view.pixel_mm, up = (0.5 - at[1]) * view.height * view.pixel_mm;
    Vec3d d{};
    for (std::size_t a = 0; a < 3; ++a) d[a] = view.forward[a] * view.distance + view.right[a] * right + view.up[a] * up;
    return normalised(d);
}

/// Returns a point of the display's frame in the array's frame.
optics::Vec2<double> in_array(const Lattice<double>& lattice, double x, double y) {
    return optics::to_array(lattice, x - lattice.offset[0], y - lattice.offset[1]);
}

/// Returns the column, and the row from the top, of the lens whose axis is at a point.
Number lens_of(const Lattice<double>& lattice, const Vec3d& axis) {
    const auto at = in_array(lattice, axis[0], axis[1]);
    const auto lens = optics::lens_at(lattice, at.x, at.y);
    return {std::int64_t(lens.i), std::int64_t(lattice.count[1] - 1 - lens.j)};
}

/// Returns the pixel at a point of the panel's plane, column = floor((x + W/2)/a), row = floor((H/2 - y)/a); none beside the panel.
std::optional<Number> pixel_of(const Panel& panel, double x, double y) {
    const double column = std::floor(x / panel.pixel_pitch_mm + 0.5 * double(panel.pixels[0]));
    const double row = std::floor(0.5 * double(panel.pixels[1]) - y / panel.pixel_pitch_mm);
    if (!(column >= 0 && row >= 0 && column < double(panel.pixels[0]) && row < double(panel.pixels[1]))) return std::nullopt;
    return Number{std::int64_t(column), std::int64_t(row)};
}

/// Returns a position relative to a lens's axis in words: "1.3 mm left of and 0.2 mm above its axis", "on its axis".
std::string off_axis(double x, double y) {
    const auto far = [](double mm) { return std::abs(mm) >= 0.005; };
    const std::string across = fmt::format("{:.2f} mm {} of", std::abs(x), x < 0 ? "left" : "right");
    const std::string up = fmt::format("{:.2f} mm {}", std::abs(y), y < 0 ? "below" : "above");
    if (far(x) && far(y)) return across + " and " + up + " its axis";
    if (far(x)) return across + " its axis";
    return far(y) ? up + " its axis" : "on its axis";
}

/// Returns `count` rays down from the point where the line of sight meets the diffuser, spread over its vertical angle; without a
/// diffuser the line of sight alone.
std::vector<SideRay> turned(const Display& d, const Geometry& g, const SideRay& sight, int count) {
    if (!g.diffuser_z_mm) return {sight};
    const double z = *g.diffuser_z_mm, half = 0.5 * d.diffuser->angle_deg[1] * degree;
    std::vector<SideRay> rays;
    for (int k = 0; k < count; ++k) {
        const double turn = half * (2. * k / (count - 1) - 1);
        const double angle = std::clamp(std::atan2(-sight.dy, -sight.dz) + turn, -1.55, 1.55);  // so that the ray goes downwards
        rays.push_back({sight.y_at(z), z, -std::sin(angle), -std::cos(angle)});
    }
    return rays;
}

/// Returns, in words, the part of the panel's height that the diffuser's cone covers, and the number of rows of lenses.
std::string cone(const Display& d, const Geometry& g, const SideRay& sight) {
    if (!d.diffuser) return "";
    struct PanelSpan {
        double low, high;
    };
    std::map<std::int64_t, PanelSpan> rows;
    for (const SideRay& ray : turned(d, g, sight, cone_rays)) {
        const SidePath path = through_array(d, g, ray);
        if (!path.through) continue;
        const double y = path.last.y_at(0);
        PanelSpan& seen = rows.try_emplace(lens_near(g.lattice, ray.y_at(g.vertex_plane_mm)).row, PanelSpan{y, y}).first->second;
        seen = {std::min(seen.low, y), std::max(seen.high, y)};
    }
    double height = 0;
    for (const auto& [row, seen] : rows) height += seen.high - seen.low;
    return rows.empty() ? ""
                        : fmt::format("; with the diffuser, {:.2f} mm of the panel's height behind {} of lenses", height,
                                      counted(rows.size(), "row"));
}

std::vector<std::vector<Place>> fan(const Display& d, const Geometry& g, const SideRay& sight) {
    std::vector<std::vector<Place>> all;
    for (const SideRay& ray : turned(d, g, sight, fan_rays)) {
        const SidePath path = through_array(d, g, ray);
        std::vector<Place> line{{sight.y, sight.z}};
        line.insert(line.end(), path.points.begin() + (g.diffuser_z_mm ? 0 : 1), path.points.end());
        if (path.through) line.push_back({path.last.y_at(0), 0});
        all.push_back(std::move(line));
    }
    return all;
}

}  // namespace

Probe probe(const Display& d, Place at) {
    const Geometry g = resolve(d);
    const Vec3d to = direction(make_ray_origin(d, g), at);
    Probe probe;
    if (!(to[2] < -1e-9)) {
        probe.says = "The line of sight does not reach the display.";
        return probe;
    }
    const Vec3d& eye = d.camera.position_mm;
    const SideRay in_plane = side_ray(eye[1], eye[2], eye[1] + to[1], eye[2] + to[2]);
    probe.fan = fan(d, g, in_plane);
    const Sight sight = EyeRays(d, g).look_along(eye, to, 0, 0);
    if (!sight.through) {
        probe.says =
            "No lens transmits light of the panel here: the eye looks between two lenses, or past them. Point at another position.";
        return probe;
    }
    probe.lens = lens_of(g.lattice, sight.lens);
    probe.panel_mm = {sight.x, sight.y};
    probe.panel_pixel = pixel_of(d.panel, sight.x, sight.y);
    const std::string lens = fmt::format("Lens {}, {}", (*probe.lens)[0], (*probe.lens)[1]);
    const std::string where = off_axis(sight.x - sight.lens[0], sight.y - sight.lens[1]);
    probe.says = probe.panel_pixel ? fmt::format("{} shows panel pixel {}, {}, {}{}.", lens, (*probe.panel_pixel)[0],
                                                 (*probe.panel_pixel)[1], where, cone(d, g, in_plane))
                                   : fmt::format("{} shows a point beside the panel, {}.", lens, where);
    return probe;
}

}  // namespace lfdsim::view
