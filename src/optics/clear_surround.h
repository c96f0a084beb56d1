// Clear and plate surrounds: polished glass in air, whose surfaces a ray meets in no fixed order. Floor 1.
//
// Only crossings in the right direction count: from outside a ray can only enter glass, from inside only leave it. A ray that was
// refracted or reflected on a surface can thus not meet it again at once, and no minimum distance is needed. z is measured from the
// panel; x, y from the base lens's axis, in the array's frame; mm.
#pragma once
#include "optics/opaque_surround.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The nearest crossing of a ray among those tested: the path length to it, and the normal there, towards the outside.
template <class F>
struct Crossing {
    F t;
    Vec3<F> normal;
    Cell<F> cell;
    Mask<F> found;

    LFDSIM_FN void take(Mask<F> valid, F path_length, Vec3<F> n, Cell<F> in) {
        const Mask<F> nearer = valid && (path_length < t);
        t = select(nearer, path_length, t);
        normal = choose(nearer, n, normal);
        cell = choose(nearer, in, cell);
        found = found || nearer;
    }
};

/// Tolerance at edges, mm: so close to an edge a ray may meet either face that shares it. It is a length, not a share of the
/// lens: displays scaled by powers of two, whose other numbers round alike, from pitches of 0.1 mm to 500 mm keep all pixels
/// but 1 in 10000, at edges.
template <class F>
LFDSIM_FN F slack() {
    return F(Scalar<F>(sizeof(Scalar<F>) == 4 ? 2e-6 : 1e-11));
}
/// Returns whether a crossing at the path length t is ahead, or so little behind, mm, that the ray starts on it but for rounding.
template <class F>
LFDSIM_FN Mask<F> ahead(F t) {
    return t > F(Scalar<F>(sizeof(Scalar<F>) == 4 ? -1e-4 : -1e-9));
}

/// Returns the root of a t^2 + 2 b t + c = 0 at which the left side rises (`rising`) or falls, free of cancellation, if `real`.
template <class F>
LFDSIM_FN F root(F a, F b, F c, bool rising, Mask<F>& real) {
    const F disc = b * b - a * c;
    real = disc > F(0);
    if (!rising) {
        a = -a;
        b = -b;
        c = -c;
    }
    const F w = sqrt(max(disc, F(0)));
    const Mask<F> far = b < F(0);
    return select(far, w - b, -c) / select(far, a, b + w);
}

/// Returns the path length to where a ray crosses a surface of revolution downwards (against +z) or upwards, if `valid`, and `up`,
/// the unit normal there, towards +z; `at` is relative to the lens's axis and the vertex. Aspheres: the first change of sign of
/// z - sag on the path through the cap's zone, in 32 steps, then bisected.
template <class F, class Surface>
LFDSIM_FN F cross_surface(const Surface& surface, Vec3<F> at, Vec3<F> to, bool downwards, Vec3<F>& up, Mask<F>& valid) {
    using S = Scalar<F>;
    const F c = surface.curvature, k = F(surface.conic), k1 = F(1) + k, r = F(surface.semi_aperture) + slack<F>();
    F t, z, d;
    Mask<F> sheet;
    auto point_at = [&](F length) { return Vec3<F>{at.x + to.x * length, at.y + to.y * length, at.z + to.z * length}; };
    if (surface.shape == Shape::asphere) {
        // The path through the zone between the lowest and the highest point of the cap, widened by the tolerance
        const F low = F(surface.low) - slack<F>(), high = F(surface.high) + slack<F>();
        const F a = (low - at.z) / to.z, b = (high - at.z) / to.z;
        const Mask<F> level = abs(to.z) < F(S(1e-7));
        const F reach = F(4) * F(surface.semi_aperture);
        const F begin = max(select(level, F(0), min(a, b)), F(0)), end = min(select(level, reach, max(a, b)), begin + reach);
        auto height = [&](F path_length) {
            const Vec3<F> p = point_at(path_length);
            sag(surface, p.x * p.x + p.y * p.y, z, d, sheet);
            return downwards ? p.z - z : z - p.z;
        };
        const F step = (end - begin) * F(S(1.0 / 32));
        F left = begin, right = begin;
        Mask<F> found = F(0) > F(1), before = height(begin) > F(0);
        for (int i = 1; i <= 32; ++i) {
            const F next = begin + step * F(S(i)), here = height(next);
            const Mask<F> crosses = (begin <= end) && !found && before && (here <= F(0));
            left = select(crosses, next - step, left);
            right = select(crosses, next, right);
            found = found || crosses;
            before = here > F(0);
        }
        for (int i = 0; i < (sizeof(S) == 4 ? 24 : 52); ++i) {
            const F middle = (left + right) * F(S(0.5));
            const Mask<F> above = height(middle) > F(0);
            left = select(above, middle, left);
            right = select(above, right, middle);
        }
        t = right;
        valid = found;
    } else {
        const F b = c * (at.x * to.x + at.y * to.y + k1 * at.z * to.z) - to.z;
        const F q = c * (at.x * at.x + at.y * at.y + k1 * at.z * at.z) - F(2) * at.z;
        t = root(c * (F(1) + k * to.z * to.z), b, q, downwards, valid);
    }
    const Vec3<F> p = point_at(t);
    const F s2 = p.x * p.x + p.y * p.y;
    sag(surface, s2, z, d, sheet);
    const F per = F(1) / sqrt(F(1) + d * d * s2);
    up = {-(p.x * d * per), -(p.y * d * per), per};
    const F side = dot(up, to);
    valid = valid && sheet && ahead(t) && (s2 <= r * r) && (abs(p.z - z) < F(S(1e-3))) && (downwards ? side < F(0) : side > F(0));
    return t;
}

/// Returns what cross_surface() does, of a surface extruded along y': in projection along y' a ray crosses its section.
template <class F, class Surface>
LFDSIM_FN F cross_cylinder(const Surface& surface, Vec3<F> at, Vec3<F> to, bool downwards, Vec3<F>& up, Mask<F>& valid) {
    const F per = F(1) / sqrt(to.x * to.x + to.z * to.z);
    return per * cross_surface(surface, {at.x, F(0), at.z}, {to.x * per, F(0), to.z * per}, downwards, up, valid);
}

/// Offers `best` the crossing, inwards or outwards, of the top or bottom face of the solid in one cell.
template <class F>
LFDSIM_FN void cross_face(const TracedDisplay<Scalar<F>>& display, bool top, Vec3<F> at, Vec3<F> to, bool inwards, Cell<F> cell,
                          Mask<F> active, Crossing<F>& best) {
    const auto& surface = display.surface[top ? 0 : display.surface_count - 1];
    const Vec2<F> axis = axis_of(display.lattice, cell);
    const Vec3<F> local{at.x - axis.x, at.y - axis.y, at.z - F(surface.z)};
    Vec3<F> up;
    Mask<F> valid;
    const F t = display.lattice.strips ? cross_cylinder(surface, local, to, inwards == top, up, valid)
                                       : cross_surface(surface, local, to, inwards == top, up, valid);
    if (display.aperture == Aperture::cell)
        valid = valid && in_cell(display.lattice, local.x + to.x * t, local.y + to.y * t, slack<F>());
    const F sense = F(Scalar<F>(top ? 1 : -1));
    best.take(active && valid, t, {sense * up.x, sense * up.y, sense * up.z}, cell);
}

/// Returns whether a point of a wall is between the faces of its lens; caps_only: and above the upper or below the lower rim.
template <class F>
LFDSIM_FN Mask<F> between_faces(const TracedDisplay<Scalar<F>>& display, Vec3<F> local, bool caps_only) {
    const auto &top = display.surface[0], &bottom = display.surface[display.surface_count - 1];
    const F y = across(display.lattice, local.y), s2 = local.x * local.x + y * y;
    F high, low, d;
    Mask<F> sheet;
    sag(top, s2, high, d, sheet);
    sag(bottom, s2, low, d, sheet);
    high = high + F(top.z) + slack<F>();
    low = low + F(bottom.z) - slack<F>();
    Mask<F> inside = (local.z <= high) && (local.z >= low);
    if (caps_only) inside = inside && ((local.z >= F(top.z + top.rim)) || (local.z <= F(bottom.z + bottom.rim)));
    return inside;
}

/// Offers `best` the crossings of one cell's walls: a round one, or planes. caps_only: of the walls above and below a plate, at the
/// array's border and where the cap of a neighbour in a staggered row is lower.
template <class F>
LFDSIM_FN void cross_walls(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, Vec3<F> at, Vec3<F> to,
                           bool inwards, Cell<F> cell, Mask<F> active, bool caps_only, Crossing<F>& best) {
    const Vec2<F> from = axis_of(display.lattice, cell);
    const F x = at.x - from.x, y = at.y - from.y, zero = F(0);
    const auto& lattice = display.lattice;
    if (display.aperture == Aperture::circle && !lattice.strips) {
        const F r = F(display.surface[0].semi_aperture), per = F(1) / r;
        Mask<F> real;
        const F t = root(to.x * to.x + to.y * to.y, x * to.x + y * to.y, x * x + y * y - r * r, !inwards, real);
        const Vec3<F> p{x + to.x * t, y + to.y * t, at.z + to.z * t};
        // At this distance from the axis the faces are at their rims, whose sag is known.
        const auto &top = display.surface[0], &bottom = display.surface[display.surface_count - 1];
        const Mask<F> high = (p.z <= F(top.z + top.rim) + slack<F>()) && (p.z >= F(bottom.z + bottom.rim) - slack<F>());
        best.take(active && real && ahead(t) && high, t, {p.x * per, p.y * per, zero}, cell);
        return;
    }
    const F one = F(1);
    for (int pair = 0; pair < border_pairs(lattice); ++pair) {
        const Borders<Scalar<F>> wall = borders(lattice, pair);
        const F half = display.aperture == Aperture::circle ? F(display.surface[0].semi_aperture) : F(wall.half);
        const F nx = F(wall.x), ny = F(wall.y), slope = nx * to.x + ny * to.y;
        const F sign = select(slope < zero, -one, one);  // of the path along the normal
        const F side = inwards ? -sign : sign;           // of the wall that it crosses
        const F t = (side * half - (nx * x + ny * y)) / slope;
        const Vec3<F> p{pair == 0 ? side * half : x + to.x * t, pair == 1 && !lattice.hexagonal ? side * half : y + to.y * t,
                        at.z + to.z * t};
        Mask<F> valid = active && (abs(slope) > F(Scalar<F>(1e-20))) && ahead(t) && in_cell(lattice, p.x, p.y, slack<F>()) &&
                        between_faces(display, p, caps_only);
        if (caps_only) {
            const Cell<F> beyond = cell_beyond(lattice, cell, F(Scalar<F>(pair)), side, p.x + from.x);
            Mask<F> air = !extent.holds(beyond);
            if (lattice.staggered && !lattice.hexagonal) {
                const Vec2<F> axis = axis_of(lattice, beyond);
                const Vec3<F> there{p.x + from.x - axis.x, p.y + from.y - axis.y, p.z};
                air = air || !between_faces(display, there, false);
            }
            valid = valid && air;
        }
        best.take(valid, t, {side * nx, side * ny, zero}, cell);
    }
}

/// A packet of rays among glass.
template <class F>
struct GlassRays {
    Vec3<F> at, to;
    Cell<F> cell;  // of the solid that the ray is in
    Mask<F> inside;
    Mask<F> below;  // plate: outside on the panel's side
};

/// Finds the next crossing in the surround `clear`, of separate solids: rays inside one are tested against its faces and walls,
/// others against those of cells on their path.
template <class F>
LFDSIM_FN void next_in_clear(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const GlassRays<F>& rays,
                             Mask<F> alive, Crossing<F>& best) {
    auto solid = [&](Cell<F> cell, Mask<F> active, bool inwards) {
        cross_face(display, true, rays.at, rays.to, inwards, cell, active, best);
        cross_face(display, false, rays.at, rays.to, inwards, cell, active, best);
        cross_walls(display, extent, rays.at, rays.to, inwards, cell, active, false, best);
        return best.found;
    };
    const Mask<F> within = alive && rays.inside, without = alive && !rays.inside;
    if (any(within)) solid(rays.cell, within, false);
    if (none(without)) return;
    F in, out;
    cross_slab(rays.at.z, rays.to.z, Scalar<F>(1e-12), F(display.body_bottom), F(display.body_top), in, out);
    const F begin = max(in, F(0));
    walk_cells(display, extent, rays.at.x, rays.at.y, rays.to.x, rays.to.y, begin, out, without,
               [&](Cell<F> cell, Mask<F> active) { return solid(cell, active, true) && active; });
}

/// Offers `best` the next crossing of the top or bottom face of a plate, on the flat between the caps or on a cap of the cells on
/// the path through their zone.
template <class F>
LFDSIM_FN void next_on_face(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, bool top, bool inwards,
                            const GlassRays<F>& rays, Mask<F> active, Crossing<F>& best) {
    using S = Scalar<F>;
    const auto& surface = display.surface[top ? 0 : display.surface_count - 1];
    const F sense = F(S(top ? 1 : -1));
    const F flat = (F(surface.z + surface.rim) - rays.at.z) / rays.to.z;
    const Mask<F> right_way = inwards ? sense * rays.to.z < F(0) : sense * rays.to.z > F(0);
    const F x = rays.at.x + rays.to.x * flat, y = rays.at.y + rays.to.y * flat;
    const Cell<F> under = cell_at(display.lattice, x, y);
    Mask<F> in_cap = extent.holds(under);
    if (display.aperture == Aperture::circle) {
        const Vec2<F> axis = axis_of(display.lattice, under);
        const F lx = x - axis.x, ly = across(display.lattice, y - axis.y), r = F(surface.semi_aperture);
        in_cap = in_cap && (lx * lx + ly * ly < r * r);
    }
    if (surface.shape == Shape::plane) in_cap = in_cap && (F(0) > F(1));
    best.take(active && right_way && ahead(flat) && !in_cap, flat, {F(0), F(0), sense}, under);
    if (surface.shape == Shape::plane) return;
    F in, out;
    const F edge = F(S(1e-4));  // mm: the zone's border belongs to it
    cross_slab(rays.at.z, rays.to.z, Scalar<F>(1e-12), F(surface.z + surface.low) - edge, F(surface.z + surface.high) + edge, in,
               out);
    walk_cells(display, extent, rays.at.x, rays.at.y, rays.to.x, rays.to.y, max(in, F(0)), out, active,
               [&](Cell<F> cell, Mask<F> here) {
                   const F before = best.t;
                   cross_face(display, top, rays.at, rays.to, inwards, cell, here, best);
                   if (display.aperture == Aperture::cell)
                       cross_walls(display, extent, rays.at, rays.to, inwards, cell, here, true, best);
                   return here && (best.t < before);
               });
}

/// Finds the next crossing in the surround `plate`, one sheet. Rays outside are above or below it, and meet that face only.
template <class F>
LFDSIM_FN void next_in_plate(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, const GlassRays<F>& rays,
                             Mask<F> alive, Crossing<F>& best) {
    const Mask<F> within = alive && rays.inside, above = alive && !rays.inside && !rays.below,
                  below = alive && !rays.inside && rays.below;
    if (any(within)) {
        next_on_face(display, extent, true, false, rays, within, best);
        next_on_face(display, extent, false, false, rays, within, best);
    }
    if (any(above)) next_on_face(display, extent, true, true, rays, above, best);
    if (any(below)) next_on_face(display, extent, false, true, rays, below, best);
}

/// Refracts rays at a crossing, by t = eta i + (eta c1 - c2) n; where there is total reflection, by t = i + 2 c1 n with weight 1.
template <class F>
LFDSIM_FN void cross(const TracedDisplay<Scalar<F>>& display, const Crossing<F>& here, Mask<F> active, GlassRays<F>& rays,
                     F& weight) {
    const auto& media = display.surface[0].media;
    const auto& last = display.surface[display.surface_count - 1];
    const F air = F(media.n_above), glass = F(media.n_below), one = F(1);
    F outside = air, schlick_t0 = F(media.schlick_t0);
    if (display.glued) {
        outside = select(here.normal.z < F(0), F(last.media.n_below), air);
        schlick_t0 = select(here.normal.z < F(0), F(last.media.schlick_t0), schlick_t0);
    }
    const F n1 = select(rays.inside, glass, outside), n2 = select(rays.inside, outside, glass), eta = n1 / n2;
    const F facing = select(rays.inside, -one, one);  // the normal that faces the ray
    const Vec3<F> n{facing * here.normal.x, facing * here.normal.y, facing * here.normal.z}, i = rays.to;
    const F c1 = -dot(n, i), cos2 = one - eta * eta * (one - c1 * c1), c2 = sqrt(max(cos2, F(0)));
    const Mask<F> reflected = !(cos2 > F(0)), refracted = active && !reflected;
    const F k = select(reflected, one, eta), m = select(reflected, F(2) * c1, eta * c1 - c2);
    const Vec3<F> to{k * i.x + m * n.x, k * i.y + m * n.y, k * i.z + m * n.z};
    if (display.fresnel != Fresnel::none) {
        const F c_thin = select(display.glued ? n2 < n1 : rays.inside, c2, c1);
        weight = select(refracted, weight * transmittance(display.fresnel, schlick_t0, n1, n2, c1, c2, c_thin), weight);
    }
    rays.at = choose(active, {i.x * here.t + rays.at.x, i.y * here.t + rays.at.y, i.z * here.t + rays.at.z}, rays.at);
    rays.to = choose(active, to, i);
    rays.cell = choose(refracted, here.cell, rays.cell);
    // Downwards out of a face, or sideways out of a wall below the slab.
    const Mask<F> down = (here.normal.z < F(0)) || ((here.normal.z == F(0)) && (rays.at.z < F(last.z + last.rim)));
    rays.below = (rays.below && !refracted) || (refracted && rays.inside && down);
    rays.inside = (rays.inside && !refracted) || (refracted && !rays.inside);
}

/// Surfaces at which a path may be refracted or reflected; where it meets one more it is black.
constexpr int most_crossings = 16;

/// Bodies and stops of glass at their lattice positions.
template <class F>
struct InLattice {
    const TracedDisplay<Scalar<F>>& display;
    const Extent<Scalar<F>>& extent;

    LFDSIM_FN void next(const GlassRays<F>& rays, Mask<F> alive, Crossing<F>& next) const {
        if (display.surround == Surround::clear)
            next_in_clear(display, extent, rays, alive, next);
        else
            next_in_plate(display, extent, rays, alive, next);
    }
    /// Ends rays that meet the stop beside its holes within the path length `path_length`.
    LFDSIM_FN void stop(const GlassRays<F>& rays, F path_length, F, Mask<F>& ahead, Mask<F>& alive) const {
        const F t = (F(display.stop_z) - rays.at.z) / rays.to.z;
        const Mask<F> crosses = ahead && (t >= F(0)) && (t <= path_length);
        const Mask<F> through = passes_stop(display, extent, rays.at.x + rays.to.x * t, rays.at.y + rays.to.y * t);
        alive = alive && (through || !crosses);
        ahead = ahead && !crosses;
    }
    LFDSIM_FN void end(Mask<F>, Mask<F>&) const {}
};

/// Follows rays from above all glass until they leave it for good. `arrived`: towards the panel; `in_layer`: of these, into
/// what the glass is glued to.
template <class F, class Bodies>
LFDSIM_FN void pass_glass(const TracedDisplay<Scalar<F>>& display, const Bodies& bodies, GlassRays<F>& rays, F& weight,
                          Mask<F> alive, Mask<F>& arrived, Mask<F>& in_layer) {
    using S = Scalar<F>;
    const Mask<F> no_ray = F(0) > F(1);
    Mask<F> stop_ahead = alive;
    F lowest = rays.at.z;  // that each ray has been
    arrived = in_layer = no_ray;
    const auto& last = display.surface[display.surface_count - 1];
    const bool vanishes = display.glued && last.media.n_above == last.media.n_below;  // the glued face is none
    for (int surfaces = 0; surfaces <= most_crossings && any(alive); ++surfaces) {
        Crossing<F> next{F(S(1e30)), {F(0), F(0), F(1)}, {F(0), F(0)}, F(0) > F(1)};
        bodies.next(rays, alive, next);
        const Mask<F> leaves = alive && !next.found;
        if (display.has_stop) {
            bodies.stop(rays, next.t, lowest, stop_ahead, alive);
            lowest = min(lowest, rays.at.z + rays.to.z * next.t);
        }
        arrived = arrived || (alive && leaves && !rays.inside && (rays.to.z < F(0)));
        alive = alive && next.found;
        const Mask<F> at_glue = display.glued ? alive && rays.inside && (next.normal.z < F(0)) : no_ray;
        if (vanishes) {
            in_layer = in_layer || at_glue;
            alive = alive && !at_glue;
        }
        if (surfaces == most_crossings) break;
        cross(display, next, alive, rays, weight);
        if (display.glued && !vanishes) {
            in_layer = in_layer || (at_glue && !rays.inside);
            alive = alive && !(at_glue && !rays.inside);
        }
    }
    arrived = arrived || in_layer;
    if (display.has_stop) bodies.end(stop_ahead, arrived);
}

/// Traces rays through lenses in a clear or plate surround to the panel, from the vertex plane of the first surfaces.
template <class F>
LFDSIM_FN PanelPoint<F> trace_glass(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                                    const PanelBase<Scalar<F>>& base, Passage<F> passage) {
    using S = Scalar<F>;
    // Start above all lenses.
    const F first = F(display.surface[0].z), up = (F(display.body_top) - first) / passage.ray.to.z;
    const Mask<F> no_ray = F(0) > F(1);
    const Vec3<F>&at = passage.ray.at, &to = passage.ray.to;
    GlassRays<F> rays{{at.x + to.x * up, at.y + to.y * up, F(display.body_top)}, to, {F(0), F(0)}, no_ray, no_ray};
    F weight = passage.weight;
    Mask<F> arrived, in_layer;
    pass_glass(display, InLattice<F>{display, extent}, rays, weight, passage.alive, arrived, in_layer);
    const Vec2<F> end = down_to_panel(display, rays.at, in_layer, rays.to, weight, arrived);
    if (display.emission_exponent != S(0)) weight = weight * power(abs(rays.to.z), display.emission_exponent);
    return panel_point(display, display.lattice, base, {F(0), F(0)}, end.x, end.y, weight, arrived);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
