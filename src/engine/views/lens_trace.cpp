#include "engine/views/lens_trace.h"

#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"
#include "optics/lens.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Returns the distance of a ray from getting through, which fails a test by `excess` with `to_come` more tests ahead of it. It
/// lies in to_come + 1 .. to_come + 2 and rises with the excess; an excess that is negative or not a number counts as infinite.
double missed(int to_come, double excess) { return to_come + 1 + (excess >= 0 ? 1 - 1 / (1 + excess) : 1); }

}  // namespace

LensTrace::LensTrace(const Display& display, const Geometry& geometry)
    : scene_(make_traced_display<double>(without_errors(display), turned_over(geometry))),
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

/// Returns the distance of a point from the lens's aperture of this radius and from the borders of its cell, in units of the radius
/// and of the borders' distance from the axis: the larger of both; 0 or less: the point lies inside.
double LensTrace::outside(double x, double y, double radius) const {
    double reach = std::hypot(x, optics::across(scene_.lattice, y)) / radius;
    for (int pair = 0; scene_.aperture == Aperture::cell && pair < optics::border_pairs(scene_.lattice); ++pair) {
        const auto border = optics::borders(scene_.lattice, pair);
        reach = std::max(reach, std::abs(border.x * x + border.y * y) / border.half);
    }
    return reach - 1;
}

/// Moves a ray from the panel to the top of the layers. `cosines` are those in the lowest layer, and become those in air, or in the
/// top layer if the lens is glued to it: n times the cosines against x and y is the same in all plates (Snell's law). False: the
/// light stays within the layers.
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

/// Does what blocked() does for an ideal lens, whose slope (dx, dy per mm upwards) above the layers is given.
double LensTrace::blocked_by_ideal(Point panel, Point slope, LensRay& out) const {
    const double z = -scene_.ideal_z - scene_.layers_top, x = panel[0] + slope[0] * z, y = panel[1] + slope[1] * z;
    const double radius = scene_.aperture == Aperture::circle ? scene_.aperture_radius : infinity;
    const double aperture = outside(x, y, radius), stop = scene_.has_stop ? outside(x, y, std::sqrt(scene_.stop_radius2)) : 0;
    if (!(aperture <= 0 && stop <= 0)) return missed(0, std::max(aperture, stop));
    const auto beyond = optics::bend<double>(scene_, {x, y}, {-slope[0], -slope[1]});  // of the lens turned over
    out = {x, y, -beyond.x, -beyond.y};
    return 0;
}

/// The rules of pass_lens() for a search: they record by how much each ray misses where it ends.
struct LensTrace::Aim : optics::SingleLens<double> {
    const LensTrace& lens;
    const int count = display.surface_count;
    const bool black = display.surround == Surround::opaque;
    double miss = 0;       // the answer; 0: it gets through
    double astray = 0;     // by how much it misses the stop of this lens, which a search must find
    double last = 0;       // by how much it misses the way out
    bool stopped = false;  // by the sheet of stops

    void end(optics::Passage<double>& passage, int to_come, double excess) {
        if (miss == 0) miss = missed(to_come, std::max(excess, astray));
        passage.alive = false;
    }
    bool passes_stop(bool crosses, double x, double y) {
        if (!crosses) return true;
        astray = std::max(std::hypot(x, optics::across(display.lattice, y)) / std::sqrt(display.stop_radius2) - 1, 0.);
        stopped = !SingleLens::passes_stop(true, x, y);
        return true;  // it counts once the surface is reached, as a search needs the distance to that first
    }
    void meets(int k, const optics::Ray<double>& ray, const optics::Hit<double>& hit, double from_z, double z,
               optics::Passage<double>& passage) {
        const int to_come = 3 * (count - k);  // to meet it, to be within its aperture, to get on
        const double radius = lens.semi_aperture_mm_[k], excess = lens.outside(hit.at.x, hit.at.y, radius);
        const double eta = display.surface[k].media.eta, sine2 = eta * eta * (1 - hit.cos2);
        if (!(ray.to.z < 0)) return end(passage, to_come + 1, 1 + ray.to.z);  // turned up by the previous surface
        if (!hit.ok) return end(passage, to_come, std::max(lens.outside(ray.at.x, ray.at.y, radius), 0.));
        if (!(z <= from_z)) return end(passage, to_come, z - from_z);  // it meets this surface before the previous one
        if (stopped || !(excess <= 0)) return end(passage, to_come - 1, excess);
        if (!(sine2 < 1)) return end(passage, to_come - 2, sine2 - 1);  // total internal reflection
    }
    void leaves(optics::Passage<double>& passage) {
        if (!(passage.ray.to.z < 0)) return end(passage, 1, 1 + passage.ray.to.z);
        if (stopped) end(passage, 0, 0);
    }
    bool passes_back(double x, double y) {
        const double excess = black ? lens.outside(x, y, lens.semi_aperture_mm_[count - 1]) : 0;
        last = std::max(excess, astray);
        return excess <= 0;
    }
    bool over(bool alive) const { return !alive; }
};

double LensTrace::blocked(Point panel, Point cosines, LensRay& out) const {
    // The layers. Of `count` surfaces there are 3 tests each (Aim), and 2 before them.
    const int count = scene_.surface_count;
    if (!leaves_layers(panel, cosines)) return missed(3 * count + 2, 0);
    const double top = -scene_.layers_top, cos2 = 1 - cosines[0] * cosines[0] - cosines[1] * cosines[1];
    if (!(cos2 > 0)) return missed(3 * count + 2, 0);
    const double cosine = std::sqrt(cos2);
    if (count == 0) return blocked_by_ideal(panel, {cosines[0] / cosine, cosines[1] / cosine}, out);

    // The lens: in the frame of the lens turned over the ray goes down.
    optics::Passage<double> passage{{{panel[0], panel[1], 0}, {cosines[0], cosines[1], -cosine}}, {0, 0}, 1, true};
    const auto &at = passage.ray.at, &to = passage.ray.to;
    const auto place = [&](double from_z, double z) {
        const double t = (z - from_z) / to.z;
        return optics::Vec3<double>{at.x + to.x * t, at.y + to.y * t, 0};
    };
    Aim aim{{scene_}, *this};
    if (aim.black && scene_.concave_front) {  // the way in is the hole in the black part's face
        const auto hole = place(top, scene_.zone_top);
        if (const double excess = outside(hole.x, hole.y, semi_aperture_mm_[0]); excess > 0) return missed(3 * count + 1, excess);
    }
    const auto& first = scene_.surface[0];
    const optics::Ray<double> entering{place(top, first.z), to};
    optics::pass_lens<optics::Facts{}>(scene_, aim, entering, optics::meet<optics::Facts{}>(scene_, 0, entering), passage);
    if (!passage.alive) return aim.miss > 0 ? aim.miss : missed(0, aim.last);
    // The ray beyond it, at the rear principal plane
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

double LensTrace::index_below_lens() const { return scene_.surface_count > 0 ? scene_.surface[0].media.n_above : 1; }

double LensTrace::index_at_panel() const {
    return scene_.layer_count > 0 ? scene_.layer[scene_.layer_count - 1].media.n_below : index_below_lens();
}

Point LensTrace::towards(Point panel, Point at) const {
    const double index = index_below_lens(), mx = (at[0] - panel[0]) / (index * gap_mm_),
                 my = (at[1] - panel[1]) / (index * gap_mm_);
    const double share = index / (index_at_panel() * std::sqrt(1 + mx * mx + my * my));  // n sin is the same in all plates
    return {share * mx, share * my};
}

Point LensTrace::aim(Point panel, Point cosines) const {
    const double index = index_below_lens(), share = index_at_panel() / index, x = share * cosines[0], y = share * cosines[1];
    const double reach = index * gap_mm_ / std::sqrt(std::max(1 - x * x - y * y, 1e-12));
    return {panel[0] + reach * x, panel[1] + reach * y};
}

std::optional<Directions> LensTrace::directions(Point panel) const {
    if (const auto found = search(panel, {-1, 1, -1, 1})) return found;
    // With many surfaces, stray light may have misled the search: start closer to the nodal ray.
    const double length = std::hypot(panel[0], panel[1], gap_mm_), x = -panel[0] / length, y = -panel[1] / length;
    for (const double reach : {1 / 16., 1 / 256., 1 / 4096.})
        if (const auto found = search(panel, {x - reach, x + reach, y - reach, y + reach})) return found;
    return {};
}

/// Returns a rectangle about all directions that get through and lie near `box`, as directions() does. A grid of rays is traced,
/// then one within a smaller rectangle: about the ray that comes nearest while all miss, else about those that get through, with
/// two steps of the grid to spare, until the rectangle no longer shrinks to 0.6 of its size.
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

}  // namespace lfdsim
