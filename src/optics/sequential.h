// Opaque surround: a ray enters one lens of the array, passes its surfaces in order, and everything between the lenses is black.
// Floor 1.
#pragma once
#include "optics/elementary.h"
#include "optics/one_lens.h"
#include "optics/panel.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

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

/// What pass_lens() asks of a lens that stands in an array: apertures and cells as masks of a packet's rays.
template <class F>
struct InArray {
    const Scene<Scalar<F>>& scene;
    const Extent<Scalar<F>>& extent;
    const Cell<F> cell;

    LFDSIM_FN Place<F> axis() const { return axis_of(scene.lattice, cell); }
    LFDSIM_FN void meets(int k, const Ray<F>&, const Hit<F>& hit, F, F, Passage<F>& way) const {
        if (k > 0) way.alive = way.alive && inside_cell(scene, hit.at, hit.ok);  // enter_array() has seen to the first
    }
    LFDSIM_FN Mask<F> passes_stop(Mask<F>, F x, F y) const { return optics::passes_stop(scene, extent, x, y); }
    LFDSIM_FN void leaves(const Passage<F>&) const {}
    LFDSIM_FN Mask<F> passes_back(F x, F y) const {
        const F r = F(scene.surface[scene.surface_count - 1].semi_aperture);
        return inside_cell(scene, Vec3<F>{x, y, F(0)}, x * x + y * y <= r * r);
    }
    LFDSIM_FN bool over(Mask<F>) const { return false; }
};

/// From the plane of the first vertex to the panel. `way.ray` stands there, from the base lens.
template <Shapes shapes, class F>
LFDSIM_FN PanelPoint<F> trace_opaque(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent,
                                     const PanelBase<Scalar<F>>& base, Passage<F> way) {
    using S = Scalar<F>;
    const int count = shapes == Shapes::plano_convex ? 2 : scene.surface_count;
    const Ray<F> entering = way.ray;
    const Hit<F> hit = enter_array<shapes>(scene, extent, entering, way);
    pass_lens<shapes>(scene, InArray<F>{scene, extent, way.cell}, entering, hit, way);
    const F t = -(way.ray.at.z + F(scene.surface[count - 1].z)) / way.ray.to.z;
    if (scene.emission_exponent != S(0)) way.weight = way.weight * power(-way.ray.to.z, scene.emission_exponent);
    return panel_point(scene, base, way.cell, way.ray.at.x + way.ray.to.x * t, way.ray.at.y + way.ray.to.y * t, way.weight,
                       way.alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
