// Arrays with errors: each lens stands where it was put, and the array as a whole may not be parallel to the panel. Opaque
// surrounds, ideal lenses and pinholes. docs/model.md, "Errors". Floor 1.
//
// Three frames: the array's turned about z alone, in which the camera's rays come and go, from the base lens's vertex (x, y) and
// the panel (z); the array's own, from that vertex too; and the lens's own, from its viewer-side vertex, as lens.h has it.
#pragma once
#include "optics/clear_surround.h"
#include "optics/lens_pose.h"
#include "optics/opaque_surround.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A lens, and where a ray meets it: in the lens's frame. The ray enters it at the path length `way` from where it starts: on its
/// first surface, or, if that is hollow, through the hole over it, from where it may miss the surface.
template <class F>
struct Encounter {
    Cell<F> cell;
    Stand<F> stand;
    Ray<F> entering;  // in the vertex plane of the first surface, or in a thin lens
    Hit<F> hit;
    F way;
    Mask<F> enters;
};

/// `ray` in the array's frame, z from the vertex plane; fall = 1 / ray.to.z.
template <Facts facts, class F>
LFDSIM_FN Encounter<F> meet_placed(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F fall,
                                   Cell<F> cell) {
    using S = Scalar<F>;
    const Mask<F> there = extent.holds(cell);
    Encounter<F> at{cell, stand_of(scene, extent, cell, there), {}, {}, F(0), there};
    const Place<F> axis = axis_of(scene.lattice, cell);
    Vec3<F> from{ray.at.x - axis.x - at.stand.x, ray.at.y - axis.y - at.stand.y, ray.at.z - at.stand.z}, to = ray.to;
    if (scene.placement.tilted) {
        from = at.stand.turned_in(from);
        to = at.stand.turned_in(to);
        fall = F(1) / to.z;
    }
    const Mask<F> comes = there && (to.z < F(0));
    const bool thin = holds<facts.ideal>(scene.thin);
    const S vertex = thin ? scene.ideal_z : scene.surface[0].z;
    at.way = (F(vertex - scene.placement.vertex_z) - from.z) * fall;
    at.entering = {{from.x + to.x * at.way, from.y + to.y * at.way, F(0)}, to};
    const Vec3<F>& p = at.entering.at;
    if (thin) {
        const F across_y = across(scene.lattice, p.y), r = F(scene.aperture_radius);
        at.hit = {p, {F(0), F(0), F(1)}, -to.z, to.z * to.z, p.x * p.x + across_y * across_y <= r * r};
        if (scene.aperture == Aperture::cell) at.hit.ok = in_cell(scene.lattice, p.x, p.y);
        at.enters = comes && at.hit.ok;
    } else {
        at.hit = meet_curved<facts>(scene, 0, at.entering, at.stand.curvature);
        at.hit.ok = inside_cell<Facts{}>(scene, at.hit.at, at.hit.ok);
        if (facts.plano_convex != Known::yes && scene.dimple) {  // the entrance is the rim
            const F down = (outmost_rim(scene, true, at.stand.curvature) - F(vertex)) * fall;
            const F x = p.x + to.x * down, y = across(scene.lattice, p.y + to.y * down), r = F(scene.surface[0].semi_aperture);
            at.enters = inside_cell<Facts{}>(scene, Vec3<F>{x, p.y + to.y * down, F(0)}, comes && (x * x + y * y <= r * r));
            at.way = at.way + down;
        } else {
            at.enters = comes && at.hit.ok;
            at.way = at.way + at.hit.at.z * fall;
        }
    }
    at.hit.ok = at.hit.ok && at.enters;
    return at;
}

template <class F>
LFDSIM_FN Vec3<F> choose(Mask<F> first, Vec3<F> a, Vec3<F> b) {
    return {select(first, a.x, b.x), select(first, a.y, b.y), select(first, a.z, b.z)};
}

template <class F>
LFDSIM_FN void take(Mask<F> taken, const Encounter<F>& from, Encounter<F>& to) {
    const auto one = [&](F a, F b) { return select(taken, a, b); };
    const Stand<F>&a = from.stand, &b = to.stand;
    to.stand = {one(a.x, b.x),         one(a.y, b.y),         one(a.z, b.z),         one(a.curvature, b.curvature),
                one(a.cos_x, b.cos_x), one(a.sin_x, b.sin_x), one(a.cos_y, b.cos_y), one(a.sin_y, b.sin_y)};
    to.cell = {one(from.cell.i, to.cell.i), one(from.cell.j, to.cell.j)};
    to.entering = {choose(taken, from.entering.at, to.entering.at), choose(taken, from.entering.to, to.entering.to)};
    to.hit = {choose(taken, from.hit.at, to.hit.at), choose(taken, from.hit.normal, to.hit.normal), one(from.hit.cos, to.hit.cos),
              one(from.hit.cos2, to.hit.cos2), (taken && from.hit.ok) || (!taken && to.hit.ok)};
    to.way = one(from.way, to.way);
    to.enters = to.enters || taken;
}

/// The cells of a lattice next to one, and it itself: do(cell) for each.
template <class F, class Do>
LFDSIM_FN void around(const Lattice<Scalar<F>>& lattice, Cell<F> cell, const Do& do_it) {
    using S = Scalar<F>;
    for (int j = lattice.strips ? 0 : -1; j <= (lattice.strips ? 0 : 1); ++j)
        for (int i = -1; i <= 1; ++i) do_it(Cell<F>{cell.i + F(S(i)), cell.j + F(S(j))});
}

/// Takes what rays of `near` meet in a cell, if they meet its lens before the one at hand.
template <Facts facts, class F>
LFDSIM_FN void meet_in(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F fall, Cell<F> cell,
                       Mask<F> near, Encounter<F>& first) {
    const Encounter<F> next = meet_placed<facts>(scene, extent, ray, fall, cell);
    take(near && next.enters && (!first.enters || (next.way < first.way)), next, first);
}

/// Which ways, seen from above and from the axis of their own cell, come near one of its borders only? Lenses stand out of theirs
/// by up to `reach`: such a way leads past no other lens than that of the cell beyond the border, `other`. (Of hexagons, the part
/// between the other borders' lines is in that cell; low bricks may have two beyond a border.)
template <class F>
LFDSIM_FN Mask<F> nears_one_border(const Lattice<Scalar<F>>& lattice, Cell<F> own, Place<F> from, Place<F> end, F reach,
                                   Cell<F>& other) {
    using S = Scalar<F>;
    const F zero = F(0), one = F(1);
    F pair = zero, side = zero, borders_near = zero;
    Mask<F> ends_there = zero < one;
    for (int k = 0; k < border_pairs(lattice); ++k) {
        const Borders<S> of = borders(lattice, k);
        const F a = F(of.x) * from.x + F(of.y) * from.y, b = F(of.x) * end.x + F(of.y) * end.y;
        const F low = min(a, b), high = max(a, b), inside = F(of.half) - reach;
        const Mask<F> below = -inside > low, above = inside < high;
        borders_near = borders_near + (select(below, one, zero) + select(above, one, zero));
        pair = select(below || above, F(S(k)), pair);
        side = select(above, one, select(below, -one, side));
        ends_there = ends_there && (max(-low, high) < F(S(2) * of.half) + inside);
    }
    other = cell_beyond(lattice, own, pair, side, zero);
    return ends_there && (borders_near == one);
}

/// The rays of `astray` pass cells whose neighbours' lenses may stand out into them: finds the lens that each meets first, if it
/// meets any before the one at hand. `from`, `end`: where they come down to search_top, and where their ways end, from the axis of
/// their own cell; `at`: the former from the base lens's axis.
template <Facts facts, class F>
LFDSIM_RARE void meet_others(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F fall,
                             Place<F> from, Place<F> end, Place<F> at, Mask<F> astray, Encounter<F>& first) {
    using S = Scalar<F>;
    const Placement<S>& placement = scene.placement;
    const Cell<F> own = first.cell;
    Cell<F> other = own;
    if (!(scene.lattice.staggered && !scene.lattice.hexagonal) &&
        none(astray && !nears_one_border(scene.lattice, own, from, end, F(max(placement.reach, S(0))), other)))
        return meet_in<facts>(scene, extent, ray, fall, other, astray, first);

    const F depth = F(placement.search_top - placement.search_bottom), r2 = F(placement.radius * placement.radius);
    const Place<F> m{-(ray.to.x * fall), -(ray.to.y * fall)};  // lateral displacement per mm of descent
    const F length2 = max(m.x * m.x + m.y * m.y, F(S(1e-20)));
    // Lenses at the array's border may stand out of all cells.
    const Extent<S> wider{extent.low_i - 1, extent.high_i + 1, extent.low_j - 1, extent.high_j + 1};
    walk_cells(scene, wider, at.x, at.y, m.x, m.y, F(0), depth, astray, [&](Cell<F> cell, Mask<F> active) {
        around(scene.lattice, cell, [&](Cell<F> here) {
            // The point of the way that is nearest to the axis
            const Place<F> axis = axis_of(scene.lattice, here);
            const F dx = axis.x - at.x, dy = across(scene.lattice, axis.y - at.y);
            const F s = min(max((dx * m.x + dy * m.y) / length2, F(0)), depth);
            const F ex = dx - m.x * s, ey = across(scene.lattice, dy - m.y * s);
            const Mask<F> known = (here.i == own.i) && (here.j == own.j),
                          near = active && !known && extent.holds(here) && (ex * ex + ey * ey <= r2);
            if (none(near)) return;
            meet_in<facts>(scene, extent, ray, fall, here, near, first);
        });
        return F(0) > F(1);
    });
}

/// Whether a point, from its own lens's axis and within a pitch of it, comes as near to the axis of another lens as sqrt(reach2).
template <class F>
LFDSIM_FN Mask<F> nears_another(const Lattice<Scalar<F>>& lattice, Place<F> at, F reach2) {
    const F x = abs(at.x), y = across(lattice, abs(at.y)), px = F(lattice.pitch[0]), py = F(lattice.pitch[1]);
    const F ax = x - px, ay = y - py;
    F nearest = ax * ax + y * y;
    if (lattice.staggered) {  // of the next row, and, of low bricks, of the one after that
        const F bx = x - F(lattice.half_pitch[0]), by = ay - py;
        nearest = min(nearest, bx * bx + ay * ay);
        if (!lattice.hexagonal) nearest = min(nearest, x * x + by * by);
    } else if (!lattice.strips) {
        nearest = min(nearest, min(x * x, ax * ax) + ay * ay);
    }
    return (nearest <= reach2) || (x > px) || (y > py);
}

/// The first lens that a ray meets; `ray` in the array's frame, z from the vertex plane.
template <Facts facts, class F>
LFDSIM_FN Encounter<F> enter_placed(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const Ray<F>& ray,
                                    Mask<F> alive) {
    const Placement<Scalar<F>>& placement = scene.placement;
    const F fall = F(1) / ray.to.z;
    const F up = (F(placement.search_top) - ray.at.z) * fall, down = (F(placement.search_bottom) - ray.at.z) * fall;
    const F x = ray.at.x + ray.to.x * up, y = ray.at.y + ray.to.y * up;
    const Cell<F> cell = cell_at(scene.lattice, x, y);
    Encounter<F> first = meet_placed<facts>(scene, extent, ray, fall, cell);
    // A way from there to the lens, or to below all lenses, that is further from the cell's border than lenses stand out of their
    // own cells leads past no other one. Nor does one that is further from other lenses than they are wide.
    const Place<F> axis = axis_of(scene.lattice, cell);
    const F way = select(first.enters, first.way, down), end_x = ray.at.x + ray.to.x * way, end_y = ray.at.y + ray.to.y * way;
    const F margin = F(-placement.reach);
    const Place<F> from_axis{x - axis.x, y - axis.y}, end{end_x - axis.x, end_y - axis.y};
    const Mask<F> alone = in_cell(scene.lattice, from_axis.x, from_axis.y, margin) && in_cell(scene.lattice, end.x, end.y, margin);
    Mask<F> astray = alive && !alone;
    if (any(astray)) {
        // One that comes within r of another axis begins there, ends there, or has passed the foot of the perpendicular from it,
        // and moves on by less than its length.
        const F ex = end.x - from_axis.x, ey = across(scene.lattice, end.y - from_axis.y),
                r2 = F(placement.radius * placement.radius);
        astray =
            astray && (nears_another(scene.lattice, end, r2 + (ex * ex + ey * ey)) || nears_another(scene.lattice, from_axis, r2));
    }
    if (any(astray)) {
        const Ray<F> here = ray;
        Encounter<F> found = first;
        meet_others<facts>(scene, extent, here, fall, from_axis, end, {x, y}, astray, found);
        first = found;
    }
    return first;
}

/// Does a straight part of a ray's way pass the stop's hole of a lens in one of these cells? `p` in the array's frame, z from the
/// vertex plane; `from` and `end` are path lengths from there.
template <class F>
LFDSIM_FN Mask<F> passes_hole(const Scene<Scalar<F>>& scene, Cell<F> cell, const Stand<F>& stand, Vec3<F> p, Vec3<F> d, F from,
                              F end) {
    const Place<F> centre = axis_of(scene.lattice, cell);
    const F t = (F(scene.stop_z - scene.placement.vertex_z) + stand.z - p.z) / d.z;
    const F x = p.x + d.x * t - centre.x - stand.x, y = across(scene.lattice, p.y + d.y * t - centre.y - stand.y);
    return (t >= from) && (t <= end) && (x * x + y * y <= F(scene.stop_radius2));
}

/// The same of any lens near the point at `near` along that way.
template <class F>
LFDSIM_RARE Mask<F> passes_any_hole(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, Vec3<F> p, Vec3<F> d, F near,
                                    F from, F end, Mask<F> active) {
    Mask<F> through = F(0) > F(1);
    around(scene.lattice, cell_at(scene.lattice, p.x + d.x * near, p.y + d.y * near), [&](Cell<F> cell) {
        const Mask<F> there = active && extent.holds(cell);
        if (any(there))
            through = through || (there && passes_hole(scene, cell, stand_of(scene, extent, cell, there), p, d, from, end));
    });
    return through;
}

/// The rules of pass_lens() for a lens that stands by itself. Its stop's hole stands in the array's frame, moved with the lens but
/// not turned; a ray may pass that of any lens.
template <Facts facts, class F>
struct Placed : InArray<Facts{}, F> {
    const Stand<F> stand;

    LFDSIM_FN Place<F> axis() const { return {F(0), F(0)}; }
    LFDSIM_FN Hit<F> meet(int k, const Ray<F>& in_vertex_plane) const {
        return meet_curved<facts>(this->scene, k, in_vertex_plane, stand.curvature);
    }

    LFDSIM_FN F wall_bottom() const { return outmost_rim(this->scene, false, stand.curvature); }

    /// Takes the rays from `ahead` that pass a hole on a straight part of their way: from `at`, in the lens's frame, z from the
    /// panel, between these path lengths.
    LFDSIM_FN void stop_between(F from, F end, Vec3<F> at, Vec3<F> to, Mask<F>& ahead) const {
        const auto& here = this->scene;
        Vec3<F> p{at.x, at.y, at.z - F(here.placement.vertex_z)}, d = to;
        if (here.placement.tilted) {
            p = stand.turned_out(p);
            d = stand.turned_out(d);
        }
        const Place<F> axis = axis_of(here.lattice, this->cell);
        p = {p.x + axis.x + stand.x, p.y + axis.y + stand.y, p.z + stand.z};
        ahead = ahead && !passes_hole(here, this->cell, stand, p, d, from, end);
        if (none(ahead)) return;
        const F near = (F(here.stop_z - here.placement.vertex_z) + stand.z - p.z) / d.z;
        const Vec3<F> start = p, along = d;
        ahead = ahead && !passes_any_hole(here, this->extent, start, along, near, from, end, ahead);
    }
};

/// A thin lens or a pinhole: way.ray leaves it in the lens's frame.
template <Facts facts, class F>
LFDSIM_FN void pass_thin(const Scene<Scalar<F>>& scene, const Placed<facts, F>& rules, const Encounter<F>& met, Passage<F>& way) {
    const Vec3<F> to = met.entering.to;
    const F fall = F(1) / to.z, power = F(scene.ideal_power) * met.stand.curvature;
    const F mx = to.x * fall + met.hit.at.x * power, my = to.y * fall + across(scene.lattice, met.hit.at.y) * power;
    const F per = F(1) / sqrt(F(1) + mx * mx + my * my);
    way.ray = {met.hit.at, {-(mx * per), -(my * per), -per}};
    if (!scene.has_stop) return;
    const F endless = F(Scalar<F>(1e30));
    const Vec3<F> at{met.hit.at.x, met.hit.at.y, F(scene.ideal_z)};
    Mask<F> ahead = way.alive;
    rules.stop_between(-endless, F(0), at, to, ahead);
    if (any(ahead)) rules.stop_between(F(0), endless, at, way.ray.to, ahead);
    way.alive = way.alive && !ahead;
}

/// A vector of the frame turned about z in the array's (`in`), or the other way round.
template <class F>
LFDSIM_FN Vec3<F> wedged(const Placement<Scalar<F>>& placement, bool in, Vec3<F> v) {
    const auto row = [&](int k) {
        const auto of = [&](int l) { return F(in ? placement.wedge[l][k] : placement.wedge[k][l]); };
        return v.x * of(0) + v.y * of(1) + v.z * of(2);
    };
    return {row(0), row(1), row(2)};
}

/// The middle of a lens's hole, so far below the vertex, about which the lens tilts, or of a cell without a lens; z from the
/// array's vertex plane. y: of any point of a strip's axis.
template <class S>
LFDSIM_FN Vec3<S> middle_of_hole(const Scene<S>& scene, const Extent<S>& extent, Cell<S> lens, S y, S below_vertex) {
    const bool there = extent.holds(lens);
    const Stand<S> stand = there ? stand_of<S>(scene, extent, lens, there) : Stand<S>{0, 0, 0, 1, 1, 0, 1, 0};
    const Place<S> axis = axis_of(scene.lattice, lens);
    const Vec3<S> off = stand.turned_out({S(0), S(0), -below_vertex});
    const Vec3<S> at{axis.x + stand.x + off.x, scene.lattice.strips ? y : axis.y + stand.y + off.y, stand.z + off.z};
    return scene.placement.wedged ? wedged<S>(scene.placement, false, at) : at;
}

/// A ray in the plane z = entrance, of the frame turned about z, in the array's, z from the vertex plane.
template <class F>
LFDSIM_FN Ray<F> in_array(const Scene<Scalar<F>>& scene, const PanelBase<Scalar<F>>& base, const Ray<F>& ray) {
    const Placement<Scalar<F>>& placement = scene.placement;
    const Scalar<F> entrance = scene.thin ? scene.ideal_z : scene.surface[0].z;
    const Ray<F> here{{ray.at.x, ray.at.y, F((entrance - placement.vertex_z) - base.raised)}, ray.to};
    return placement.wedged ? Ray<F>{wedged(placement, true, here.at), wedged(placement, true, here.to)} : here;
}

/// From where a ray leaves the lenses, in the array's frame, z from the vertex plane, to the panel. `glued`: it is in the top
/// layer.
template <class F>
LFDSIM_FN PanelPoint<F> out_of_array(const Scene<Scalar<F>>& scene, const PanelBase<Scalar<F>>& base, Ray<F> ray, Mask<F> glued,
                                     F weight, Mask<F> alive) {
    const Placement<Scalar<F>>& placement = scene.placement;
    if (placement.wedged) ray = {wedged(placement, false, ray.at), wedged(placement, false, ray.to)};
    alive = alive && (ray.to.z < F(0));
    ray.at.z = ray.at.z + F(placement.vertex_z + base.raised);
    const Place<F> end = down_to_panel(scene, ray.at, glued, ray.to, weight, alive);
    if (scene.emission_exponent != Scalar<F>(0)) weight = weight * power(abs(ray.to.z), scene.emission_exponent);
    return panel_point(scene, scene.lattice, base, Cell<F>{F(0), F(0)}, end.x, end.y, weight, alive);
}

/// From the plane z = entrance, in which way.ray starts, to the panel.
template <Facts facts, class F>
LFDSIM_FN PanelPoint<F> trace_placed(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent,
                                     const PanelBase<Scalar<F>>& base, Passage<F> way) {
    using S = Scalar<F>;
    const Placement<S>& placement = scene.placement;
    const Ray<F> ray = in_array(scene, base, way.ray);
    way.alive = way.alive && (ray.to.z < F(S(-1e-9)));
    const Encounter<F> met = enter_placed<facts>(scene, extent, ray, way.alive);
    way.alive = way.alive && met.hit.ok;
    way.cell = met.cell;
    way.ray = met.entering;
    assume<facts>(scene);
    const Placed<facts, F> rules{{scene, extent, way.cell}, met.stand};
    S plane = scene.ideal_z;
    if (holds<facts.ideal>(scene.thin)) {
        pass_thin(scene, rules, met, way);
    } else {
        pass_lens<facts>(scene, rules, met.entering, met.hit, way);
        plane = scene.surface[facts.plano_convex == Known::yes ? 1 : scene.surface_count - 1].z;
    }
    Vec3<F> at{way.ray.at.x, way.ray.at.y, way.ray.at.z + F(plane - placement.vertex_z)}, to = way.ray.to;
    if (placement.tilted) {
        at = met.stand.turned_out(at);
        to = met.stand.turned_out(to);
    }
    const Place<F> axis = axis_of(scene.lattice, way.cell);
    at = {at.x + axis.x + met.stand.x, at.y + axis.y + met.stand.y, at.z + met.stand.z};
    PanelPoint<F> point = out_of_array(scene, base, Ray<F>{at, to}, F(scene.glued ? 1 : 0) > F(0), way.weight, way.alive);
    point.cell = way.cell;
    return point;
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
