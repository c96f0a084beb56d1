// Opaque surround: light passes each surface of one lens once, in order, and everything between the lenses is black. Floor 1.
#pragma once
#include "optics/elementary.h"
#include "optics/lens_array.h"
#include "optics/panel.h"
#include "optics/scene.h"
#include "optics/surface.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A bundle of rays on its way through the array.
template <class F>
struct Passage {
    Ray<F> ray;  // from the lens's axis and the surface's vertex
    Cell<F> cell;
    F weight;
    Mask<F> alive;
};

/// Which surfaces a display's lens has, as far as the kernel is compiled for it: the 2019 paper's lens without a stop pays for no
/// other. Triangles in place of the surfaces are met by meet_mesh(scene, k, ray), which whoever has them gives (src/meshed).
enum class Shapes { plano_convex, any, meshed };

/// Surface k, counted from the viewer's side.
template <Shapes shapes, class S>
LFDSIM_FN Shape shape_of(const Scene<S>& scene, int k) {
    if (shapes == Shapes::plano_convex) return k == 0 ? Shape::sphere : Shape::plane;
    return scene.surface[k].shape;
}

template <class F>
LFDSIM_FN Hit<F> meet(Shape shape, const SurfaceData<Scalar<F>>& surface, Ray<F> in_vertex_plane) {
    if (shape == Shape::plane) {
        const Vec3<F> p = in_vertex_plane.at;
        const F cosine = -in_vertex_plane.to.z, r = F(surface.semi_aperture);
        return {p, {F(0), F(0), F(1)}, cosine, cosine * cosine, p.x * p.x + p.y * p.y <= r * r};
    }
    return shape == Shape::sphere ? meet_sphere(surface, in_vertex_plane) : meet_asphere(surface, in_vertex_plane);
}

/// Surface k.
template <Shapes shapes, class F>
LFDSIM_FN Hit<F> meet(const Scene<Scalar<F>>& scene, int k, Ray<F> in_vertex_plane) {
    if constexpr (shapes == Shapes::meshed)
        return meet_mesh(scene, k, in_vertex_plane);
    else
        return meet(shape_of<shapes>(scene, k), scene.surface[k], in_vertex_plane);
}

/// The walls of a square cell; a circle's are its surfaces' semi apertures.
template <class F>
LFDSIM_FN Mask<F> inside_cell(const Scene<Scalar<F>>& scene, Vec3<F> at, Mask<F> ok) {
    if (scene.aperture == Aperture::circle) return ok;
    return ok && in_cell(scene.lattice, at.x, at.y);
}

/// Refracts a ray that comes down from the viewer's side (Snell's law as vectors; total internal reflection ends it).
template <class F>
LFDSIM_FN void refract_down(const Scene<Scalar<F>>& scene, Shape shape, const SurfaceData<Scalar<F>>& surface, const Hit<F>& hit,
                            Passage<F>& way) {
    const F eta = F(surface.media.eta);
    const F cos2 = (F(1) - eta * eta) + (eta * eta) * hit.cos2;
    const F cosine = sqrt(max(cos2, F(0)));
    way.alive = way.alive && (cos2 > F(0));
    const Vec3<F> i = way.ray.to;
    if (shape == Shape::plane) {
        way.ray.to = {eta * i.x, eta * i.y, -cosine};
    } else {
        const F m = eta * hit.cos - cosine;
        way.ray.to = {eta * i.x + m * hit.normal.x, eta * i.y + m * hit.normal.y, eta * i.z + m * hit.normal.z};
    }
    way.ray.at = hit.at;
    if (scene.fresnel != Fresnel::none) {
        way.weight = way.weight * transmittance(scene.fresnel, F(surface.media.schlick_t0), F(surface.media.n_above),
                                                F(surface.media.n_below), hit.cos, cosine,
                                                surface.media.n_above < surface.media.n_below ? hit.cos : cosine);
    }
}

/// The first surface of the lens in `cell`, met by a ray in the plane of its vertex.
template <Shapes shapes, class F>
LFDSIM_FN Hit<F> meet_first(const Scene<Scalar<F>>& scene, Ray<F> ray, Cell<F> cell) {
    const Place<F> axis = axis_of(scene.lattice, cell);
    ray.at.x = ray.at.x - axis.x;
    ray.at.y = ray.at.y - axis.y;
    Hit<F> hit = meet<shapes>(scene, 0, ray);
    hit.ok = inside_cell(scene, hit.at, hit.ok);
    return hit;
}

/// Looks for the cap that rays astray meet before they are as low as the rims: (x, y) in the zone's top plane, m = -d(x, y)/dz.
template <Shapes shapes, class F>
LFDSIM_RARE void meet_neighbours(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F x, F y, F mx,
                                 F my, Mask<F> astray, Hit<F>& hit, Cell<F>& cell) {
    auto try_cell = [&](Cell<F> here, Mask<F> active) {
        const Hit<F> next = meet_first<shapes>(scene, ray, here);
        const Mask<F> met = active && next.ok;
        auto choose = [&](F a, F b) { return select(met, a, b); };
        hit = {{choose(next.at.x, hit.at.x), choose(next.at.y, hit.at.y), choose(next.at.z, hit.at.z)},
               {choose(next.normal.x, hit.normal.x), choose(next.normal.y, hit.normal.y), choose(next.normal.z, hit.normal.z)},
               choose(next.cos, hit.cos),
               choose(next.cos2, hit.cos2),
               hit.ok || met};
        cell = {choose(here.i, cell.i), choose(here.j, cell.j)};
        return met;
    };
    const F depth = F(scene.zone_top - scene.zone_bottom);
    const Cell<F> last = cell_at(scene.lattice, x + mx * depth, y + my * depth);
    const F steps = abs(last.i - cell.i) + abs(last.j - cell.j);
    if (none(astray && (steps > F(Scalar<F>(1.5))))) {  // one border on the way: the last cell is the only other one
        try_cell(last, astray && extent.holds(last));
        return;
    }
    walk_cells(scene, extent, x, y, mx, my, F(0), depth, astray, try_cell);
}

/// The first surface on the way down, from a ray in the plane of its vertex. Places are in the array's frame, x and y from the base
/// lens's axis. Most rays meet the cap of the cell they point at; one that misses it and slants out of the cell before it is as low
/// as the rims looks into the next cells.
template <Shapes shapes, class F>
LFDSIM_FN Hit<F> enter_array(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray, Passage<F>& way) {
    const auto& first = scene.surface[0];
    const F fall = F(1) / ray.to.z;  // dx/dz = to.x fall
    // The cell is taken where the ray comes to the zone of the caps (the plane of the rims, if they are the highest).
    F x = ray.at.x, y = ray.at.y;
    if (shapes != Shapes::plano_convex && scene.zone_top != first.z) {
        const F up = F(scene.zone_top - first.z) * fall;
        x = x + ray.to.x * up;
        y = y + ray.to.y * up;
    }
    way.cell = cell_at(scene.lattice, x, y);
    Hit<F> hit = meet_first<shapes>(scene, ray, way.cell);
    if (shapes != Shapes::plano_convex && scene.dimple) {  // the entrance is the rim's circle or cell
        const Place<F> axis = axis_of(scene.lattice, way.cell);
        const F lx = x - axis.x, ly = y - axis.y, r = F(first.semi_aperture);
        hit.ok = hit.ok && (lx * lx + ly * ly <= r * r);
    } else if (shapes == Shapes::plano_convex || scene.zone_top > scene.zone_bottom) {
        // Can a ray that missed meet another lens before it is down at the rims? Seen from above its way there is the vector (ex,
        // ey). Not if it ends in the same cell. Nor if it crosses one border, ends at (ax, ay) from the nearer axis and that is
        // far: it came from farther than the semi aperture r, so if it passed within r of the axis the foot of the perpendicular
        // lies on its way, and it ends within the hypotenuse sqrt(r^2 + ex^2 + ey^2). All others are looked after one by one.
        const F kd = F(scene.zone_bottom - scene.zone_top) * fall, ex = ray.to.x * kd, ey = ray.to.y * kd;
        const Place<F> axis = axis_of(scene.lattice, way.cell);
        const F ux = abs(x - axis.x + ex), uy = abs(y - axis.y + ey), r = F(first.semi_aperture);
        const F px = F(scene.lattice.pitch[0]), py = F(scene.lattice.pitch[1]);
        const Mask<F> out_x = ux > F(scene.lattice.half_pitch[0]), out_y = uy > F(scene.lattice.half_pitch[1]);
        const F ax = min(ux, px - ux), ay = min(uy, py - uy);
        const Mask<F> near = (ax * ax + ay * ay <= r * r + (ex * ex + ey * ey)) || (out_x && out_y) || (ux > px) || (uy > py);
        const Mask<F> astray = way.alive && !hit.ok && (out_x || out_y) && near;
        if (any(astray)) {
            Hit<F> found = hit;
            Cell<F> cell = way.cell;
            const Ray<F> from = ray;
            meet_neighbours<shapes>(scene, extent, from, x, y, -(ray.to.x * fall), -(ray.to.y * fall), astray, found, cell);
            hit = found;
            way.cell = cell;
        }
    }
    way.alive = way.alive && hit.ok && extent.holds(way.cell);
    return hit;
}

/// From the plane of the first vertex to the panel. `way.ray` stands there, from the base lens.
template <Shapes shapes, class F>
LFDSIM_FN PanelPoint<F> trace_opaque(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent,
                                     const PanelBase<Scalar<F>>& base, Passage<F> way) {
    using S = Scalar<F>;
    // The stop is tested where the ray first crosses its plane: before the first surface or after any.
    Mask<F> stop_ahead = way.alive;
    auto stop_between = [&](F from_z, F to_z, Vec3<F> at, Vec3<F> to, F at_z) {  // z from the panel
        const Mask<F> crosses = stop_ahead && (from_z >= F(scene.stop_z)) && (to_z <= F(scene.stop_z));
        const F t = (F(scene.stop_z) - at_z) / to.z;
        const Place<F> axis = axis_of(scene.lattice, way.cell);
        const Mask<F> through = passes_stop(scene, extent, at.x + to.x * t + axis.x, at.y + to.y * t + axis.y);
        way.alive = way.alive && (through || !crosses);
        stop_ahead = stop_ahead && !crosses;
    };

    const int count = shapes == Shapes::plano_convex ? 2 : scene.surface_count;
    const bool has_stop = shapes != Shapes::plano_convex && scene.has_stop;
    const Ray<F> entering = way.ray;
    Hit<F> hit = enter_array<shapes>(scene, extent, entering, way);
    if (has_stop) {
        const Place<F> axis = axis_of(scene.lattice, way.cell);
        stop_between(F(S(1e30)), hit.at.z + F(scene.surface[0].z), {entering.at.x - axis.x, entering.at.y - axis.y, F(0)},
                     entering.to, F(scene.surface[0].z));
    }
    refract_down(scene, shape_of<shapes>(scene, 0), scene.surface[0], hit, way);
    for (int k = 1; k < count; ++k) {
        const SurfaceData<S>&above = scene.surface[k - 1], &surface = scene.surface[k];
        const F t = (F(surface.z - above.z) - way.ray.at.z) / way.ray.to.z;  // to its vertex plane
        Ray<F> ray = way.ray;
        ray.at = {ray.at.x + ray.to.x * t, ray.at.y + ray.to.y * t, F(0)};
        hit = meet<shapes>(scene, k, ray);
        hit.ok = inside_cell(scene, hit.at, hit.ok);
        if (has_stop) {
            stop_between(way.ray.at.z + F(above.z), hit.at.z + F(surface.z), way.ray.at, way.ray.to, way.ray.at.z + F(above.z));
        }
        // Downwards throughout: a ray turned up, or meeting a surface behind itself, is absorbed.
        way.alive = way.alive && hit.ok && (way.ray.to.z < F(0));
        if (shape_of<shapes>(scene, k) != Shape::plane)
            way.alive = way.alive && (hit.at.z + F(surface.z) <= way.ray.at.z + F(above.z));
        refract_down(scene, shape_of<shapes>(scene, k), surface, hit, way);
    }
    const F z = way.ray.at.z + F(scene.surface[count - 1].z);
    if (has_stop) stop_between(z, F(0), way.ray.at, way.ray.to, z);
    if (shape_of<shapes>(scene, count - 1) != Shape::plane) way.alive = way.alive && (way.ray.to.z < F(0));
    if (shapes != Shapes::plano_convex && scene.hollow_back) {  // the way out is the hole in the black part's lower face
        const F down = (F(scene.wall_bottom) - z) / way.ray.to.z, r = F(scene.surface[count - 1].semi_aperture);
        const F x = way.ray.at.x + way.ray.to.x * down, y = way.ray.at.y + way.ray.to.y * down;
        way.alive = way.alive && (inside_cell(scene, Vec3<F>{x, y, F(0)}, x * x + y * y <= r * r) || (down < F(0)));
    }
    const F t = -z / way.ray.to.z;
    if (scene.emission_exponent != S(0)) way.weight = way.weight * power(-way.ray.to.z, scene.emission_exponent);
    return panel_point(scene, base, way.cell, way.ray.at.x + way.ray.to.x * t, way.ray.at.y + way.ray.to.y * t, way.weight,
                       way.alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
