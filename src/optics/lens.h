// One lens: a ray passes each of its surfaces once, in order, with the aperture stop and the holes of the black part. Floor 1.
//
// Rays go down, from the viewer's side to the panel's. Light that goes up is traced downwards through the lens turned over
// (turned_over() in geometry/prescription.h), its mirror image in the plane of the panel.
#pragma once
#include "optics/facts.h"
#include "optics/lens_array.h"
#include "optics/scene.h"
#include "optics/surface.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A packet of rays on its way through the array.
template <class F>
struct Passage {
    Ray<F> ray;  // from the lens's axis and the surface's vertex
    Cell<F> cell;
    F weight;
    Mask<F> alive;
};

/// The lattice, whose kind is a constant where it is known.
template <Facts facts, class S>
LFDSIM_FN decltype(auto) lattice_of(const Scene<S>& scene) {
    if constexpr (facts.strips == Known::ask || facts.staggered == Known::ask) {
        return (scene.lattice);
    } else {
        Lattice<S> lattice = scene.lattice;
        lattice.strips = facts.strips == Known::yes;
        lattice.staggered = facts.staggered == Known::yes;
        lattice.hexagonal = lattice.hexagonal && lattice.staggered;
        return lattice;
    }
}

/// Tells the compiler what is known where code that is compiled for any display follows. It takes facts one by one only, and
/// forgets them where a function is called.
template <Facts facts, class S>
LFDSIM_FN void assume(const Scene<S>& scene) {
    if (facts.on_air == Known::yes && scene.glued) __builtin_unreachable();
    if (facts.on_air == Known::yes && scene.layer_count != 0) __builtin_unreachable();
    if (facts.staggered == Known::yes && !scene.lattice.staggered) __builtin_unreachable();
    if (facts.staggered == Known::no && scene.lattice.staggered) __builtin_unreachable();
    if (facts.staggered == Known::no && scene.lattice.hexagonal) __builtin_unreachable();
    if (facts.strips == Known::yes && !scene.lattice.strips) __builtin_unreachable();
    if (facts.strips == Known::no && scene.lattice.strips) __builtin_unreachable();
}

/// Surface k, counted from the viewer's side.
template <Facts facts, class S>
LFDSIM_FN Shape shape_of(const Scene<S>& scene, int k) {
    if (facts.plano_convex == Known::yes) return k == 0 ? Shape::sphere : Shape::plane;
    return scene.surface[k].shape;
}

template <class F, class Surface>
LFDSIM_FN Hit<F> meet(Shape shape, const Surface& surface, Ray<F> in_vertex_plane) {
    if (shape == Shape::plane) {
        const Vec3<F> p = in_vertex_plane.at;
        const F cosine = -in_vertex_plane.to.z, r = F(surface.semi_aperture);
        return {p, {F(0), F(0), F(1)}, cosine, cosine * cosine, p.x * p.x + p.y * p.y <= r * r};
    }
    return shape == Shape::sphere ? meet_sphere(surface, in_vertex_plane) : meet_asphere(surface, in_vertex_plane);
}

/// The same surface as a cylinder along y': seen along y', the ray meets its section, and its way is longer by 1/length.
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

/// Surface k.
template <Facts facts, class F>
LFDSIM_FN Hit<F> meet(const Scene<Scalar<F>>& scene, int k, Ray<F> in_vertex_plane) {
    if constexpr (facts.meshed == Known::yes)
        return meet_mesh(scene, k, in_vertex_plane);
    else
        return holds<facts.strips>(scene.lattice.strips) ? meet_cylinder(scene.surface[k].shape, scene.surface[k], in_vertex_plane)
                                                         : meet(shape_of<facts>(scene, k), scene.surface[k], in_vertex_plane);
}

/// Within the walls of its cell? Those of a round lens are its surfaces' semi-apertures, which `ok` has tested.
template <Facts facts, class F>
LFDSIM_FN Mask<F> inside_cell(const Scene<Scalar<F>>& scene, Vec3<F> at, Mask<F> ok) {
    if (facts.plain_light == Known::yes || scene.aperture == Aperture::circle) return ok;
    return ok && in_cell(lattice_of<facts>(scene), at.x, at.y);
}

/// Refracts a ray that comes down from the viewer's side (Snell's law as vectors; total internal reflection ends it).
template <Facts facts, class F>
LFDSIM_FN void refract_down(const Scene<Scalar<F>>& scene, Shape shape, const SurfaceData<Scalar<F>>& surface, const Hit<F>& hit,
                            Passage<F>& way) {
    const F eta = F(surface.media.eta);
    const F cos2 = (F(1) - eta * eta) + (eta * eta) * hit.cos2;
    const F cosine = root(max(cos2, F(0)));
    way.alive = way.alive && (cos2 > F(0));
    const Vec3<F> i = way.ray.to;
    if (shape == Shape::plane) {
        way.ray.to = {eta * i.x, eta * i.y, -cosine};
    } else {
        const F m = eta * hit.cos - cosine;
        way.ray.to = {eta * i.x + m * hit.normal.x, eta * i.y + m * hit.normal.y, eta * i.z + m * hit.normal.z};
    }
    way.ray.at = hit.at;
    const bool vanishes = facts.plano_convex != Known::yes && scene.glued &&
                          surface.media.n_above == surface.media.n_below;  // the lens's medium goes on
    const Fresnel fresnel = facts.schlick == Known::yes ? Fresnel::schlick : scene.fresnel;
    if (fresnel != Fresnel::none && !vanishes) {
        way.weight =
            way.weight * transmittance(fresnel, F(surface.media.schlick_t0), F(surface.media.n_above), F(surface.media.n_below),
                                       hit.cos, cosine, surface.media.n_above < surface.media.n_below ? hit.cos : cosine);
    }
}

/// Rules of pass_lens() for a single lens: its axis at the origin, and a sheet with stops without end.
template <class F>
struct Alone {
    const Scene<Scalar<F>>& scene;

    LFDSIM_FN Place<F> axis() const { return {F(0), F(0)}; }
    LFDSIM_FN Mask<F> passes_stop(Mask<F>, F x, F y) const {
        const Scalar<F> end = Scalar<F>(1e30);
        return optics::passes_stop(scene, Extent<Scalar<F>>{-end, end, -end, end}, x, y);
    }
};

/// The ideal thin lens: slopes (dx/dz, dy/dz) of a ray that has passed it = slopes before + q / f, q the point where it meets the
/// lens, mm from the lens's axis; a strip changes the slope across it alone.
template <class F>
LFDSIM_FN Place<F> bend(const Scene<Scalar<F>>& scene, Place<F> q, Place<F> slope) {
    const F power = F(scene.ideal_power);
    return {slope.x + q.x * power, slope.y + across(scene.lattice, q.y) * power};
}

/// Traces a ray through one lens. `entering` is the ray in the vertex plane of the first surface, in the frame of `rules`; `hit` is
/// where it meets the first surface, relative to the lens's own axis. Afterwards way.ray is on the last surface, relative to that
/// axis and the surface's vertex. A ray that ends on the way has way.alive cleared. `rules` supplies what differs between callers:
///   axis()                                  of the lens, in the frame in which stops are counted;
///   meets(k, ray, hit, from_z, z, way)      `ray`, in the vertex plane of surface k, meets it at height z, after one at from_z:
///                                           clears way.alive of rays outside the aperture;
///   passes_stop(crosses, x, y)              rays of `crosses` cross the plane of the stops: is there a hole?
///   leaves(way)                             called when the last surface has been passed;
///   passes_back(x, y)                       does a ray pass the hole in the black part's lower face?
///   over(alive)                             whether to stop here: a packet goes on, a single ray that has ended need not.
/// Rules of lenses that differ from each other (misaligned.h) have three more:
///   meet(k, ray)                            where a ray in the vertex plane of surface k meets it;
///   stop_between(from, end, at, to, ...)    the stop, in place of passes_stop();
///   wall_bottom()                           where the black part ends.
template <Facts facts, class F, class Rules>
LFDSIM_FN void pass_lens(const Scene<Scalar<F>>& scene, Rules&& rules, const Ray<F>& entering, Hit<F> hit, Passage<F>& way) {
    using S = Scalar<F>;
    const int count = facts.plano_convex == Known::yes ? 2 : scene.surface_count;
    const bool has_stop = facts.plano_convex != Known::yes && scene.has_stop;
    constexpr bool by_itself = requires { rules.stand; };
    // The stop is tested where the ray first crosses its plane: before the first surface or after any. z from the panel.
    Mask<F> stop_ahead = way.alive;
    auto stop_between = [&](F from_z, F to_z, Vec3<F> at, Vec3<F> to, F at_z) {
        if constexpr (by_itself) {
            const F fall = F(1) / to.z;
            return rules.stop_between((from_z - at_z) * fall, (to_z - at_z) * fall, {at.x, at.y, at_z}, to, stop_ahead);
        }
        const Mask<F> crosses = stop_ahead && (from_z >= F(scene.stop_z)) && (to_z <= F(scene.stop_z));
        const F t = (F(scene.stop_z) - at_z) / to.z;
        const Place<F> axis = rules.axis();
        const Mask<F> through = rules.passes_stop(crosses, at.x + to.x * t + axis.x, at.y + to.y * t + axis.y);
        way.alive = way.alive && (through || !crosses);
        stop_ahead = stop_ahead && !crosses;
    };
    const F above_all = F(S(1e30));
    if (has_stop) {
        const Place<F> axis = rules.axis();
        stop_between(above_all, hit.at.z + F(scene.surface[0].z), {entering.at.x - axis.x, entering.at.y - axis.y, F(0)},
                     entering.to, F(scene.surface[0].z));
    }
    rules.meets(0, entering, hit, above_all, hit.at.z + F(scene.surface[0].z), way);
    if (rules.over(way.alive)) return;
    refract_down<facts>(scene, shape_of<facts>(scene, 0), scene.surface[0], hit, way);
    for (int k = 1; k < count; ++k) {
        const SurfaceData<S>&above = scene.surface[k - 1], &surface = scene.surface[k];
        const F t = quotient(F(surface.z - above.z) - way.ray.at.z, way.ray.to.z);  // to its vertex plane
        Ray<F> ray = way.ray;
        ray.at = {ray.at.x + ray.to.x * t, ray.at.y + ray.to.y * t, F(0)};
        if constexpr (by_itself)
            hit = rules.meet(k, ray);
        else
            hit = meet<facts>(scene, k, ray);
        const F from_z = way.ray.at.z + F(above.z), z = hit.at.z + F(surface.z);
        if (has_stop) stop_between(from_z, z, way.ray.at, way.ray.to, from_z);
        rules.meets(k, ray, hit, from_z, z, way);
        // Downwards throughout: a ray turned up, or meeting a surface behind itself, is absorbed.
        way.alive = way.alive && (way.ray.to.z < F(0));
        if (shape_of<facts>(scene, k) != Shape::plane) way.alive = way.alive && (z <= from_z);
        if (rules.over(way.alive)) return;
        refract_down<facts>(scene, shape_of<facts>(scene, k), surface, hit, way);
    }
    const F z = way.ray.at.z + F(scene.surface[count - 1].z);
    if (has_stop) stop_between(z, -above_all, way.ray.at, way.ray.to, z);
    if constexpr (by_itself)
        if (has_stop) way.alive = way.alive && !stop_ahead;
    rules.leaves(way);
    if (shape_of<facts>(scene, count - 1) != Shape::plane) way.alive = way.alive && (way.ray.to.z < F(0));
    if (facts.plano_convex != Known::yes && scene.hollow_back) {  // the way out is the hole in the black part's lower face
        F wall_bottom = F(scene.wall_bottom);
        if constexpr (by_itself) wall_bottom = rules.wall_bottom();
        const F down = (wall_bottom - z) / way.ray.to.z;
        const F x = way.ray.at.x + way.ray.to.x * down, y = way.ray.at.y + way.ray.to.y * down;
        way.alive = way.alive && (rules.passes_back(x, y) || (down < F(0)));
    }
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
