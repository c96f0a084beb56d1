// Opaque surround: light passes each surface of one lens once, in order, and everything between the lenses is black. Floor 1.
#pragma once
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

template <class F>
LFDSIM_FN Hit<F> meet(const SurfaceData<Scalar<F>>& surface, Ray<F> in_vertex_plane) {
    if (surface.shape == Shape::sphere) return meet_sphere(surface, in_vertex_plane);
    if (surface.shape != Shape::plane) return meet_asphere(surface, in_vertex_plane);
    const Vec3<F> p = in_vertex_plane.at;
    const F cosine = -in_vertex_plane.to.z, r = F(surface.semi_aperture);
    return {p, {F(0), F(0), F(1)}, cosine, cosine * cosine, p.x * p.x + p.y * p.y <= r * r};
}

/// The walls of a square cell; a circle's are its surfaces' semi apertures.
template <class F>
LFDSIM_FN Mask<F> inside_cell(const Scene<Scalar<F>>& scene, Vec3<F> at, Mask<F> ok) {
    if (scene.aperture == Aperture::circle) return ok;
    return ok && (abs(at.x) <= F(scene.half_pitch)) && (abs(at.y) <= F(scene.half_pitch));
}

/// Refracts a ray that comes down from the viewer's side (Snell's law as vectors; total internal reflection ends it).
template <class F>
LFDSIM_FN void refract_down(const Scene<Scalar<F>>& scene, const SurfaceData<Scalar<F>>& surface, const Hit<F>& hit,
                            Passage<F>& way) {
    const F eta = F(surface.media.eta);
    const F cos2 = (F(1) - eta * eta) + (eta * eta) * hit.cos2;
    const F cosine = sqrt(max(cos2, F(0)));
    way.alive = way.alive && (cos2 > F(0));
    const Vec3<F> i = way.ray.to;
    if (surface.shape == Shape::plane) {
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

/// The first surface, from a ray in the plane of its vertex, from the base lens. Most rays meet the cap of the cell they point at;
/// one that misses it and slants out of the cell before it is as low as the rims looks into the next cells.
template <class F>
LFDSIM_FN Hit<F> enter_array(const Scene<Scalar<F>>& scene, const Extent<F>& extent, Ray<F> ray, Passage<F>& way) {
    using S = Scalar<F>;
    const SurfaceData<S>& first = scene.surface[0];
    const F p = F(scene.pitch);
    const F fall = F(1) / ray.to.z;  // dx/dz = to.x fall
    auto in_cell = [&](Cell<F> cell) {
        Ray<F> local = ray;
        local.at.x = ray.at.x - cell.i * p;
        local.at.y = ray.at.y - cell.j * p;
        return local;
    };
    auto try_cell = [&](Cell<F> cell) {
        Hit<F> hit = meet(first, in_cell(cell));
        hit.ok = inside_cell(scene, hit.at, hit.ok);
        return hit;
    };
    // The cell is taken where the ray comes to the zone of the caps (the plane of the rims, if they are the highest).
    F x = ray.at.x, y = ray.at.y;
    if (scene.zone_top != first.z) {
        const F up = F(scene.zone_top - first.z) * fall;
        x = x + ray.to.x * up;
        y = y + ray.to.y * up;
    }
    way.cell = {nearest_cell(scene, x), nearest_cell(scene, y)};
    Hit<F> hit = try_cell(way.cell);
    if (scene.dimple) {  // the entrance is the rim's circle or cell
        const F lx = x - way.cell.i * p, ly = y - way.cell.j * p, r = F(first.semi_aperture);
        hit.ok = hit.ok && (lx * lx + ly * ly <= r * r);
    } else if (scene.zone_top > scene.zone_bottom) {
        // Does a ray that missed stay in its cell down to the rims?
        const F depth = F(scene.zone_top - scene.zone_bottom), mx = -(ray.to.x * fall), my = -(ray.to.y * fall);
        const F far = max(abs(x + mx * depth - way.cell.i * p), abs(y + my * depth - way.cell.j * p));
        const Mask<F> astray = way.alive && !(hit.ok) && (far > F(scene.half_pitch));
        if (any(astray)) {
            walk_cells(scene, extent, x, y, mx, my, F(0), depth, astray, [&](Cell<F> cell, Mask<F> active) {
                const Hit<F> next = try_cell(cell);
                const Mask<F> met = active && next.ok;
                hit = {{select(met, next.at.x, hit.at.x), select(met, next.at.y, hit.at.y), select(met, next.at.z, hit.at.z)},
                       {select(met, next.normal.x, hit.normal.x), select(met, next.normal.y, hit.normal.y),
                        select(met, next.normal.z, hit.normal.z)},
                       select(met, next.cos, hit.cos),
                       select(met, next.cos2, hit.cos2),
                       Mask<F>(hit.ok || met)};
                way.cell = {select(met, cell.i, way.cell.i), select(met, cell.j, way.cell.j)};
                return met;
            });
        }
    }
    way.alive = way.alive && hit.ok && extent.holds(way.cell);
    return hit;
}

/// From the plane of the first vertex to the panel. `way.ray` stands there, from the base lens.
template <class F>
LFDSIM_FN PanelHit<F> trace_opaque(const Scene<Scalar<F>>& scene, const Extent<F>& extent, const PanelBase<F>& base,
                                   Passage<F> way) {
    using S = Scalar<F>;
    // The stop is tested where the ray first crosses its plane: before the first surface or after any.
    Mask<F> stop_ahead = way.alive;
    auto stop_between = [&](F from_z, F to_z, Vec3<F> at, Vec3<F> to, F at_z) {  // z from the panel
        const Mask<F> crosses = stop_ahead && (from_z >= F(scene.stop_z)) && (to_z <= F(scene.stop_z));
        const F t = (F(scene.stop_z) - at_z) / to.z;
        const Mask<F> through = passes_stop(scene, extent, at.x + to.x * t + way.cell.i * F(scene.pitch),
                                            at.y + to.y * t + way.cell.j * F(scene.pitch));
        way.alive = way.alive && (through || !crosses);
        stop_ahead = stop_ahead && !crosses;
    };

    const Ray<F> entering = way.ray;
    Hit<F> hit = enter_array(scene, extent, way.ray, way);
    if (scene.has_stop) {
        const F shift_x = way.cell.i * F(scene.pitch), shift_y = way.cell.j * F(scene.pitch);
        stop_between(F(S(1e30)), hit.at.z + F(scene.surface[0].z), {entering.at.x - shift_x, entering.at.y - shift_y, F(0)},
                     entering.to, F(scene.surface[0].z));
    }
    refract_down(scene, scene.surface[0], hit, way);
    for (int k = 1; k < scene.surface_count; ++k) {
        const SurfaceData<S>&above = scene.surface[k - 1], &surface = scene.surface[k];
        const F t = (F(surface.z - above.z) - way.ray.at.z) / way.ray.to.z;  // to its vertex plane
        Ray<F> ray = way.ray;
        ray.at = {ray.at.x + ray.to.x * t, ray.at.y + ray.to.y * t, F(0)};
        hit = meet(surface, ray);
        hit.ok = inside_cell(scene, hit.at, hit.ok);
        if (scene.has_stop) {
            stop_between(way.ray.at.z + F(above.z), hit.at.z + F(surface.z), way.ray.at, way.ray.to, way.ray.at.z + F(above.z));
        }
        // Downwards throughout: a ray turned up, or meeting a surface behind itself, is absorbed.
        way.alive = way.alive && hit.ok && (way.ray.to.z < F(0));
        if (surface.shape != Shape::plane) way.alive = way.alive && (hit.at.z + F(surface.z) <= way.ray.at.z + F(above.z));
        refract_down(scene, surface, hit, way);
    }
    const F z = way.ray.at.z + F(scene.surface[scene.surface_count - 1].z);
    if (scene.has_stop) stop_between(z, F(0), way.ray.at, way.ray.to, z);
    way.alive = way.alive && (way.ray.to.z < F(0));
    const F t = -z / way.ray.to.z;
    if (scene.emission_exponent != S(0)) way.weight = way.weight * power(-way.ray.to.z, scene.emission_exponent);
    return panel_pixel(scene, base, way.cell, way.ray.at.x + way.ray.to.x * t, way.ray.at.y + way.ray.to.y * t, way.weight,
                       way.alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
