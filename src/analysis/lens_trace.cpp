#include "analysis/lens_trace.h"

#include "engine/scene.h"
#include "model/numbers.h"
#include "optics/sequential.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// The lens turned over: its first surface, from the panel, is then the highest.
Geometry mirrored(Geometry g) {
    std::reverse(g.surfaces.begin(), g.surfaces.end());
    for (PlacedSurface& s : g.surfaces) {
        s.z_mm = -s.z_mm;
        s.curvature_per_mm = -s.curvature_per_mm;
        for (double& a : s.even_asphere) a = -a;
        std::swap(s.index_below, s.index_above);
    }
    g.vertex_plane_mm = -g.vertex_plane_mm;
    g.stop_z_mm = -g.stop_z_mm;
    return g;
}

/// How far a ray is from getting through that misses by `excess` at one of the tests, with so many more to come.
double missed(int to_come, double excess) { return to_come + 1 + (excess >= 0 ? 1 - 1 / (1 + excess) : 1); }

}  // namespace

LensTrace::LensTrace(const Display& display, const Geometry& geometry)
    : scene_(make_scene<double>(display, mirrored(geometry))),
      rear_principal_mm_(geometry.rear_principal_mm),
      gap_mm_(geometry.gap_mm) {
    scene_.fresnel = Fresnel::none;
    for (int k = 0; k < scene_.surface_count; ++k) {
        auto& surface = scene_.surface[k];
        semi_aperture_mm_[k] = surface.semi_aperture;
        surface.semi_aperture = 1e30;  // the aperture is tested here, for a search wants to know by how much it is missed
        surface.c_rim = 1;             // a ball's half
    }
}

/// By how much, in units of the aperture, a point lies outside of it; 0 or less: inside.
double LensTrace::outside(double x, double y, double radius) const {
    double reach = std::hypot(x, y) / radius;
    if (scene_.aperture == Aperture::square)
        reach = std::max({reach, std::abs(x) / scene_.lattice.half_pitch[0], std::abs(y) / scene_.lattice.half_pitch[1]});
    return reach - 1;
}

/// Whether a ray passes the sheet of stops, by any hole.
bool LensTrace::passes_stop(double x, double y) const {
    const optics::Place<double> axis = optics::axis_of(scene_.lattice, optics::cell_at(scene_.lattice, x, y));
    const double fx = x - axis.x, fy = y - axis.y;
    return fx * fx + fy * fy <= scene_.stop_radius2;
}

// optics/ideal.h, the other way: the slope on the viewer's side is the panel's less q / f.
double LensTrace::blocked_by_ideal(Point panel, Point slope, LensRay& out) const {
    const double z = -scene_.ideal_z, x = panel[0] + slope[0] * z, y = panel[1] + slope[1] * z;
    const double radius = scene_.aperture == Aperture::circle ? scene_.aperture_radius : infinity;
    const double aperture = outside(x, y, radius), stop = scene_.has_stop ? outside(x, y, std::sqrt(scene_.stop_radius2)) : 0;
    if (!(aperture <= 0 && stop <= 0)) return missed(0, std::max(aperture, stop));
    out = {x, y, slope[0] - x * scene_.ideal_power, slope[1] - y * scene_.ideal_power};
    return 0;
}

// optics/sequential.h, for one lens and in the other direction.
double LensTrace::blocked(Point panel, Point cosines, LensRay& out) const {
    const int count = scene_.surface_count;
    const double cos2 = 1 - cosines[0] * cosines[0] - cosines[1] * cosines[1];
    if (!(cos2 > 0)) return missed(3 * count + 2, 0);
    const double cosine = std::sqrt(cos2);
    if (count == 0) return blocked_by_ideal(panel, {cosines[0] / cosine, cosines[1] / cosine}, out);

    optics::Passage<double> way{{{panel[0], panel[1], 0}, {cosines[0], cosines[1], -cosine}}, {0, 0}, 1, true};
    const bool black = scene_.surround == Surround::opaque;
    bool stop_ahead = scene_.has_stop, stopped = false;
    double astray = 0;  // by how much it missed this lens's own hole in the sheet of stops, to which a search must find
    const auto miss = [&](int to_come, double excess) { return missed(to_come, std::max(excess, astray)); };
    double vertex = 0;  // way.ray.at.z counts from the vertex
    const auto& at = way.ray.at;
    const auto& to = way.ray.to;
    const auto stand = [&](double z) {
        const double t = (z - vertex - at.z) / to.z;
        way.ray.at = {at.x + to.x * t, at.y + to.y * t, 0};
        vertex = z;
    };
    const auto pass_stop = [&](double from, double down_to, const optics::Ray<double>& ray, double ray_z) {
        if (!stop_ahead || from < scene_.stop_z || down_to > scene_.stop_z) return;
        stop_ahead = false;
        const double t = (scene_.stop_z - ray_z) / ray.to.z;
        const double x = ray.at.x + ray.to.x * t, y = ray.at.y + ray.to.y * t;
        astray = std::max(std::hypot(x, y) / std::sqrt(scene_.stop_radius2) - 1, 0.);
        stopped = !passes_stop(x, y);
    };
    if (black && scene_.dimple) {  // the way in is the hole in the black part's face
        stand(scene_.zone_top);
        if (const double excess = outside(at.x, at.y, semi_aperture_mm_[0]); excess > 0) return miss(3 * count + 1, excess);
    }
    for (int k = 0; k < count; ++k) {
        const auto& surface = scene_.surface[k];
        const double from = k == 0 ? 0 : vertex + at.z;
        stand(surface.z);
        const optics::Hit<double> hit = optics::meet(surface.shape, surface, way.ray);
        const int to_come = 3 * (count - k);  // to meet it, to be within its aperture, to get on
        if (!hit.ok) return miss(to_come, std::max(outside(at.x, at.y, semi_aperture_mm_[k]), 0.));
        const double here = vertex + hit.at.z;
        if (k > 0 && !(here <= from)) return miss(to_come, here - from);  // it meets this surface before the last
        pass_stop(from, here, way.ray, vertex);
        const double excess = outside(hit.at.x, hit.at.y, semi_aperture_mm_[k]);
        if (stopped || !(excess <= 0)) return miss(to_come - 1, excess);
        const double eta = surface.media.eta, sine2 = eta * eta * (1 - hit.cos2);
        if (!(sine2 < 1)) return miss(to_come - 2, sine2 - 1);  // total internal reflection
        optics::refract_down(scene_, surface.shape, surface, hit, way);
        if (!(to.z < 0)) return miss(to_come - 2, 1 + to.z);  // turned up
    }
    const double last = vertex + at.z;
    pass_stop(last, -infinity, way.ray, last);
    if (stopped) return miss(0, 0);
    if (black && scene_.hollow_back) {  // the way out
        const double down = (scene_.wall_bottom - last) / to.z;
        const double excess = outside(at.x + to.x * down, at.y + to.y * down, semi_aperture_mm_[count - 1]);
        if (down > 0 && !(excess <= 0)) return miss(0, excess);
    }
    stand(-rear_principal_mm_);
    out = {at.x, at.y, -to.x / to.z, -to.y / to.z};
    return 0;
}

std::optional<LensRay> LensTrace::ray(Point panel, Point cosines) const {
    LensRay ray;
    if (blocked(panel, cosines, ray) > 0) return {};
    return ray;
}

std::optional<Directions> LensTrace::directions(Point panel) const {
    if (const auto found = search(panel, {-1, 1, -1, 1})) return found;
    // Among many surfaces, stray light may have led astray: begin closer about the nodal ray.
    const double length = std::hypot(panel[0], panel[1], gap_mm_), x = -panel[0] / length, y = -panel[1] / length;
    for (const double reach : {1 / 16., 1 / 256., 1 / 4096.})
        if (const auto found = search(panel, {x - reach, x + reach, y - reach, y + reach})) return found;
    return {};
}

std::optional<Directions> LensTrace::search(Point panel, Directions box) const {
    constexpr int across = 24;
    constexpr double narrowest = 1e-10;
    while (box.x1 - box.x0 > narrowest && box.y1 - box.y0 > narrowest) {
        const double dx = (box.x1 - box.x0) / across, dy = (box.y1 - box.y0) / across;
        Directions open{infinity, -infinity, infinity, -infinity};
        double least = infinity;
        Point nearest{};
        LensRay ray;
        for (int j = 0; j < across; ++j) {
            for (int i = 0; i < across; ++i) {
                const Point d{box.x0 + (i + 0.5) * dx, box.y0 + (j + 0.5) * dy};
                const double miss = blocked(panel, d, ray);
                if (miss < least) least = miss, nearest = d;
                if (miss > 0) continue;
                open = {std::min(open.x0, d[0]), std::max(open.x1, d[0]), std::min(open.y0, d[1]), std::max(open.y1, d[1])};
            }
        }
        if (least > 0) {  // all miss: look closer about the one that comes nearest
            box = {nearest[0] - 3 * dx, nearest[0] + 3 * dx, nearest[1] - 3 * dy, nearest[1] + 3 * dy};
            continue;
        }
        const Directions last = box;
        box = {open.x0 - 2 * dx, open.x1 + 2 * dx, open.y0 - 2 * dy, open.y1 + 2 * dy};
        if (box.x1 - box.x0 > 0.6 * (last.x1 - last.x0) && box.y1 - box.y0 > 0.6 * (last.y1 - last.y0)) return box;
    }
    return {};
}

Bundle bundle(const LensTrace& lens, Point panel, int across) {
    Bundle result;
    const auto box = lens.directions(panel);
    if (!box) return result;
    const double dx = (box->x1 - box->x0) / across, dy = (box->y1 - box->y0) / across;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i)
            if (const auto ray = lens.ray(panel, {box->x0 + (i + 0.5) * dx, box->y0 + (j + 0.5) * dy})) result.rays.push_back(*ray);
    result.light = double(result.rays.size()) * dx * dy;
    return result;
}

namespace {

/// The rays of direction(s), s from low to high, that get through, with those at the very ends of what does.
template <class Direction>
std::vector<double> open_places(const LensTrace& lens, Point panel, double low, double high, int rays, Direction direction) {
    const auto open = [&](double s) { return lens.ray(panel, direction(s)).has_value(); };
    std::vector<double> places;
    double before = low;
    bool was_open = false;
    for (int i = 0; i <= rays; ++i) {
        const double s = i == rays ? high : low + (high - low) * (i + 0.5) / rays;
        const bool is_open = i < rays && open(s);
        if (is_open != was_open) {
            double in = is_open ? s : before, out = is_open ? before : s;
            for (int halved = 0; halved < 60; ++halved) {
                const double middle = 0.5 * (in + out);
                (open(middle) ? in : out) = middle;
            }
            places.push_back(in);
        }
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
    const auto range = [&](const Point& axis) {  // of the box's corners
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

Width width_at(const std::vector<Line>& lines, double z) {
    if (lines.empty()) return {0, 0};
    Line low = lines.front(), high = low;
    double lowest = infinity, highest = -infinity;
    for (const Line& l : lines) {
        const double at = l.at + l.slope * z;
        if (at < lowest) lowest = at, low = l;
        if (at > highest) highest = at, high = l;
    }
    return {highest - lowest, high.slope - low.slope};
}

double diffuser_angle(const Display& d, Point along) {
    if (!d.diffuser) return 0;
    const double turn = d.array.rotation_deg * degree, c = std::cos(turn), s = std::sin(turn);
    const double x = std::abs(c * along[0] - s * along[1]) * d.diffuser->angle_deg[0] * degree / 2,
                 y = std::abs(s * along[0] + c * along[1]) * d.diffuser->angle_deg[1] * degree / 2;
    return d.diffuser->profile == Profile::box ? x + y : std::hypot(x, y);  // a rectangle's reach; a normal distribution's width
}

std::vector<Line> diffused(const std::vector<Line>& lines, double z, double angle) {
    constexpr double most = 89 * degree;
    std::vector<Line> result;
    for (const Line& l : lines)
        for (const double turn : {-angle, angle}) {
            const double at = l.at + l.slope * z, slope = std::tan(std::clamp(std::atan(l.slope) + turn, -most, most));
            result.push_back({at - slope * z, slope});
        }
    return result;
}

}  // namespace lfdsim
