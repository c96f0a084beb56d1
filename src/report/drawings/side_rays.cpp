#include "report/drawings/side_rays.h"

#include "engine/scene/traced_display.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"
#include "optics/lens.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// The rules of pass_lens() for a ray that is drawn: records the points of its path.
struct Pen : optics::SingleLens<double> {
    SidePath& path;
    const double sense;  // sign of z: -1 for the reversed lens, through which upward rays are traced

    void point(double y, double z) { path.points.push_back({y, sense * z}); }
    bool passes_stop(bool crosses, double x, double y) {
        const bool through = !crosses || SingleLens::passes_stop(true, x, y);
        if (!through) point(y, display.stop_z);
        return through;
    }
    void meets(int k, const optics::Ray<double>& ray, const optics::Hit<double>& hit, double from_z, double z,
               optics::Passage<double>& passage) {
        if (!passage.alive) return;
        const auto& surface = display.surface[k];
        const bool filled = display.aperture == Aperture::cell;
        const double cell = display.lattice.half_pitch[1], rim = std::min(surface.semi_aperture, filled ? cell : INFINITY);
        passage.alive = hit.ok && std::abs(hit.at.y) <= rim && z <= from_z;
        if (passage.alive) return point(hit.at.y, z);
        // A ray that passes beside the lens ends at the height of the rim.
        double sag = 0, slope;
        bool real;
        optics::sag(surface, rim * rim, sag, slope, real);
        point(ray.at.y + ray.to.y / ray.to.z * sag, surface.z + sag);
    }
    void leaves(const optics::Passage<double>&) const {}
    bool passes_back(double, double y) const {
        const auto& last = display.surface[display.surface_count - 1];
        return display.surround != Surround::opaque || std::abs(y) <= last.semi_aperture;
    }
    bool over(bool alive) const { return !alive; }
};

/// Continues a ray that has left the lens downwards through the layers; afterwards it is in the lowest one. At each face n1 dy1 =
/// n2 dy2; |dy2| >= 1 is total reflection.
void down_through_layers(const Geometry& g, SidePath& path) {
    SideRay& ray = path.last;
    if (g.layers.empty() || !path.through) return;
    double index = g.glued ? g.layers.back().index : 1, z = g.layers_top_mm;
    for (std::size_t k = g.layers.size(); k-- > 0;) {
        const PlacedLayer& layer = g.layers[k];
        ray = {ray.y_at(z), z, ray.dy * index / layer.index, 0};
        path.points.push_back({ray.y, ray.z});
        path.through = std::abs(ray.dy) < 1;
        if (!path.through) return;
        ray.dz = -std::sqrt(1 - ray.dy * ray.dy);
        index = layer.index;
        z -= layer.thickness_mm;
    }
}

/// Returns a ray from the panel after its way up through the layers, in the medium above them. Its direction is given as that in
/// air, n dy being the same in all layers.
SideRay up_through_layers(const Geometry& g, SideRay ray, SidePath& path) {
    const double sine = ray.dy;
    for (const PlacedLayer& layer : g.layers) {
        const double dy = sine / layer.index;
        ray = {ray.y, ray.z, dy, std::sqrt(1 - dy * dy)};
        ray = {ray.y_at(ray.z + layer.thickness_mm), ray.z + layer.thickness_mm, ray.dy, ray.dz};
        path.points.push_back({ray.y, ray.z});
    }
    if (!g.glued && !g.layers.empty()) ray.dy = sine, ray.dz = std::sqrt(1 - sine * sine);
    return ray;
}

}  // namespace

SideRay side_ray(double y, double z, double to_y, double to_z) {
    const double length = std::hypot(to_y - y, to_z - z);
    return {y, z, (to_y - y) / length, (to_z - z) / length};
}

SidePath through_lens(const Display& d, const Geometry& g, const SideRay& from) {
    const bool up = from.dz > 0;
    const double sense = up ? -1 : 1;
    const auto scene = make_traced_display<double>(without_errors(d), up ? turned_over(g) : g);
    SidePath path{{{from.y, from.z}}, from, true};
    const SideRay start = up ? up_through_layers(g, from, path) : from;
    const auto go_on = [&](double y, double z, double dy, double dz) { path.last = {y, sense * z, dy, sense * dz}; };
    // A lens in one plane changes the slope there.
    if (scene.ideal) {
        const double y = start.y_at(g.vertex_plane_mm);
        const double slope = optics::bend<double>(scene, {0, y}, {0, sense * start.dy / start.dz}).y, length = std::hypot(slope, 1);
        path.points.push_back({y, g.vertex_plane_mm});
        path.through = std::abs(y) <= 0.5 * g.clear_aperture_mm[1];
        go_on(y, scene.ideal_z, -slope / length, -1 / length);
        if (!up) down_through_layers(g, path);
        return path;
    }
    // Other lenses: from the vertex plane of the first surface on the ray's way, upwards through the reversed lens.
    const auto& first = scene.surface[0];
    const optics::Ray<double> ray{{0, start.y_at(sense * first.z), 0}, {0, start.dy, sense * start.dz}};
    optics::Passage<double> passage{ray, {0, 0}, 1, true};
    optics::pass_lens<optics::Specialisations::opaque>(scene, Pen{{scene}, path, sense}, ray, optics::meet(first.shape, first, ray),
                                                       passage);
    path.through = passage.alive;
    if (path.through)
        go_on(passage.ray.at.y, passage.ray.at.z + scene.surface[scene.surface_count - 1].z, passage.ray.to.y, passage.ray.to.z);
    if (!up) down_through_layers(g, path);
    return path;
}

}  // namespace lfdsim
