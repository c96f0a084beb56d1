// Opaque surround (docs/model.md, "Lens array and surround"): a ray enters one lens of the array and passes its surfaces in order;
// everything between the lenses is black. Floor 1.
//
// Rays go backward, down from the viewer's side (+z) to the panel (z = 0). Positions are in mm in the array's frame; `ray` and
// `way` hold them from the base lens's axis until the ray has met a lens, and from that lens's axis afterwards.
#pragma once
#include "optics/layers.h"
#include "optics/lens.h"
#include "optics/panel.h"
#include "simd/elementary.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Where a ray in the vertex plane of the first surfaces, x and y from the base lens's axis, meets the first surface of the lens in
/// `cell`. The hit is relative to the axis of that lens.
template <Facts facts, class F>
LFDSIM_FN Hit<F> meet_first(const Scene<Scalar<F>>& scene, Ray<F> ray, Cell<F> cell) {
    const Place<F> axis = axis_of(lattice_of<facts>(scene), cell);
    ray.at.x = ray.at.x - axis.x;
    ray.at.y = ray.at.y - axis.y;
    Hit<F> hit = meet<facts>(scene, 0, ray);
    hit.ok = inside_cell<facts>(scene, hit.at, hit.ok);
    return hit;
}

/// Whether no lens but those of its first and its last cell is on a way from (x, y) to (x + ex, y + ey).
template <class F>
LFDSIM_FN Mask<F> passes_two_cells(const Scene<Scalar<F>>& scene, Cell<F> first, Cell<F> last, F x, F y, F ex, F ey) {
    using S = Scalar<F>;
    const Lattice<S>& lattice = scene.lattice;
    // Across one border. (A line between neighbours in a comb may cut a third cell, but not its lens.)
    if (!lattice.staggered) return abs(last.i - first.i) + abs(last.j - first.j) <= F(S(1.5));
    if (!lattice.hexagonal) return F(0) > F(1);
    // The axes of neighbours are a pitch apart, and those of the two lenses beside both stand sqrt(3)/2 pitches off the line
    // through them: farther from the way than the lenses are wide, where neither of its ends is far off that line.
    const S pitch = lattice.pitch[0], far = S(0.866) * pitch - scene.surface[0].semi_aperture;
    const Place<F> from = axis_of(lattice, first), to = axis_of(lattice, last);
    const F dx = to.x - from.x, dy = to.y - from.y, ax = x - from.x, ay = y - from.y;
    const F start = ax * dy - ay * dx, end = start + (ex * dy - ey * dx);
    return (dx * dx + dy * dy <= F(S(1.1) * pitch * pitch)) && (max(abs(start), abs(end)) <= F(pitch * far));
}

/// The rays of `astray` miss the cap of the cell they point at: finds the cap of another cell, if any, that they meet before they
/// are down at the rims, and writes hit and cell of those that do. (x, y): where they enter the zone of the caps, zone_bottom <= z
/// <= zone_top, from the base lens's axis; m = -d(x, y)/dz, the lateral displacement per mm of descent.
template <Facts facts, class F>
LFDSIM_RARE void meet_neighbours(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F x, F y, F mx,
                                 F my, Mask<F> astray, Hit<F>& hit, Cell<F>& cell) {
    assume<facts>(scene);
    const Cell<F> own = cell;
    auto try_cell = [&](Cell<F> here, Mask<F> active) {
        active = active && !((here.i == own.i) && (here.j == own.j));
        if (none(active)) return active;
        const Hit<F> next = meet_first<facts>(scene, ray, here);
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
    if (none(astray && !passes_two_cells(scene, cell, last, x, y, mx * depth, my * depth))) {
        try_cell(last, astray && extent.holds(last));
        return;
    }
    walk_cells(scene, extent, x, y, mx, my, F(0), depth, astray, try_cell);
}

/// Which rays may meet another lens on their way from (x, y) to (x + ex, y + ey), where they are down at the rims, seen from above?
/// Each starts in `cell`, whose lens it misses; r is the semi-aperture. None that ends in its own cell can. A ray that passes
/// within r of another axis and ends outside of that lens has passed the foot of the perpendicular from the axis, at most r away,
/// and from there it moves less than |(ex, ey)|: it ends at most sqrt(r^2 + ex^2 + ey^2) from that axis.
template <class F>
LFDSIM_FN Mask<F> may_meet_neighbours(const Lattice<Scalar<F>>& lattice, Cell<F> cell, F x, F y, F ex, F ey, F r) {
    const Place<F> axis = axis_of(lattice, cell);
    if (lattice.strips) {  // across them alone; such a ray ends from r on this side of the axis to ex beyond it
        const F ux = abs(x - axis.x + ex), px = F(lattice.pitch[0]), ax = px - ux;
        return (ux > F(lattice.half_pitch[0])) && ((ax * ax <= r * r + ex * ex) || (ux > px));
    }
    const F ux = abs(x - axis.x + ex), uy = abs(y - axis.y + ey), px = F(lattice.pitch[0]), py = F(lattice.pitch[1]);
    const Mask<F> out_x = ux > F(lattice.half_pitch[0]), out_y = uy > F(lattice.half_pitch[1]);
    if (LaneTraits<F>::width == 1 && !lattice.staggered && none(out_x || out_y)) return out_x;  // most single rays end here
    const F reach2 = r * r + (ex * ex + ey * ey);
    if (lattice.staggered) {
        // Of the neighbours in its row, in the next one and in the one after that; beyond them any may be near.
        const F ax = ux - px, bx = ux - F(lattice.half_pitch[0]), by = uy - py, cy = by - py;
        F nearest = min(ax * ax + uy * uy, bx * bx + by * by);
        if (!lattice.hexagonal) nearest = min(nearest, ux * ux + cy * cy);  // low bricks
        return !in_cell(lattice, ux, uy) && ((nearest <= reach2) || (ux > px) || (uy > py));
    }
    // Of the neighbour across the one border that it crosses; where it crosses more, any may be near.
    const F ax = min(ux, px - ux), ay = min(uy, py - uy);
    const Mask<F> near = (ax * ax + ay * ay <= reach2) || (out_x && out_y) || (ux > px) || (uy > py);
    return (out_x || out_y) && near;
}

/// Whether a way from one cell to the point (x, y) may pass cells with lenses.
template <class F>
LFDSIM_FN Mask<F> may_enter(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, Cell<F> from, F x, F y) {
    const Cell<F> to = cell_at(scene.lattice, x, y);
    const F beside = F(scene.lattice.staggered ? 1 : 0);  // as far as a way between staggered cells may lead aside
    return (min(from.i, to.i) <= F(extent.high_i) + beside) && (max(from.i, to.i) >= F(extent.low_i) - beside) &&
           (min(from.j, to.j) <= F(extent.high_j) + beside) && (max(from.j, to.j) >= F(extent.low_j) - beside);
}

/// Finds the lens through which a ray enters the array (way.cell) and where it meets that lens's first surface. `ray` starts in the
/// vertex plane of the first surfaces; the hit is relative to the axis of the lens found. Most rays meet the cap of the cell they
/// point at; a ray that misses it and leaves the cell before it is down at the rims is tested against the next cells.
template <Facts facts, class F>
LFDSIM_FN Hit<F> enter_array(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray, Passage<F>& way) {
    const auto& first = scene.surface[0];
    const F fall = inverse(ray.to.z);  // dx/dz = to.x fall
    // The cell is that at the point where the ray enters the zone of the caps (the plane of the rims, if they are the highest).
    F x = ray.at.x, y = ray.at.y;
    if (facts.plano_convex != Known::yes && scene.zone_top != first.z) {
        const F up = F(scene.zone_top - first.z) * fall;
        x = x + ray.to.x * up;
        y = y + ray.to.y * up;
    }
    way.cell = cell_at(lattice_of<facts>(scene), x, y);
    Hit<F> hit = meet_first<facts>(scene, ray, way.cell);
    hit.ok = both(hit.ok, extent.holds(way.cell));
    if (facts.plano_convex != Known::yes && scene.dimple) {  // the entrance is the rim's circle or cell
        const Place<F> axis = axis_of(scene.lattice, way.cell);
        const F lx = x - axis.x, ly = across(scene.lattice, y - axis.y), r = F(first.semi_aperture);
        hit.ok = hit.ok && (lx * lx + ly * ly <= r * r);
    } else if (facts.plano_convex == Known::yes || scene.zone_top > scene.zone_bottom) {
        const F kd = F(scene.zone_bottom - scene.zone_top) * fall;
        Mask<F> astray = both(way.alive, !hit.ok);
        if (LaneTraits<F>::width > 1 || any(astray)) {
            astray = both(astray, may_meet_neighbours(lattice_of<facts>(scene), way.cell, x, y, ray.to.x * kd, ray.to.y * kd,
                                                      F(first.semi_aperture)));
            if (any(astray)) astray = both(astray, may_enter(scene, extent, way.cell, x + ray.to.x * kd, y + ray.to.y * kd));
            if (any(astray)) {
                Hit<F> found = hit;
                Cell<F> cell = way.cell;
                const Ray<F> from = ray;
                meet_neighbours<facts>(scene, extent, from, x, y, -(ray.to.x * fall), -(ray.to.y * fall), astray, found, cell);
                hit = found;
                hit.ok = both(found.ok, way.alive);  // else it would be kept in memory
                way.cell = cell;
            }
        }
    }
    way.alive = both(way.alive, hit.ok);
    return hit;
}

/// The rules of pass_lens() for a lens in an array: apertures and cells, as masks over a packet's rays.
template <Facts facts, class F>
struct InArray {
    const Scene<Scalar<F>>& scene;
    const Extent<Scalar<F>>& extent;
    const Cell<F> cell;

    LFDSIM_FN Place<F> axis() const { return axis_of(lattice_of<facts>(scene), cell); }
    LFDSIM_FN void meets(int k, const Ray<F>&, const Hit<F>& hit, F, F, Passage<F>& way) const {
        if (k > 0) way.alive = way.alive && inside_cell<facts>(scene, hit.at, hit.ok);  // enter_array() has tested the first
    }
    LFDSIM_FN Mask<F> passes_stop(Mask<F>, F x, F y) const { return optics::passes_stop(scene, extent, x, y); }
    LFDSIM_FN void leaves(const Passage<F>&) const {}
    LFDSIM_FN Mask<F> passes_back(F x, F y) const {
        const F r = F(scene.surface[scene.surface_count - 1].semi_aperture);
        const F z = F(0), from_middle = across(scene.lattice, y);
        return inside_cell<facts>(scene, Vec3<F>{x, y, z}, x * x + from_middle * from_middle <= r * r);
    }
    LFDSIM_FN bool over(Mask<F>) const { return false; }
};

/// From the vertex plane of the first surfaces, in which way.ray starts (from the base lens's axis), through one lens to the panel.
/// The radiance is multiplied by cos^m of the ray's angle at the panel, m the emission exponent.
template <Facts facts, class F>
LFDSIM_FN PanelPoint<F> trace_opaque(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent,
                                     const PanelBase<Scalar<F>>& base, Passage<F> way) {
    using S = Scalar<F>;
    const int count = facts.plano_convex == Known::yes ? 2 : scene.surface_count;
    const Ray<F> entering = way.ray;
    const Hit<F> hit = enter_array<facts>(scene, extent, entering, way);
    assume<facts>(scene);
    pass_lens<facts>(scene, InArray<facts, F>{scene, extent, way.cell}, entering, hit, way);
    const Vec3<F> leaves{way.ray.at.x, way.ray.at.y, way.ray.at.z + F(scene.surface[count - 1].z)};
    Place<F> end;
    if constexpr (facts.on_air == Known::yes) {
        const F t = quotient(-leaves.z, way.ray.to.z);
        end = {leaves.x + way.ray.to.x * t, leaves.y + way.ray.to.y * t};
    } else {
        const Mask<F> glued = F(scene.glued ? 1 : 0) > F(0);
        end = down_to_panel(scene, leaves, glued, way.ray.to, way.weight, way.alive);
    }
    if (facts.plain_light != Known::yes && scene.emission_exponent != S(0))
        way.weight = way.weight * power(-way.ray.to.z, scene.emission_exponent);
    return panel_point<facts.plain_light == Known::yes>(scene, lattice_of<facts>(scene), base, way.cell, end.x, end.y, way.weight,
                                                        way.alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
