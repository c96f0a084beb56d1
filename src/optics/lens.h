// One lens: a ray passes each of its surfaces once, in order, with the aperture stop and the holes of the black part. Floor 1.
//
// Rays go down, from the viewer's side to the panel's. Light that goes up is traced downwards through the lens turned over
// (turned_over() in geometry/prescription.h), its mirror image in the plane of the panel.
#pragma once
#include "optics/facts.h"
#include "optics/lens_array.h"
#include "optics/surface.h"
#include "optics/traced_display.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A packet of rays on its path through the array.
template <class F>
struct Passage {
    Ray<F> ray;     // from the lens's axis and the surface's vertex once it has met a lens, before that from the base lens's axis
    Cell<F> cell;   // of the lens that it meets, counted from the base lens
    F weight;       // the share of radiance that is left
    Mask<F> alive;  // the rays that have not ended
};

/// Returns the lattice, with the kind of cells as a compile-time constant where the facts state it.
template <Facts facts, class S>
LFDSIM_FN decltype(auto) lattice_of(const TracedDisplay<S>& display) {
    if constexpr (facts.strips == Known::ask || facts.staggered == Known::ask) {
        return (display.lattice);
    } else {
        Lattice<S> lattice = display.lattice;
        lattice.strips = facts.strips == Known::yes;
        lattice.staggered = facts.staggered == Known::yes;
        lattice.hexagonal = lattice.hexagonal && lattice.staggered;
        return lattice;
    }
}

/// Tells the compiler the facts that hold where code that is compiled for any display follows. The compiler makes use of facts
/// stated one by one only, and forgets them where a function is called.
template <Facts facts, class S>
LFDSIM_FN void assume(const TracedDisplay<S>& display) {
    if (facts.on_air == Known::yes && display.glued) __builtin_unreachable();
    if (facts.on_air == Known::yes && display.layer_count != 0) __builtin_unreachable();
    if (facts.staggered == Known::yes && !display.lattice.staggered) __builtin_unreachable();
    if (facts.staggered == Known::no && display.lattice.staggered) __builtin_unreachable();
    if (facts.staggered == Known::no && display.lattice.hexagonal) __builtin_unreachable();
    if (facts.strips == Known::yes && !display.lattice.strips) __builtin_unreachable();
    if (facts.strips == Known::no && display.lattice.strips) __builtin_unreachable();
}

/// Returns the shape of surface k, counted from 0 on the viewer's side.
template <Facts facts, class S>
LFDSIM_FN Shape shape_of(const TracedDisplay<S>& display, int k) {
    if (facts.plano_convex == Known::yes) return k == 0 ? Shape::sphere : Shape::plane;
    return display.surface[k].shape;
}

/// Intersects rays with a surface of revolution. `in_vertex_plane` starts in the plane of its vertex (at.z = 0, mm from the axis)
/// and goes down; a plane is met at the start.
template <class F, class Surface>
LFDSIM_FN Hit<F> meet(Shape shape, const Surface& surface, Ray<F> in_vertex_plane) {
    if (shape == Shape::plane) {
        const Vec3<F> p = in_vertex_plane.at;
        const F cosine = -in_vertex_plane.to.z, r = F(surface.semi_aperture);
        return {p, {F(0), F(0), F(1)}, cosine, cosine * cosine, p.x * p.x + p.y * p.y <= r * r};
    }
    return shape == Shape::sphere ? meet_sphere(surface, in_vertex_plane) : meet_asphere(surface, in_vertex_plane);
}

/// Intersects rays with a surface that is extruded along y'; they start as those of meet(). In projection along y' a ray meets the
/// section as if that were a surface of revolution: with `length` = sqrt(d_x^2 + d_z^2) the projected direction is divided by it
/// and the cosine of incidence multiplied by it (docs/model.md, "Lens array and surround").
template <class F, class Surface>
LFDSIM_FN Hit<F> meet_cylinder(Shape shape, const Surface& surface, const Ray<F>& in_vertex_plane) {
    const Vec3<F>&at = in_vertex_plane.at, &to = in_vertex_plane.to;
    if (shape == Shape::plane) {
        Hit<F> hit = meet(shape, surface, Ray<F>{{at.x, F(0), F(0)}, to});
        hit.at.y = at.y;
        return hit;
    }
    const F length2 = to.x * to.x + to.z * to.z;
    if (shape == Shape::sphere) return meet_round_cylinder(surface, in_vertex_plane, length2);
    const F length = sqrt(length2), per = F(1) / length;
    Hit<F> hit = meet(shape, surface, Ray<F>{{at.x, F(0), F(0)}, {to.x * per, F(0), to.z * per}});
    hit.at.y = at.y + to.y * (hit.at.z / to.z);
    hit.cos = hit.cos * length;
    hit.cos2 = hit.cos2 * length2;
    return hit;
}

/// Intersects rays with surface k of the display's lens, counted from 0 on the viewer's side, or with its triangles if it is
/// meshed.
template <Facts facts, class F>
LFDSIM_FN Hit<F> meet(const TracedDisplay<Scalar<F>>& display, int k, Ray<F> in_vertex_plane) {
    if constexpr (facts.meshed == Known::yes)
        return meet_mesh(display, k, in_vertex_plane);
    else
        return holds<facts.strips>(display.lattice.strips)
                   ? meet_cylinder(display.surface[k].shape, display.surface[k], in_vertex_plane)
                   : meet(shape_of<facts>(display, k), display.surface[k], in_vertex_plane);
}

/// Returns whether points on a surface lie within the walls of the lens's cell. The walls of a round lens are its surfaces'
/// semi-apertures, which `ok` has tested.
template <Facts facts, class F>
LFDSIM_FN Mask<F> inside_cell(const TracedDisplay<Scalar<F>>& display, Vec3<F> at, Mask<F> ok) {
    if (facts.plain_light == Known::yes || display.aperture == Aperture::circle) return ok;
    return ok && in_cell(lattice_of<facts>(display), at.x, at.y);
}

/// Refracts a ray that comes down from the viewer's side and moves it to the hit; total internal reflection ends it. Snell's law
/// (docs/model.md, "Refraction"): t = eta i + (eta cos - sqrt(1 - eta^2 (1 - cos^2))) n, n towards the viewer's side. The weight is
/// multiplied by the transmittance.
template <Facts facts, class F>
LFDSIM_FN void refract_down(const TracedDisplay<Scalar<F>>& display, Shape shape, const SurfaceData<Scalar<F>>& surface,
                            const Hit<F>& hit, Passage<F>& passage) {
    const F eta = F(surface.media.eta);
    const F cos2 = (F(1) - eta * eta) + (eta * eta) * hit.cos2;  // of the refracted ray
    const F cosine = root(max(cos2, F(0)));
    passage.alive = passage.alive && (cos2 > F(0));
    const Vec3<F> i = passage.ray.to;
    if (shape == Shape::plane) {
        passage.ray.to = {eta * i.x, eta * i.y, -cosine};
    } else {
        const F m = eta * hit.cos - cosine;
        passage.ray.to = {eta * i.x + m * hit.normal.x, eta * i.y + m * hit.normal.y, eta * i.z + m * hit.normal.z};
    }
    passage.ray.at = hit.at;
    // A glued face that borders on a layer of the lens's index has no effect.
    const bool vanishes = facts.plano_convex != Known::yes && display.glued && surface.media.n_above == surface.media.n_below;
    const Fresnel fresnel = facts.schlick == Known::yes ? Fresnel::schlick : display.fresnel;
    if (fresnel != Fresnel::none && !vanishes) {
        passage.weight =
            passage.weight * transmittance(fresnel, F(surface.media.schlick_t0), F(surface.media.n_above), F(surface.media.n_below),
                                           hit.cos, cosine, surface.media.n_above < surface.media.n_below ? hit.cos : cosine);
    }
}

/// Rules of pass_lens() for a single lens: its axis is the origin, and the sheet of stops has a hole in every cell.
template <class F>
struct SingleLens {
    const TracedDisplay<Scalar<F>>& display;

    LFDSIM_FN Vec2<F> axis() const { return {F(0), F(0)}; }
    LFDSIM_FN Mask<F> passes_stop(Mask<F>, F x, F y) const {
        const Scalar<F> end = Scalar<F>(1e30);
        return optics::passes_stop(display, Extent<Scalar<F>>{-end, end, -end, end}, x, y);
    }
};

/// Returns the slope (dx/dz, dy/dz) below an ideal lens of a ray with the slope `slope` above it: slope + q/f, q the point where it
/// meets the lens, mm from the lens's axis (docs/model.md, "Lenses"). A strip changes the slope across it alone.
template <class F>
LFDSIM_FN Vec2<F> bend(const TracedDisplay<Scalar<F>>& display, Vec2<F> q, Vec2<F> slope) {
    const F power = F(display.ideal_power);
    return {slope.x + q.x * power, slope.y + across(display.lattice, q.y) * power};
}

/// Traces a ray through one lens. `entering` is the ray in the vertex plane of the first surface, in the frame of `rules`; `hit` is
/// where it meets the first surface, relative to the axis of that lens. Afterwards passage.ray is on the last surface, relative to
/// that axis and the surface's vertex. A ray that ends inside the lens has passage.alive cleared. `rules` supplies what differs
/// between callers:
///   axis()                                   returns the lens's axis, in the frame in which stops are counted;
///   meets(k, ray, hit, from_z, z, passage)   `ray`, in the vertex plane of surface k, meets it at the height z after the surface
///                                            before at from_z: clears passage.alive of rays outside the aperture;
///   passes_stop(crosses, x, y)               rays of `crosses` cross the plane of the stops: returns whether there is a hole;
///   leaves(passage)                          is called when the last surface has been passed;
///   passes_back(x, y)                        returns whether a ray passes the hole in the black part's lower face;
///   over(alive)                              returns whether to end here: a packet goes on, a single ray that has ended need not.
/// Rules of lenses that differ from each other (misaligned.h) have `pose` and three more:
///   meet(k, ray)                             returns where a ray in the vertex plane of surface k meets it;
///   stop_between(from, end, at, to, ahead)   tests the stop, in place of passes_stop();
///   wall_bottom()                            returns the height at which the black part ends.
template <Facts facts, class F, class Rules>
LFDSIM_FN void pass_lens(const TracedDisplay<Scalar<F>>& display, Rules&& rules, const Ray<F>& entering, Hit<F> hit,
                         Passage<F>& passage) {
    using S = Scalar<F>;
    const int count = facts.plano_convex == Known::yes ? 2 : display.surface_count;
    const bool has_stop = facts.plano_convex != Known::yes && display.has_stop;
    constexpr bool by_itself = requires { rules.pose; };
    // The stop is tested where the ray first crosses its plane: before the first surface or after any. z from the panel.
    Mask<F> stop_ahead = passage.alive;
    auto stop_between = [&](F from_z, F to_z, Vec3<F> at, Vec3<F> to, F at_z) {
        if constexpr (by_itself) {
            const F fall = F(1) / to.z;
            return rules.stop_between((from_z - at_z) * fall, (to_z - at_z) * fall, {at.x, at.y, at_z}, to, stop_ahead);
        }
        const Mask<F> crosses = stop_ahead && (from_z >= F(display.stop_z)) && (to_z <= F(display.stop_z));
        const F t = (F(display.stop_z) - at_z) / to.z;
        const Vec2<F> axis = rules.axis();
        const Mask<F> through = rules.passes_stop(crosses, at.x + to.x * t + axis.x, at.y + to.y * t + axis.y);
        passage.alive = passage.alive && (through || !crosses);
        stop_ahead = stop_ahead && !crosses;
    };
    // The first surface; the path to it begins above all lenses.
    const F above_all = F(S(1e30));
    if (has_stop) {
        const Vec2<F> axis = rules.axis();
        stop_between(above_all, hit.at.z + F(display.surface[0].z), {entering.at.x - axis.x, entering.at.y - axis.y, F(0)},
                     entering.to, F(display.surface[0].z));
    }
    rules.meets(0, entering, hit, above_all, hit.at.z + F(display.surface[0].z), passage);
    if (rules.over(passage.alive)) return;
    refract_down<facts>(display, shape_of<facts>(display, 0), display.surface[0], hit, passage);
    // The further surfaces: to the vertex plane, on to the surface, and through it
    for (int k = 1; k < count; ++k) {
        const SurfaceData<S>&above = display.surface[k - 1], &surface = display.surface[k];
        const F t = quotient(F(surface.z - above.z) - passage.ray.at.z, passage.ray.to.z);  // to its vertex plane
        Ray<F> ray = passage.ray;
        ray.at = {ray.at.x + ray.to.x * t, ray.at.y + ray.to.y * t, F(0)};
        if constexpr (by_itself)
            hit = rules.meet(k, ray);
        else
            hit = meet<facts>(display, k, ray);
        const F from_z = passage.ray.at.z + F(above.z), z = hit.at.z + F(surface.z);
        if (has_stop) stop_between(from_z, z, passage.ray.at, passage.ray.to, from_z);
        rules.meets(k, ray, hit, from_z, z, passage);
        // Downwards throughout: a ray turned up, or meeting a surface behind itself, is absorbed.
        passage.alive = passage.alive && (passage.ray.to.z < F(0));
        if (shape_of<facts>(display, k) != Shape::plane) passage.alive = passage.alive && (z <= from_z);
        if (rules.over(passage.alive)) return;
        refract_down<facts>(display, shape_of<facts>(display, k), surface, hit, passage);
    }
    // Below the last surface: a stop there, and the hole of a concave back
    const F z = passage.ray.at.z + F(display.surface[count - 1].z);
    if (has_stop) stop_between(z, -above_all, passage.ray.at, passage.ray.to, z);
    if constexpr (by_itself)
        if (has_stop) passage.alive = passage.alive && !stop_ahead;
    rules.leaves(passage);
    if (shape_of<facts>(display, count - 1) != Shape::plane) passage.alive = passage.alive && (passage.ray.to.z < F(0));
    if (facts.plano_convex != Known::yes && display.concave_back) {  // rays leave through the hole in the black part's lower face
        F wall_bottom = F(display.wall_bottom);
        if constexpr (by_itself) wall_bottom = rules.wall_bottom();
        const F down = (wall_bottom - z) / passage.ray.to.z;
        const F x = passage.ray.at.x + passage.ray.to.x * down, y = passage.ray.at.y + passage.ray.to.y * down;
        passage.alive = passage.alive && (rules.passes_back(x, y) || (down < F(0)));
    }
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
