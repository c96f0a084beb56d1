// A moulded sheet with misaligned caps: its glass is the slab between the lenses' rims and what is under each cap
// together, down to the slab. Caps are moved and curved, not turned. docs/model.md, "Errors". Floor 1.
//
// In the array's frame, x and y from the base lens's vertex, z from the panel.
#pragma once
#include "optics/clear_surround.h"
#include "optics/misaligned.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The bodies and stops of a misaligned plate, as pass_glass() takes them. A "lens" is a cell; `top` chooses the sheet's
/// viewer-side face, else its panel-side one, whose caps hang down from the slab.
template <class F>
struct MovedCaps {
    const TracedDisplay<Scalar<F>>& display;
    const Extent<Scalar<F>>& extent;

    using S = Scalar<F>;

    LFDSIM_FN const SurfaceData<S>& face(bool top) const { return display.surface[top ? 0 : display.surface_count - 1]; }

    /// Returns (x, y), which is from the base lens's axis, from the axis of a lens with this pose.
    LFDSIM_FN Vec2<F> from_axis(Cell<F> lens, const LensPose<F>& pose, F x, F y) const {
        const Vec2<F> axis = axis_of(display.lattice, lens);
        return {x - axis.x - pose.x, y - axis.y - pose.y};
    }
    /// Returns whether a point, from a lens's axis, is within its cap's outline, widened by `margin` mm.
    LFDSIM_FN Mask<F> in_aperture(const SurfaceData<S>& surface, Vec2<F> at, F margin) const {
        const F y = across(display.lattice, at.y), r = F(surface.semi_aperture) + margin;
        const Mask<F> round = at.x * at.x + y * y <= r * r;
        return display.aperture == Aperture::cell ? round && in_cell(display.lattice, at.x, at.y, margin) : round;
    }
    /// Returns whether a cell's corners lie within the semi-aperture. Those of an array that is stretched by an error may not.
    LFDSIM_FN bool holds_cell(const SurfaceData<S>& surface) const {
        const CellCorners<S> cell = corners_of_cell(display.lattice);
        return cell.x[0] * cell.x[0] + cell.y[0] * cell.y[0] <= surface.semi_aperture * surface.semi_aperture;
    }
    /// Returns the height of a lens's cap over the panel at a point from its axis.
    LFDSIM_FN F cap(const SurfaceData<S>& surface, const LensPose<F>& pose, Vec2<F> at) const {
        const F y = across(display.lattice, at.y);
        F z, slope;
        Mask<F> sheet;
        sag(CurvedSurface<F>(surface, pose.curvature), at.x * at.x + y * y, z, slope, sheet);
        return z + F(surface.z) + pose.z;
    }

    /// Returns whether a point is within the glass under the cap of a lens other than `but`, and not on its border.
    LFDSIM_RARE Mask<F> covered(bool top, Vec3<F> p, Cell<F> but, Mask<F> active) const {
        const auto& surface = face(top);
        const F sense = F(S(top ? 1 : -1));
        Mask<F> under = F(0) > F(1);
        around(display.lattice, cell_at(display.lattice, p.x, p.y), [&](Cell<F> lens) {
            const Mask<F> there = active && extent.holds(lens) && !((lens.i == but.i) && (lens.j == but.j));
            if (none(there)) return;
            const LensPose<F> pose = pose_of(display, extent, lens, there);
            const Vec2<F> at = from_axis(lens, pose, p.x, p.y);
            under =
                under || (there && in_aperture(surface, at, -slack<F>()) && (sense * (cap(surface, pose, at) - p.z) > slack<F>()));
        });
        return under;
    }

    /// Offers `best` the crossings, inwards or outwards, of the upright sides of the glass under a lens's cap, beyond the slab.
    LFDSIM_FN void sides(bool top, bool inwards, const GlassRays<F>& rays, Cell<F> lens, const LensPose<F>& pose, Mask<F> active,
                         Crossing<F>& best) const {
        const auto& surface = face(top);
        const F sense = F(S(top ? 1 : -1)), flat = F(surface.z + surface.rim), zero = F(0), one = F(1),
                outside = F(S(sizeof(S) == 4 ? 1e-4 : 1e-9));
        const Vec2<F> from = from_axis(lens, pose, rays.at.x, rays.at.y);
        const Vec3<F> to = rays.to;
        const auto offer = [&](Mask<F> valid, F t, Vec3<F> normal, Vec2<F> at) {
            const F z = rays.at.z + to.z * t;
            valid = active && valid && ahead(t) && (sense * (z - flat) >= -slack<F>()) &&
                    (sense * (cap(surface, pose, at) - z) >= -slack<F>());
            if (!inwards && any(valid)) {  // just outside: of caps that touch there is one glass
                const F x = rays.at.x + to.x * t + outside * normal.x, y = rays.at.y + to.y * t + outside * normal.y;
                valid = valid && !covered(top, {x, y, z}, lens, valid);
            }
            best.take(valid, t, normal, lens);
        };
        // A round side, at the semi-aperture: of round lenses, and of cells whose corners lie beyond it
        const bool fills = display.aperture == Aperture::cell;
        if (!display.lattice.strips && !(fills && holds_cell(surface))) {
            const F r = F(surface.semi_aperture), per = one / r;
            Mask<F> real;
            const F t = root(to.x * to.x + to.y * to.y, from.x * to.x + from.y * to.y, from.x * from.x + from.y * from.y - r * r,
                             !inwards, real);
            const Vec2<F> at{from.x + to.x * t, from.y + to.y * t};
            offer(real && in_aperture(surface, at, slack<F>()), t, {at.x * per, at.y * per, zero}, at);
        }
        if (!display.lattice.strips && !fills) return;
        // Plane sides, at the cell's borders or at a strip's edges
        for (int pair = 0; pair < border_pairs(display.lattice); ++pair) {
            const Borders<S> wall = borders(display.lattice, pair);
            const S r = surface.semi_aperture, half_width = display.lattice.strips && (!fills || r < wall.half) ? r : wall.half;
            const F half = F(half_width), nx = F(wall.x), ny = F(wall.y), slope = nx * to.x + ny * to.y;
            const F sign = select(slope < zero, -one, one), side = inwards ? -sign : sign;
            const F t = (side * half - (nx * from.x + ny * from.y)) / slope;
            const Vec2<F> at{from.x + to.x * t, from.y + to.y * t};
            offer((abs(slope) > F(S(1e-20))) && in_aperture(surface, at, slack<F>()), t, {side * nx, side * ny, zero}, at);
        }
    }

    /// Offers `best` the next crossing of the sheet's top or bottom: on the flat, on a cap or at a cap's side. Glass of several
    /// caps overlaps, so a crossing outwards counts only where no other cap covers it.
    LFDSIM_FN void next_on_face(bool top, bool inwards, const GlassRays<F>& rays, Mask<F> active, Crossing<F>& best) const {
        const auto& surface = face(top);
        const F sense = F(S(top ? 1 : -1)), flat = F(surface.z + surface.rim), nothing = F(S(-1e9));
        // On the flat, where no cap covers it
        const F t = (flat - rays.at.z) / rays.to.z;
        Mask<F> on_flat = active && (inwards ? sense * rays.to.z < F(0) : sense * rays.to.z > F(0)) && ahead(t);
        const bool plane = surface.shape == Shape::plane;
        if (!plane && any(on_flat))
            on_flat =
                on_flat && !covered(top, {rays.at.x + rays.to.x * t, rays.at.y + rays.to.y * t, flat}, {nothing, nothing}, on_flat);
        best.take(on_flat, t, {F(0), F(0), sense}, Cell<F>{F(0), F(0)});
        if (plane) return;
        // The caps of all cells near the path through the zone of caps, which reaches as high and low as the errors move them
        const MisalignedArray<S>& misaligned = display.misaligned;
        const S edge = S(1e-4);  // mm: the zone's border belongs to it
        const S low = surface.z + min(surface.low, surface.rim) + (misaligned.lowest < 0 ? misaligned.lowest : S(0)) - edge,
                high = surface.z + max(surface.high, surface.rim) + (misaligned.highest > 0 ? misaligned.highest : S(0)) + edge;
        F in, out;
        cross_slab(rays.at.z, rays.to.z, Scalar<F>(1e-12), F(low), F(high), in, out);
        in = max(in, F(0));
        const Extent<S> wider{extent.low_i - 1, extent.high_i + 1, extent.low_j - 1, extent.high_j + 1};
        const F r2 = F(misaligned.radius * misaligned.radius), across_to = across(display.lattice, rays.to.y),
                length2 = max(rays.to.x * rays.to.x + across_to * across_to, F(S(1e-20)));
        walk_cells(display, wider, rays.at.x, rays.at.y, rays.to.x, rays.to.y, in, out, active, [&](Cell<F> cell, Mask<F> here) {
            around(display.lattice, cell, [&](Cell<F> lens) {
                // Only lenses whose axis is nearer than their radius to the path: s is the path length at the nearest point
                const Vec2<F> axis = axis_of(display.lattice, lens);
                const F dx = axis.x - rays.at.x, dy = across(display.lattice, axis.y - rays.at.y);
                const F s = min(max((dx * rays.to.x + dy * across_to) / length2, in), out);
                const F ex = dx - rays.to.x * s, ey = dy - across_to * s;
                const Mask<F> near = here && extent.holds(lens) && (ex * ex + ey * ey <= r2);
                if (none(near)) return;
                // Where it crosses the lens's cap, in its aperture and beyond the slab, and the sides below the cap
                const LensPose<F> pose = pose_of(display, extent, lens, near);
                const Vec2<F> from = from_axis(lens, pose, rays.at.x, rays.at.y);
                const Vec3<F> local{from.x, from.y, rays.at.z - F(surface.z) - pose.z};
                const CurvedSurface<F> curved(surface, pose.curvature);
                Vec3<F> up;
                Mask<F> valid;
                const F path_length = display.lattice.strips ? cross_cylinder(curved, local, rays.to, inwards == top, up, valid)
                                                             : cross_surface(curved, local, rays.to, inwards == top, up, valid);
                const Vec3<F> p{rays.at.x + rays.to.x * path_length, rays.at.y + rays.to.y * path_length,
                                rays.at.z + rays.to.z * path_length};
                valid = near && valid &&
                        in_aperture(surface, {from.x + rays.to.x * path_length, from.y + rays.to.y * path_length}, slack<F>()) &&
                        (sense * (p.z - flat) >= -slack<F>());
                if (!inwards && any(valid)) valid = valid && !covered(top, p, lens, valid);
                best.take(valid, path_length, {sense * up.x, sense * up.y, sense * up.z}, lens);
                sides(top, inwards, rays, lens, pose, near, best);
            });
            return F(0) > F(1);
        });
    }

    // The rules of pass_glass().

    LFDSIM_FN void next(const GlassRays<F>& rays, Mask<F> alive, Crossing<F>& next) const {
        const Mask<F> within = alive && rays.inside, above = alive && !rays.inside && !rays.below,
                      below = alive && !rays.inside && rays.below;
        if (any(within)) {
            next_on_face(true, false, rays, within, next);
            next_on_face(false, false, rays, within, next);
        }
        if (any(above)) next_on_face(true, true, rays, above, next);
        if (any(below)) next_on_face(false, true, rays, below, next);
    }
    /// Removes from `ahead` the rays that go down through a hole within the path length `path_length`, below the lowest height that
    /// they have reached: one that comes back up has met the black beside that hole.
    LFDSIM_FN void stop(const GlassRays<F>& rays, F path_length, F lowest, Mask<F>& ahead, Mask<F>&) const {
        const Vec3<F> at{rays.at.x, rays.at.y, rays.at.z - F(display.misaligned.vertex_z)}, to = rays.to;
        const F near = (F(display.stop_z) - rays.at.z) / to.z, start = max((lowest - rays.at.z) / to.z, F(0));
        const Mask<F> down = ahead && (to.z < F(0));
        if (any(down)) ahead = ahead && !passes_any_hole(display, extent, at, to, near, start, path_length, down);
    }
    /// Ends the rays that have passed no hole.
    LFDSIM_FN void end(Mask<F> ahead, Mask<F>& arrived) const { arrived = arrived && !ahead; }
};

/// Traces rays through a moulded plate with misaligned lenses to the panel. passage.ray starts in the plane of the first vertices,
/// mm from the base lens's axis, in the frame turned about z alone.
template <class F>
LFDSIM_FN PanelPoint<F> trace_misaligned_plate(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                                               const PanelBase<Scalar<F>>& base, const Passage<F>& passage) {
    using S = Scalar<F>;
    const MisalignedArray<S>& misaligned = display.misaligned;
    const Ray<F> ray = in_array(display, base, passage.ray);
    const Mask<F> no_ray = F(0) > F(1), alive = passage.alive && (ray.to.z < F(S(-1e-9)));
    // Start above all caps and holes of stops, which lie in the vertex plane of the highest cap, too.
    const S above = S(1e-3), top = display.body_top + (misaligned.highest > 0 ? misaligned.highest : S(0)) + above;
    const F up = (F(top - misaligned.vertex_z) - ray.at.z) / ray.to.z;
    GlassRays<F> rays{{ray.at.x + ray.to.x * up, ray.at.y + ray.to.y * up, F(top)}, ray.to, {F(0), F(0)}, no_ray, no_ray};
    F weight = passage.weight;
    Mask<F> arrived, in_layer;
    pass_glass(display, MovedCaps<F>{display, extent}, rays, weight, alive, arrived, in_layer);
    const Vec3<F> leaves{rays.at.x, rays.at.y, rays.at.z - F(misaligned.vertex_z)};
    return out_of_array(display, base, Ray<F>{leaves, rays.to}, in_layer, weight, arrived);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
