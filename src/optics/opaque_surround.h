// Opaque surround (docs/model.md, "Lens array and surround"): a ray enters one lens of the array and passes its surfaces in order;
// everything between the lenses is black. Floor 1.
//
// Rays go backward, down from the viewer's side (+z) to the panel (z = 0). Positions are in mm in the array's frame; `ray` and
// `passage` hold them from the base lens's axis until the ray has met a lens, and from that lens's axis afterwards.
#pragma once
#include "optics/layers.h"
#include "optics/lens.h"
#include "optics/panel.h"
#include "simd/elementary.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Returns where a ray in the vertex plane of the first surfaces, x and y from the base lens's axis, meets the first surface of the
/// lens in `cell`. The hit is relative to the axis of that lens.
template <Facts facts, class F>
LFDSIM_FN Hit<F> meet_first(const TracedDisplay<Scalar<F>>& display, Ray<F> ray, Cell<F> cell) {
    const Vec2<F> axis = axis_of(lattice_of<facts>(display), cell);
    ray.at.x = ray.at.x - axis.x;
    ray.at.y = ray.at.y - axis.y;
    Hit<F> hit = meet<facts>(display, 0, ray);
    hit.ok = inside_cell<facts>(display, hit.at, hit.ok);
    return hit;
}

/// Returns whether a path from (x, y) in the cell `first` to (x + ex, y + ey) in the cell `last` can meet no lens but theirs. False
/// where that is not certain.
template <class F>
LFDSIM_FN Mask<F> passes_two_cells(const TracedDisplay<Scalar<F>>& display, Cell<F> first, Cell<F> last, F x, F y, F ex, F ey) {
    using S = Scalar<F>;
    const Lattice<S>& lattice = display.lattice;
    // Across one border. (A line between neighbours in a comb may cut a third cell, but not its lens.)
    if (!lattice.staggered) return abs(last.i - first.i) + abs(last.j - first.j) <= F(S(1.5));
    if (!lattice.hexagonal) return F(0) > F(1);
    // The axes of neighbours are a pitch apart, and those of the two lenses beside both are sqrt(3)/2 pitches off the line
    // through them: farther from the path than the lenses are wide, where neither of its ends is far off that line.
    const S pitch = lattice.pitch[0], far = S(0.866) * pitch - display.surface[0].semi_aperture;
    const Vec2<F> from = axis_of(lattice, first), to = axis_of(lattice, last);
    const F dx = to.x - from.x, dy = to.y - from.y, ax = x - from.x, ay = y - from.y;
    // Distances of the path's ends from the line through both axes, times the distance of the axes
    const F start = ax * dy - ay * dx, end = start + (ex * dy - ey * dx);
    return (dx * dx + dy * dy <= F(S(1.1) * pitch * pitch)) && (max(abs(start), abs(end)) <= F(pitch * far));
}

/// Finds the cap of another cell, if any, that the rays of `astray` meet before they are down at the rims, and writes hit and cell
/// of those that do; these rays miss the cap of the cell they point at. (x, y): where they enter the zone of the caps, zone_bottom
/// <= z
/// <= zone_top, from the base lens's axis; m = -d(x, y)/dz, the lateral displacement per mm of descent.
template <Facts facts, class F>
LFDSIM_RARE void meet_neighbours(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F x,
                                 F y, F mx, F my, Mask<F> astray, Hit<F>& hit, Cell<F>& cell) {
    assume<facts>(display);
    const Cell<F> own = cell;
    auto try_cell = [&](Cell<F> here, Mask<F> active) {
        active = active && !((here.i == own.i) && (here.j == own.j));
        if (none(active)) return active;
        const Hit<F> next = meet_first<facts>(display, ray, here);
        const Mask<F> met = active && next.ok;
        hit = {choose(met, next.at, hit.at), choose(met, next.normal, hit.normal), select(met, next.cos, hit.cos),
               select(met, next.cos2, hit.cos2), hit.ok || met};
        cell = choose(met, here, cell);
        return met;
    };
    const F depth = F(display.zone_top - display.zone_bottom);
    const Cell<F> last = cell_at(display.lattice, x + mx * depth, y + my * depth);
    if (none(astray && !passes_two_cells(display, cell, last, x, y, mx * depth, my * depth))) {
        try_cell(last, astray && extent.holds(last));
        return;
    }
    walk_cells(display, extent, x, y, mx, my, F(0), depth, astray, try_cell);
}

/// Returns which rays may meet another lens on their path from (x, y) to (x + ex, y + ey), where they are down at the rims, in a
/// view from above. Each starts in `cell`, whose lens it misses; r is the semi-aperture. None that ends in the cell in which it
/// starts can. A ray that passes within r of another axis and ends outside of that lens has passed the foot of the perpendicular
/// from the axis, at most r away, and from there it moves less than |(ex, ey)|: it ends at most sqrt(r^2 + ex^2 + ey^2) from that
/// axis.
template <class F>
LFDSIM_FN Mask<F> may_meet_neighbours(const Lattice<Scalar<F>>& lattice, Cell<F> cell, F x, F y, F ex, F ey, F r) {
    const Vec2<F> axis = axis_of(lattice, cell);
    if (lattice.strips) {  // across them alone; such a ray ends from r on this side of the axis to ex beyond it
        const F ux = abs(x - axis.x + ex), px = F(lattice.pitch[0]), ax = px - ux;
        return (ux > F(lattice.half_pitch[0])) && ((ax * ax <= r * r + ex * ex) || (ux > px));
    }
    const F ux = abs(x - axis.x + ex), uy = abs(y - axis.y + ey), px = F(lattice.pitch[0]), py = F(lattice.pitch[1]);
    const Mask<F> out_x = ux > F(lattice.half_pitch[0]), out_y = uy > F(lattice.half_pitch[1]);
    if (LaneTraits<F>::width == 1 && !lattice.staggered && none(out_x || out_y)) return out_x;  // most single rays end here
    const F reach2 = r * r + (ex * ex + ey * ey);
    if (lattice.staggered) {
        // The nearest of the neighbours in its row, in the next row and in the row after that decides; beyond those a ray may be
        // near any lens.
        const F ax = ux - px, bx = ux - F(lattice.half_pitch[0]), by = uy - py, cy = by - py;
        F nearest = min(ax * ax + uy * uy, bx * bx + by * by);
        if (!lattice.hexagonal) nearest = min(nearest, ux * ux + cy * cy);  // low bricks
        return !in_cell(lattice, ux, uy) && ((nearest <= reach2) || (ux > px) || (uy > py));
    }
    // The neighbour across the one border that the ray crosses decides; where it crosses more than one, it may be near any lens.
    const F ax = min(ux, px - ux), ay = min(uy, py - uy);
    const Mask<F> near = (ax * ax + ay * ay <= reach2) || (out_x && out_y) || (ux > px) || (uy > py);
    return (out_x || out_y) && near;
}

/// Returns whether a path from a point of the cell `from` to the point (x, y) may pass cells with lenses.
template <class F>
LFDSIM_FN Mask<F> may_enter(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, Cell<F> from, F x, F y) {
    const Cell<F> to = cell_at(display.lattice, x, y);
    const F beside = F(display.lattice.staggered ? 1 : 0);  // as far as a path between staggered cells may lead aside
    return (min(from.i, to.i) <= F(extent.high_i) + beside) && (max(from.i, to.i) >= F(extent.low_i) - beside) &&
           (min(from.j, to.j) <= F(extent.high_j) + beside) && (max(from.j, to.j) >= F(extent.low_j) - beside);
}

/// Finds the lens through which a ray enters the array (passage.cell) and where it meets that lens's first surface. `ray` starts in
/// the vertex plane of the first surfaces; the hit is relative to the axis of the lens found. Most rays meet the cap of the cell
/// they point at; a ray that misses it and leaves the cell before it is down at the rims is tested against the next cells.
template <Facts facts, class F>
LFDSIM_FN Hit<F> enter_array(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const Ray<F>& ray,
                             Passage<F>& passage) {
    const auto& first = display.surface[0];
    const F fall = inverse(ray.to.z);  // dx/dz = to.x fall
    // The cell is that at the point where the ray enters the zone of the caps (the plane of the rims, if they are the highest).
    F x = ray.at.x, y = ray.at.y;
    if (facts.plano_convex != Known::yes && display.zone_top != first.z) {
        const F up = F(display.zone_top - first.z) * fall;
        x = x + ray.to.x * up;
        y = y + ray.to.y * up;
    }
    passage.cell = cell_at(lattice_of<facts>(display), x, y);
    Hit<F> hit = meet_first<facts>(display, ray, passage.cell);
    hit.ok = both(hit.ok, extent.holds(passage.cell));
    if (facts.plano_convex != Known::yes && display.concave_front) {  // the entrance is the rim's circle or cell
        const Vec2<F> axis = axis_of(display.lattice, passage.cell);
        const F lx = x - axis.x, ly = across(display.lattice, y - axis.y), r = F(first.semi_aperture);
        hit.ok = hit.ok && (lx * lx + ly * ly <= r * r);
    } else if (facts.plano_convex == Known::yes || display.zone_top > display.zone_bottom) {
        // The three tests become more expensive from one to the next, and few rays are left for the last.
        const F kd = F(display.zone_bottom - display.zone_top) * fall;  // path length through the caps' zone
        Mask<F> astray = both(passage.alive, !hit.ok);
        if (LaneTraits<F>::width > 1 || any(astray)) {
            astray = both(astray, may_meet_neighbours(lattice_of<facts>(display), passage.cell, x, y, ray.to.x * kd, ray.to.y * kd,
                                                      F(first.semi_aperture)));
            if (any(astray)) astray = both(astray, may_enter(display, extent, passage.cell, x + ray.to.x * kd, y + ray.to.y * kd));
            if (any(astray)) {
                Hit<F> found = hit;
                Cell<F> cell = passage.cell;
                const Ray<F> from = ray;
                meet_neighbours<facts>(display, extent, from, x, y, -(ray.to.x * fall), -(ray.to.y * fall), astray, found, cell);
                hit = found;
                hit.ok = both(found.ok, passage.alive);  // else it would be kept in memory
                passage.cell = cell;
            }
        }
    }
    passage.alive = both(passage.alive, hit.ok);
    return hit;
}

/// The rules of pass_lens() for a lens in an array: apertures and cells, as masks over a packet's rays.
template <Facts facts, class F>
struct InArray {
    const TracedDisplay<Scalar<F>>& display;
    const Extent<Scalar<F>>& extent;
    const Cell<F> cell;

    LFDSIM_FN Vec2<F> axis() const { return axis_of(lattice_of<facts>(display), cell); }
    LFDSIM_FN void meets(int k, const Ray<F>&, const Hit<F>& hit, F, F, Passage<F>& passage) const {
        if (k > 0)
            passage.alive = passage.alive && inside_cell<facts>(display, hit.at, hit.ok);  // enter_array() has tested the first
    }
    LFDSIM_FN Mask<F> passes_stop(Mask<F>, F x, F y) const { return optics::passes_stop(display, extent, x, y); }
    LFDSIM_FN void leaves(const Passage<F>&) const {}
    LFDSIM_FN Mask<F> passes_back(F x, F y) const {
        const F r = F(display.surface[display.surface_count - 1].semi_aperture);
        const F z = F(0), from_middle = across(display.lattice, y);
        return inside_cell<facts>(display, Vec3<F>{x, y, z}, x * x + from_middle * from_middle <= r * r);
    }
    LFDSIM_FN bool over(Mask<F>) const { return false; }
};

/// Traces rays through one lens of an opaque array to the panel. passage.ray starts in the vertex plane of the first surface, mm
/// from the base lens's axis. The radiance is multiplied by the transmittances of surfaces and layers and by cos^m of the angle
/// at the panel, m the emission exponent; a ray that is absorbed has `alive` cleared.
template <Facts facts, class F>
LFDSIM_FN PanelPoint<F> trace_opaque(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                                     const PanelBase<Scalar<F>>& base, Passage<F> passage) {
    using S = Scalar<F>;
    const int count = facts.plano_convex == Known::yes ? 2 : display.surface_count;
    const Ray<F> entering = passage.ray;
    const Hit<F> hit = enter_array<facts>(display, extent, entering, passage);
    assume<facts>(display);
    pass_lens<facts>(display, InArray<facts, F>{display, extent, passage.cell}, entering, hit, passage);
    const Vec3<F> leaves{passage.ray.at.x, passage.ray.at.y, passage.ray.at.z + F(display.surface[count - 1].z)};
    Vec2<F> end;
    if constexpr (facts.on_air == Known::yes) {
        const F t = quotient(-leaves.z, passage.ray.to.z);
        end = {leaves.x + passage.ray.to.x * t, leaves.y + passage.ray.to.y * t};
    } else {
        const Mask<F> glued = F(display.glued ? 1 : 0) > F(0);
        end = down_to_panel(display, leaves, glued, passage.ray.to, passage.weight, passage.alive);
    }
    if (facts.plain_light != Known::yes && display.emission_exponent != S(0))
        passage.weight = passage.weight * power(-passage.ray.to.z, display.emission_exponent);
    return panel_point<facts.plain_light == Known::yes>(display, lattice_of<facts>(display), base, passage.cell, end.x, end.y,
                                                        passage.weight, passage.alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
