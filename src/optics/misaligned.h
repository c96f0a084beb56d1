// Misaligned arrays: each lens has a different pose, and the array as a whole may not be parallel to the panel. Opaque
// surrounds, ideal lenses and pinholes. docs/model.md, "Errors". Floor 1.
//
// There are three frames: the one turned about z alone, in which rays come from the camera and go to the panel, from the base
// lens's vertex (x, y) and the panel (z); the array's, from that vertex and the vertex plane; and the lens's, from its axis and, as
// in lens.h, the vertex of the present surface.
#pragma once
#include "optics/clear_surround.h"
#include "optics/lens_pose.h"
#include "optics/opaque_surround.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A lens, and where a ray meets it, in the lens's frame. A ray enters a lens on its first surface, or, if that is concave, through
/// the hole over it, from where it may miss the surface.
template <class F>
struct Encounter {
    Cell<F> cell;
    LensPose<F> pose;
    Ray<F> entering;  // in the vertex plane of the first surface, or in an ideal lens
    Hit<F> hit;       // on the first surface; `ok` only where the ray enters, too
    F path_length;    // from the ray's start to where it enters, mm
    Mask<F> enters;
};

/// Returns where a ray meets the lens in `cell`. `ray` is in the array's frame, z from the vertex plane; fall = 1 / ray.to.z.
template <Facts facts, class F>
LFDSIM_FN Encounter<F> meet_misaligned(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const Ray<F>& ray,
                                       F fall, Cell<F> cell) {
    using S = Scalar<F>;
    const Mask<F> there = extent.holds(cell);
    Encounter<F> at{cell, pose_of(display, extent, cell, there), {}, {}, F(0), there};
    const Vec2<F> axis = axis_of(display.lattice, cell);
    Vec3<F> from{ray.at.x - axis.x - at.pose.x, ray.at.y - axis.y - at.pose.y, ray.at.z - at.pose.z}, to = ray.to;
    if (display.misaligned.tilted) {
        from = at.pose.turned_in(from);
        to = at.pose.turned_in(to);
        fall = F(1) / to.z;
    }
    // To the vertex plane of the first surface, then to the surface
    const Mask<F> comes = there && (to.z < F(0));
    const bool thin = holds<facts.ideal>(display.ideal);
    const S vertex = thin ? display.ideal_z : display.surface[0].z;
    at.path_length = (F(vertex - display.misaligned.vertex_z) - from.z) * fall;
    at.entering = {{from.x + to.x * at.path_length, from.y + to.y * at.path_length, F(0)}, to};
    const Vec3<F>& p = at.entering.at;
    if (thin) {
        const F across_y = across(display.lattice, p.y), r = F(display.aperture_radius);
        at.hit = {p, {F(0), F(0), F(1)}, -to.z, to.z * to.z, p.x * p.x + across_y * across_y <= r * r};
        if (display.aperture == Aperture::cell) at.hit.ok = in_cell(display.lattice, p.x, p.y);
        at.enters = comes && at.hit.ok;
    } else {
        at.hit = meet_curved<facts>(display, 0, at.entering, at.pose.curvature);
        at.hit.ok = inside_cell<Facts{}>(display, at.hit.at, at.hit.ok);
        if (facts.plano_convex != Known::yes && display.concave_front) {  // the entrance is the rim
            const F down = (outmost_rim(display, true, at.pose.curvature) - F(vertex)) * fall;
            const F x = p.x + to.x * down, y = across(display.lattice, p.y + to.y * down), r = F(display.surface[0].semi_aperture);
            at.enters = inside_cell<Facts{}>(display, Vec3<F>{x, p.y + to.y * down, F(0)}, comes && (x * x + y * y <= r * r));
            at.path_length = at.path_length + down;
        } else {
            at.enters = comes && at.hit.ok;
            at.path_length = at.path_length + at.hit.at.z * fall;
        }
    }
    at.hit.ok = at.hit.ok && at.enters;
    return at;
}

/// Replaces `to` by `from` in the lanes of `taken`, which all enter their lens.
template <class F>
LFDSIM_FN void take(Mask<F> taken, const Encounter<F>& from, Encounter<F>& to) {
    const auto one = [&](F a, F b) { return select(taken, a, b); };
    const LensPose<F>&a = from.pose, &b = to.pose;
    to.pose = {one(a.x, b.x),         one(a.y, b.y),         one(a.z, b.z),         one(a.curvature, b.curvature),
               one(a.cos_x, b.cos_x), one(a.sin_x, b.sin_x), one(a.cos_y, b.cos_y), one(a.sin_y, b.sin_y)};
    to.cell = choose(taken, from.cell, to.cell);
    to.entering = {choose(taken, from.entering.at, to.entering.at), choose(taken, from.entering.to, to.entering.to)};
    to.hit = {choose(taken, from.hit.at, to.hit.at), choose(taken, from.hit.normal, to.hit.normal), one(from.hit.cos, to.hit.cos),
              one(from.hit.cos2, to.hit.cos2), (taken && from.hit.ok) || (!taken && to.hit.ok)};
    to.path_length = one(from.path_length, to.path_length);
    to.enters = to.enters || taken;
}

/// Calls do_it(cell) for a cell and its neighbours: three by three, of strips three in a row. Of staggered rows these include all
/// cells that border on it.
template <class F, class Do>
LFDSIM_FN void around(const Lattice<Scalar<F>>& lattice, Cell<F> cell, const Do& do_it) {
    using S = Scalar<F>;
    for (int j = lattice.strips ? 0 : -1; j <= (lattice.strips ? 0 : 1); ++j)
        for (int i = -1; i <= 1; ++i) do_it(Cell<F>{cell.i + F(S(i)), cell.j + F(S(j))});
}

/// Replaces `first` by the lens in `cell` for the rays of `near` that enter it at a shorter path length.
template <Facts facts, class F>
LFDSIM_FN void meet_in(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F fall,
                       Cell<F> cell, Mask<F> near, Encounter<F>& first) {
    const Encounter<F> next = meet_misaligned<facts>(display, extent, ray, fall, cell);
    take(near && next.enters && (!first.enters || (next.path_length < first.path_length)), next, first);
}

/// Returns which paths come near one border of their cell only. `from` and `end` are a path's ends in a view from above, from the
/// axis of the cell `own`. Lenses protrude from their cells by up to `overhang`, so such a path leads past no other lens than that
/// of the cell beyond the border, which is written to `other`. (Of hexagons, the part between the other borders' lines is in that
/// cell; low bricks may have two beyond a border.)
template <class F>
LFDSIM_FN Mask<F> nears_one_border(const Lattice<Scalar<F>>& lattice, Cell<F> own, Vec2<F> from, Vec2<F> end, F overhang,
                                   Cell<F>& other) {
    using S = Scalar<F>;
    const F zero = F(0), one = F(1);
    F pair = zero, side = zero, borders_near = zero;  // the last border found near, and how many are
    Mask<F> ends_there = zero < one;
    for (int k = 0; k < border_pairs(lattice); ++k) {
        const Borders<S> of = borders(lattice, k);
        const F a = F(of.x) * from.x + F(of.y) * from.y, b = F(of.x) * end.x + F(of.y) * end.y;
        const F low = min(a, b), high = max(a, b), inside = F(of.half) - overhang;
        const Mask<F> below = -inside > low, above = inside < high;
        borders_near = borders_near + (select(below, one, zero) + select(above, one, zero));
        pair = select(below || above, F(S(k)), pair);
        side = select(above, one, select(below, -one, side));
        ends_there = ends_there && (max(-low, high) < F(S(2) * of.half) + inside);
    }
    other = cell_beyond(lattice, own, pair, side, zero);
    return ends_there && (borders_near == one);
}

/// Finds the lens that each ray of `astray` meets first, if it meets any before `first`: these rays pass cells into which lenses of
/// neighbours may protrude. `from`, `end`: where they come down to search_top, and where their paths end, from the axis of the cell
/// first.cell; `at`: the former from the base lens's axis.
template <Facts facts, class F>
LFDSIM_RARE void meet_others(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const Ray<F>& ray, F fall,
                             Vec2<F> from, Vec2<F> end, Vec2<F> at, Mask<F> astray, Encounter<F>& first) {
    using S = Scalar<F>;
    const MisalignedArray<S>& misaligned = display.misaligned;
    const Cell<F> own = first.cell;
    Cell<F> other = own;
    if (!(display.lattice.staggered && !display.lattice.hexagonal) &&
        none(astray && !nears_one_border(display.lattice, own, from, end, F(max(misaligned.overhang, S(0))), other)))
        return meet_in<facts>(display, extent, ray, fall, other, astray, first);

    const F depth = F(misaligned.search_top - misaligned.search_bottom), r2 = F(misaligned.radius * misaligned.radius);
    const Vec2<F> m{-(ray.to.x * fall), -(ray.to.y * fall)};  // lateral displacement per mm of descent
    const F across_m = across(display.lattice, m.y), length2 = max(m.x * m.x + across_m * across_m, F(S(1e-20)));
    // Otherwise all lenses around each cell on the path. Lenses at the array's border may protrude from all cells.
    const Extent<S> wider{extent.low_i - 1, extent.high_i + 1, extent.low_j - 1, extent.high_j + 1};
    walk_cells(display, wider, at.x, at.y, m.x, m.y, F(0), depth, astray, [&](Cell<F> cell, Mask<F> active) {
        around(display.lattice, cell, [&](Cell<F> here) {
            // The point of the path that is nearest to the axis
            const Vec2<F> axis = axis_of(display.lattice, here);
            const F dx = axis.x - at.x, dy = across(display.lattice, axis.y - at.y);
            const F s = min(max((dx * m.x + dy * across_m) / length2, F(0)), depth);
            const F ex = dx - m.x * s, ey = dy - across_m * s;
            const Mask<F> known = (here.i == own.i) && (here.j == own.j),
                          near = active && !known && extent.holds(here) && (ex * ex + ey * ey <= r2);
            if (none(near)) return;
            meet_in<facts>(display, extent, ray, fall, here, near, first);
        });
        return F(0) > F(1);  // on to the next cell in any case: a lens farther along the path may protrude and be met first
    });
}

/// Returns whether a point, measured from a lens's axis and within a pitch of it, is at most sqrt(reach2) from the axis of another
/// lens; true farther out, where it is not known.
template <class F>
LFDSIM_FN Mask<F> nears_another(const Lattice<Scalar<F>>& lattice, Vec2<F> at, F reach2) {
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

/// Returns the first lens that a ray meets; `ray` is in the array's frame, z from the vertex plane. Only the lens of the cell that
/// the ray points at is tested for all rays; others only where the path may come near them.
template <Facts facts, class F>
LFDSIM_FN Encounter<F> enter_misaligned(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const Ray<F>& ray,
                                        Mask<F> alive) {
    const MisalignedArray<Scalar<F>>& misaligned = display.misaligned;
    const F fall = F(1) / ray.to.z;
    const F up = (F(misaligned.search_top) - ray.at.z) * fall, down = (F(misaligned.search_bottom) - ray.at.z) * fall;
    const F x = ray.at.x + ray.to.x * up, y = ray.at.y + ray.to.y * up;
    const Cell<F> cell = cell_at(display.lattice, x, y);
    Encounter<F> first = meet_misaligned<facts>(display, extent, ray, fall, cell);
    // A path from there to the lens, or to below all lenses, that is further from the cell's border than lenses protrude from their
    // cells leads past no other one. Nor does one that is further from other lenses than they are wide.
    const Vec2<F> axis = axis_of(display.lattice, cell);
    const F path_length = select(first.enters, first.path_length, down), end_x = ray.at.x + ray.to.x * path_length,
            end_y = ray.at.y + ray.to.y * path_length;
    const F margin = F(-misaligned.overhang);
    const Vec2<F> from_axis{x - axis.x, y - axis.y}, end{end_x - axis.x, end_y - axis.y};
    const Mask<F> alone =
        in_cell(display.lattice, from_axis.x, from_axis.y, margin) && in_cell(display.lattice, end.x, end.y, margin);
    Mask<F> astray = alive && !alone;
    if (any(astray)) {
        // A path that comes within r of another axis begins there, ends there, or has passed the foot of the perpendicular from
        // that axis; from the foot it moves on by less than its length.
        const F ex = end.x - from_axis.x, ey = across(display.lattice, end.y - from_axis.y),
                r2 = F(misaligned.radius * misaligned.radius);
        astray = astray &&
                 (nears_another(display.lattice, end, r2 + (ex * ex + ey * ey)) || nears_another(display.lattice, from_axis, r2));
    }
    if (any(astray)) {
        const Ray<F> here = ray;
        Encounter<F> found = first;
        meet_others<facts>(display, extent, here, fall, from_axis, end, {x, y}, astray, found);
        first = found;
    }
    return first;
}

/// Returns whether a straight part of a ray's path passes the stop's hole of the lens in `cell`. `p` is in the array's frame, z
/// from the vertex plane; `from` and `end` are path lengths from there.
template <class F>
LFDSIM_FN Mask<F> passes_hole(const TracedDisplay<Scalar<F>>& display, Cell<F> cell, const LensPose<F>& pose, Vec3<F> p, Vec3<F> d,
                              F from, F end) {
    const Vec2<F> centre = axis_of(display.lattice, cell);
    const F t = (F(display.stop_z - display.misaligned.vertex_z) + pose.z - p.z) / d.z;
    const F x = p.x + d.x * t - centre.x - pose.x, y = across(display.lattice, p.y + d.y * t - centre.y - pose.y);
    return (t >= from) && (t <= end) && (x * x + y * y <= F(display.stop_radius2));
}

/// Returns whether a straight part of a ray's path passes the hole of any lens near the point at the path length `near`; the rest
/// as for passes_hole().
template <class F>
LFDSIM_RARE Mask<F> passes_any_hole(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, Vec3<F> p, Vec3<F> d,
                                    F near, F from, F end, Mask<F> active) {
    Mask<F> through = F(0) > F(1);
    around(display.lattice, cell_at(display.lattice, p.x + d.x * near, p.y + d.y * near), [&](Cell<F> cell) {
        const Mask<F> there = active && extent.holds(cell);
        if (any(there))
            through = through || (there && passes_hole(display, cell, pose_of(display, extent, cell, there), p, d, from, end));
    });
    return through;
}

/// The rules of pass_lens() for a misaligned lens. The hole of its stop lies in the array's frame, moved with the lens but not
/// tilted; a ray may pass the hole of any lens.
template <Facts facts, class F>
struct InMisalignedArray : InArray<Facts{}, F> {
    const LensPose<F> pose;

    LFDSIM_FN Vec2<F> axis() const { return {F(0), F(0)}; }
    LFDSIM_FN Hit<F> meet(int k, const Ray<F>& in_vertex_plane) const {
        return meet_curved<facts>(this->display, k, in_vertex_plane, pose.curvature);
    }

    LFDSIM_FN F wall_bottom() const { return outmost_rim(this->display, false, pose.curvature); }

    /// Removes from `ahead` the rays that pass a hole on a straight part of their path: from `at`, in the lens's frame, z from the
    /// panel, between these path lengths.
    LFDSIM_FN void stop_between(F from, F end, Vec3<F> at, Vec3<F> to, Mask<F>& ahead) const {
        const auto& here = this->display;
        // Back to the array's frame, in which the holes are
        Vec3<F> p{at.x, at.y, at.z - F(here.misaligned.vertex_z)}, d = to;
        if (here.misaligned.tilted) {
            p = pose.turned_out(p);
            d = pose.turned_out(d);
        }
        const Vec2<F> axis = axis_of(here.lattice, this->cell);
        p = {p.x + axis.x + pose.x, p.y + axis.y + pose.y, p.z + pose.z};
        ahead = ahead && !passes_hole(here, this->cell, pose, p, d, from, end);
        if (none(ahead)) return;
        const F near = (F(here.stop_z - here.misaligned.vertex_z) + pose.z - p.z) / d.z;
        const Vec3<F> start = p, along = d;
        ahead = ahead && !passes_any_hole(here, this->extent, start, along, near, from, end, ahead);
    }
};

/// Traces a ray through an ideal lens or a pinhole, by slope + q (1 + e)/f, and through the stop before or after it; passage.ray
/// leaves the lens in the lens's frame.
template <Facts facts, class F>
LFDSIM_FN void pass_thin(const TracedDisplay<Scalar<F>>& display, const InMisalignedArray<facts, F>& rules, const Encounter<F>& met,
                         Passage<F>& passage) {
    const Vec3<F> to = met.entering.to;
    const F fall = F(1) / to.z, power = F(display.ideal_power) * met.pose.curvature;
    const F mx = to.x * fall + met.hit.at.x * power, my = to.y * fall + across(display.lattice, met.hit.at.y) * power;
    const F per = F(1) / sqrt(F(1) + mx * mx + my * my);
    passage.ray = {met.hit.at, {-(mx * per), -(my * per), -per}};
    if (!display.has_stop) return;
    const F endless = F(Scalar<F>(1e30));
    const Vec3<F> at{met.hit.at.x, met.hit.at.y, F(display.ideal_z)};
    Mask<F> ahead = passage.alive;
    rules.stop_between(-endless, F(0), at, to, ahead);
    if (any(ahead)) rules.stop_between(F(0), endless, at, passage.ray.to, ahead);
    passage.alive = passage.alive && !ahead;
}

/// Returns a vector of the frame turned about z alone in the array's frame (`in`), or the reverse. The wedge is a rotation, so its
/// transpose is its inverse.
template <class F>
LFDSIM_FN Vec3<F> wedged(const MisalignedArray<Scalar<F>>& misaligned, bool in, Vec3<F> v) {
    const auto row = [&](int k) {
        const auto of = [&](int l) { return F(in ? misaligned.wedge[l][k] : misaligned.wedge[k][l]); };
        return v.x * of(0) + v.y * of(1) + v.z * of(2);
    };
    return {row(0), row(1), row(2)};
}

/// Returns a ray in the array's frame, z from the vertex plane. `ray` is in the frame turned about z alone and starts at the height
/// of the first vertex, or of the ideal lens.
template <class F>
LFDSIM_FN Ray<F> in_array(const TracedDisplay<Scalar<F>>& display, const PanelBase<Scalar<F>>& base, const Ray<F>& ray) {
    const MisalignedArray<Scalar<F>>& misaligned = display.misaligned;
    const Scalar<F> entrance = display.ideal ? display.ideal_z : display.surface[0].z;
    const Ray<F> here{{ray.at.x, ray.at.y, F((entrance - misaligned.vertex_z) - base.raised)}, ray.to};
    return misaligned.wedged ? Ray<F>{wedged(misaligned, true, here.at), wedged(misaligned, true, here.to)} : here;
}

/// Traces a ray that has left the lenses to the panel. `ray` is in the array's frame, z in mm from the vertex plane; `glued`: the
/// lanes whose rays are already in the top layer.
template <class F>
LFDSIM_FN PanelPoint<F> out_of_array(const TracedDisplay<Scalar<F>>& display, const PanelBase<Scalar<F>>& base, Ray<F> ray,
                                     Mask<F> glued, F weight, Mask<F> alive) {
    const MisalignedArray<Scalar<F>>& misaligned = display.misaligned;
    if (misaligned.wedged) ray = {wedged(misaligned, false, ray.at), wedged(misaligned, false, ray.to)};
    alive = alive && (ray.to.z < F(0));
    ray.at.z = ray.at.z + F(misaligned.vertex_z + base.raised);
    const Vec2<F> end = down_to_panel(display, ray.at, glued, ray.to, weight, alive);
    if (display.emission_exponent != Scalar<F>(0)) weight = weight * power(abs(ray.to.z), display.emission_exponent);
    return panel_point(display, display.lattice, base, Cell<F>{F(0), F(0)}, end.x, end.y, weight, alive);
}

/// Traces rays through a misaligned array to the panel. passage.ray starts in the plane of the first vertices, or of the ideal
/// lens, mm from the base lens's axis. Ends as in trace_opaque().
template <Facts facts, class F>
LFDSIM_FN PanelPoint<F> trace_misaligned(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                                         const PanelBase<Scalar<F>>& base, Passage<F> passage) {
    using S = Scalar<F>;
    const MisalignedArray<S>& misaligned = display.misaligned;
    const Ray<F> ray = in_array(display, base, passage.ray);
    passage.alive = passage.alive && (ray.to.z < F(S(-1e-9)));  // in the array's frame, too, it has to go down
    const Encounter<F> met = enter_misaligned<facts>(display, extent, ray, passage.alive);
    passage.alive = passage.alive && met.hit.ok;
    passage.cell = met.cell;
    passage.ray = met.entering;
    assume<facts>(display);
    const InMisalignedArray<facts, F> rules{{display, extent, passage.cell}, met.pose};
    S plane = display.ideal_z;
    if (holds<facts.ideal>(display.ideal)) {
        pass_thin(display, rules, met, passage);
    } else {
        pass_lens<facts>(display, rules, met.entering, met.hit, passage);
        plane = display.surface[facts.plano_convex == Known::yes ? 1 : display.surface_count - 1].z;
    }
    // From the lens's frame back to the array's
    Vec3<F> at{passage.ray.at.x, passage.ray.at.y, passage.ray.at.z + F(plane - misaligned.vertex_z)}, to = passage.ray.to;
    if (misaligned.tilted) {
        at = met.pose.turned_out(at);
        to = met.pose.turned_out(to);
    }
    const Vec2<F> axis = axis_of(display.lattice, passage.cell);
    at = {at.x + axis.x + met.pose.x, at.y + axis.y + met.pose.y, at.z + met.pose.z};
    PanelPoint<F> point =
        out_of_array(display, base, Ray<F>{at, to}, F(display.glued ? 1 : 0) > F(0), passage.weight, passage.alive);
    point.cell = passage.cell;
    return point;
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
