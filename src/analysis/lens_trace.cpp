#include "analysis/lens_trace.h"

#include "engine/scene.h"
#include "model/numbers.h"
#include "model/prescription.h"
#include "optics/one_lens.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// How far a ray that fails a test by `excess` is from getting through, with so many more tests to come.
double missed(int to_come, double excess) { return to_come + 1 + (excess >= 0 ? 1 - 1 / (1 + excess) : 1); }

}  // namespace

LensTrace::LensTrace(const Display& display, const Geometry& geometry)
    : scene_(make_scene<double>(display, turned_over(geometry))),
      rear_principal_mm_(geometry.rear_principal_mm),
      gap_mm_(geometry.gap_mm) {
    scene_.fresnel = Fresnel::none;
    for (int k = 0; k < scene_.surface_count; ++k) {
        auto& surface = scene_.surface[k];
        semi_aperture_mm_[k] = surface.semi_aperture;
        surface.semi_aperture = 1e30;  // the aperture is tested here, as a search needs to know by how much it is missed
        surface.c_rim = 1;             // half a ball
    }
}

/// By how much, in units of the aperture, a point lies outside of it; 0 or less: inside.
double LensTrace::outside(double x, double y, double radius) const {
    double reach = std::hypot(x, optics::across(scene_.lattice, y)) / radius;
    for (int pair = 0; scene_.aperture == Aperture::cell && pair < optics::border_pairs(scene_.lattice); ++pair) {
        const auto border = optics::borders(scene_.lattice, pair);
        reach = std::max(reach, std::abs(border.x * x + border.y * y) / border.half);
    }
    return reach - 1;
}

/// Through the layers on the panel, whose directions are those in the lowest one. At their top: in air, or in what the lens is
/// glued to. False: the light stays within them.
bool LensTrace::leaves_layers(Point& at, Point& cosines) const {
    double index = 1;
    for (int k = scene_.layer_count; k-- > 0;) {  // from the panel upwards
        const auto& layer = scene_.layer[k];
        const double share = k == scene_.layer_count - 1 ? 1 : index / layer.media.n_below;
        index = layer.media.n_below;
        cosines = {share * cosines[0], share * cosines[1]};
        const double cos2 = 1 - cosines[0] * cosines[0] - cosines[1] * cosines[1];
        if (!(cos2 > 0)) return false;
        const double per_height = layer.thickness / std::sqrt(cos2);
        at = {at[0] + per_height * cosines[0], at[1] + per_height * cosines[1]};
    }
    if (!scene_.glued) cosines = {index * cosines[0], index * cosines[1]};
    return true;
}

double LensTrace::blocked_by_ideal(Point panel, Point slope, LensRay& out) const {
    const double z = -scene_.ideal_z - scene_.layers_top, x = panel[0] + slope[0] * z, y = panel[1] + slope[1] * z;
    const double radius = scene_.aperture == Aperture::circle ? scene_.aperture_radius : infinity;
    const double aperture = outside(x, y, radius), stop = scene_.has_stop ? outside(x, y, std::sqrt(scene_.stop_radius2)) : 0;
    if (!(aperture <= 0 && stop <= 0)) return missed(0, std::max(aperture, stop));
    const auto beyond = optics::bend<double>(scene_, {x, y}, {-slope[0], -slope[1]});  // of the lens turned over
    out = {x, y, -beyond.x, -beyond.y};
    return 0;
}

/// What pass_lens() calls for a search: records by how much each ray misses where it ends.
struct LensTrace::Aim : optics::Alone<double> {
    const LensTrace& lens;
    const int count = scene.surface_count;
    const bool black = scene.surround == Surround::opaque;
    double miss = 0;       // the answer; 0: it gets through
    double astray = 0;     // by how much it misses this lens's own stop, which a search must find
    double last = 0;       // by how much it misses the way out
    bool stopped = false;  // by the sheet of stops

    void end(optics::Passage<double>& way, int to_come, double excess) {
        if (miss == 0) miss = missed(to_come, std::max(excess, astray));
        way.alive = false;
    }
    bool passes_stop(bool crosses, double x, double y) {
        if (!crosses) return true;
        astray = std::max(std::hypot(x, optics::across(scene.lattice, y)) / std::sqrt(scene.stop_radius2) - 1, 0.);
        stopped = !Alone::passes_stop(true, x, y);
        return true;  // it counts once the surface is reached, as a search needs the distance to that first
    }
    void meets(int k, const optics::Ray<double>& ray, const optics::Hit<double>& hit, double from_z, double z,
               optics::Passage<double>& way) {
        const int to_come = 3 * (count - k);  // to meet it, to be within its aperture, to get on
        const double radius = lens.semi_aperture_mm_[k], excess = lens.outside(hit.at.x, hit.at.y, radius);
        const double eta = scene.surface[k].media.eta, sine2 = eta * eta * (1 - hit.cos2);
        if (!(ray.to.z < 0)) return end(way, to_come + 1, 1 + ray.to.z);  // turned up by the previous surface
        if (!hit.ok) return end(way, to_come, std::max(lens.outside(ray.at.x, ray.at.y, radius), 0.));
        if (!(z <= from_z)) return end(way, to_come, z - from_z);  // it meets this surface before the previous one
        if (stopped || !(excess <= 0)) return end(way, to_come - 1, excess);
        if (!(sine2 < 1)) return end(way, to_come - 2, sine2 - 1);  // total internal reflection
    }
    void leaves(optics::Passage<double>& way) {
        if (!(way.ray.to.z < 0)) return end(way, 1, 1 + way.ray.to.z);
        if (stopped) end(way, 0, 0);
    }
    bool passes_back(double x, double y) {
        const double excess = black ? lens.outside(x, y, lens.semi_aperture_mm_[count - 1]) : 0;
        last = std::max(excess, astray);
        return excess <= 0;
    }
    bool over(bool alive) const { return !alive; }
};

double LensTrace::blocked(Point panel, Point cosines, LensRay& out) const {
    const int count = scene_.surface_count;
    if (!leaves_layers(panel, cosines)) return missed(3 * count + 2, 0);
    const double top = -scene_.layers_top, cos2 = 1 - cosines[0] * cosines[0] - cosines[1] * cosines[1];
    if (!(cos2 > 0)) return missed(3 * count + 2, 0);
    const double cosine = std::sqrt(cos2);
    if (count == 0) return blocked_by_ideal(panel, {cosines[0] / cosine, cosines[1] / cosine}, out);

    optics::Passage<double> way{{{panel[0], panel[1], 0}, {cosines[0], cosines[1], -cosine}}, {0, 0}, 1, true};
    const auto &at = way.ray.at, &to = way.ray.to;
    const auto place = [&](double from_z, double z) {
        const double t = (z - from_z) / to.z;
        return optics::Vec3<double>{at.x + to.x * t, at.y + to.y * t, 0};
    };
    Aim aim{{scene_}, *this};
    if (aim.black && scene_.dimple) {  // the way in is the hole in the black part's face
        const auto hole = place(top, scene_.zone_top);
        if (const double excess = outside(hole.x, hole.y, semi_aperture_mm_[0]); excess > 0) return missed(3 * count + 1, excess);
    }
    const auto& first = scene_.surface[0];
    const optics::Ray<double> entering{place(top, first.z), to};
    optics::pass_lens<optics::Shapes::all>(scene_, aim, entering, optics::meet<optics::Shapes::all>(scene_, 0, entering), way);
    if (!way.alive) return aim.miss > 0 ? aim.miss : missed(0, aim.last);
    const auto principal = place(at.z + scene_.surface[count - 1].z, -rear_principal_mm_);
    out = {principal.x, principal.y, -to.x / to.z, -to.y / to.z};
    return 0;
}

std::optional<LensRay> LensTrace::ray(Point panel, Point cosines) const {
    LensRay ray;
    if (blocked(panel, cosines, ray) > 0) return {};
    if (scene_.lattice.strips) ray.y = ray.my = 0;  // their foci are lines along y
    return ray;
}

std::optional<Directions> LensTrace::directions(Point panel) const {
    if (const auto found = search(panel, {-1, 1, -1, 1})) return found;
    // With many surfaces, stray light may have misled the search: start closer to the nodal ray.
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
        if (least > 0) {  // all miss: search closer about the one that comes nearest
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

/// The rays of direction(s), s from low to high, that get through, with those at the very ends of each open range.
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
    const double turn = d.array.turn_deg() * degree, c = std::cos(turn), s = std::sin(turn);
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
