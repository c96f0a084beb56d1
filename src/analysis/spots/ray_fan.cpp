#include "analysis/spots/ray_fan.h"

#include "base/bisection.h"
#include "base/constants.h"
#include "geometry/diffuser_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim {

Bundle bundle(const LensTrace& lens, Point panel, int across) {
    Bundle result;
    const auto box = lens.directions(panel);
    if (!box) return result;
    const double dx = (box->x1 - box->x0) / across, dy = (box->y1 - box->y0) / across;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i)
            if (const auto ray = lens.ray(panel, {box->x0 + (i + 0.5) * dx, box->y0 + (j + 0.5) * dy})) result.rays.push_back(*ray);
    result.light = double(result.rays.size()) * dx * dy;
    // The light is that of all directions; rays of strips are those of the plane across them, which are as many: steep light along
    // the strips may make the box many times wider than what gets through in that plane.
    if (!lens.of_strips()) return result;
    result.rays.clear();
    const int in_plane = across * across;
    for (int i = 0; i < in_plane; ++i)
        if (const auto ray = lens.ray(panel, {box->x0 + (i + 0.5) * (box->x1 - box->x0) / in_plane, 0}))
            result.rays.push_back(*ray);
    return result;
}

namespace {

/// Returns the parameters s, from low to high, of rays in the directions direction(s) that get through, with the ends of each
/// open range, found by bisection.
template <class Direction>
std::vector<double> open_places(const LensTrace& lens, Point panel, double low, double high, int rays, Direction direction) {
    const auto open = [&](double s) { return lens.ray(panel, direction(s)).has_value(); };
    std::vector<double> places;
    double before = low;
    bool was_open = false;
    for (int i = 0; i <= rays; ++i) {
        const double s = i == rays ? high : low + (high - low) * (i + 0.5) / rays;
        const bool is_open = i < rays && open(s);
        if (is_open != was_open) places.push_back((is_open ? bisected(s, before, 60, open) : bisected(before, s, 60, open)).in);
        if (is_open) places.push_back(s);
        was_open = is_open;
        before = s;
    }
    return places;
}

}  // namespace

Fans fans(const LensTrace& lens, Point panel, int rays) {
    Fans result;
    const auto box = lens.directions(panel);
    if (!box) return result;
    const double height = std::hypot(panel[0], panel[1]);
    const Point u = height > 0 ? Point{panel[0] / height, panel[1] / height} : Point{1, 0}, v{-u[1], u[0]};
    // Returns the extent of the box of directions along an axis.
    const auto range = [&](const Point& axis) {
        const double x0 = axis[0] * box->x0, x1 = axis[0] * box->x1, y0 = axis[1] * box->y0, y1 = axis[1] * box->y1;
        return std::array{std::max(std::min(x0, x1) + std::min(y0, y1), -1.), std::min(std::max(x0, x1) + std::max(y0, y1), 1.)};
    };
    const auto along = [&](double s) { return Point{s * u[0], s * u[1]}; };
    const auto [low, high] = range(u);
    const std::vector<double> meridional = open_places(lens, panel, low, high, rays, along);
    if (meridional.empty()) return result;
    for (const double s : meridional) {
        const auto ray = lens.ray(panel, along(s));
        result.meridional.push_back({ray->x * u[0] + ray->y * u[1], ray->mx * u[0] + ray->my * u[1]});
    }
    // The sagittal plane contains the middle ray: cosines s across and c sqrt(1 - s^2) along u have a constant slope along u.
    const double middle = 0.5 * (meridional.front() + meridional.back());
    const auto across = [&](double s) {
        const double rest = middle * std::sqrt(std::max(1 - s * s, 0.));
        return Point{rest * u[0] + s * v[0], rest * u[1] + s * v[1]};
    };
    const auto [left, right] = range(v);
    for (const double s : open_places(lens, panel, left, right, rays, across)) {
        const auto ray = lens.ray(panel, across(s));
        result.sagittal.push_back({ray->x * v[0] + ray->y * v[1], ray->mx * v[0] + ray->my * v[1]});
    }
    return result;
}

FanWidth width_at(const std::vector<FanRay>& lines, double z) {
    if (lines.empty()) return {0, 0};
    // The greatest of straight lines is convex in z and the least concave, so that their difference is convex.
    FanRay low = lines.front(), high = low;
    double lowest = infinity, highest = -infinity;
    for (const FanRay& l : lines) {
        const double at = l.at + l.slope * z;
        if (at < lowest) lowest = at, low = l;
        if (at > highest) highest = at, high = l;
    }
    return {highest - lowest, high.slope - low.slope};
}

double diffuser_angle(const Display& d, const Geometry& g, Point along) {
    if (!d.diffuser) return 0;
    const double c = g.lattice.cos_turn, s = g.lattice.sin_turn;
    const double x = std::abs(c * along[0] - s * along[1]) * d.diffuser->angle_deg[0] * degree / 2,
                 y = std::abs(s * along[0] + c * along[1]) * d.diffuser->angle_deg[1] * degree / 2;
    return figures_of(d.diffuser->profile).rectangular ? x + y : std::hypot(x, y);
}

std::vector<FanRay> diffused(const std::vector<FanRay>& lines, double z, double angle) {
    constexpr double most = 89 * degree;
    std::vector<FanRay> result;
    for (const FanRay& l : lines)
        for (const double turn : {-angle, angle}) {
            const double at = l.at + l.slope * z, slope = std::tan(std::clamp(std::atan(l.slope) + turn, -most, most));
            result.push_back({at - slope * z, slope});
        }
    return result;
}

}  // namespace lfdsim
