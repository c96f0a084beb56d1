// The main idea on one page: a backward ray goes from the camera through the diffuser and the lens array to a panel pixel. Floor 1.
#pragma once
#include "optics/camera.h"
#include "optics/diffuser.h"
#include "optics/glass.h"
#include "optics/ideal.h"
#include "optics/placed.h"
#include "optics/placed_plate.h"
#include "optics/sequential.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The ways through an array, one of which a display uses: chosen outside the loop over samples, so that none pays for another.
/// Five are for plano-convex lenses: in rows and columns, with plain light (for_plain_facts) by any of Fresnel's equations or by
/// Schlick's, or with all kinds of light; as strips; in staggered rows. The next two are for rows and columns; all these with air
/// under them. `glass` is for light between the lenses; three are for arrays with errors, of which two do what `plano_convex` and
/// `opaque` do without; `other` is for the rest. A new one takes a name here, a line in each of the functions below, and a function
/// that traces it. `any` is all of them: it asks for the display's at each packet of rays, so that code around few rays is compiled
/// once.
enum class Way {
    plain,
    plain_schlick,
    plano_convex,
    strips,
    staggered,
    opaque,
    ideal,
    glass,
    placed_plano_convex,
    placed_opaque,
    placed,
    other,
    any
};

LFDSIM_BOTH constexpr bool is_plain(Way way) { return way == Way::plain || way == Way::plain_schlick; }

template <class S>
LFDSIM_FN Way way_through(const Scene<S>& scene) {
    const bool rows = !scene.lattice.strips && !scene.lattice.staggered, on_air = !scene.glued && scene.layer_count == 0;
    const bool plano_convex = scene.surface_count == 2 && scene.surface[0].shape == Shape::sphere &&
                              scene.surface[1].shape == Shape::plane && !scene.has_stop && !scene.dimple;
    if (scene.placement.given) {
        if (scene.thin || scene.surround != Surround::opaque || !on_air || !rows) return Way::placed;
        return plano_convex ? Way::placed_plano_convex : Way::placed_opaque;
    }
    if (!scene.thin && scene.surround != Surround::opaque) return Way::glass;
    if (!on_air) return Way::other;
    if (scene.thin) return rows ? Way::ideal : Way::other;
    if (plano_convex && rows) {
        bool all = true;
        for_plain_facts(scene, [&](bool holds) { all = all && holds; });
        return !all ? Way::plano_convex : scene.fresnel == Fresnel::schlick ? Way::plain_schlick : Way::plain;
    }
    if (plano_convex) return scene.lattice.strips ? Way::strips : Way::staggered;
    return rows ? Way::opaque : Way::other;
}

/// The way that code is compiled for: that of the display, or, where LFDSIM_FEW_WAYS says so, the general one that has its bits.
/// The others only know more of the display while they are compiled. The plain ones are worth their code on a GPU alone
/// (LFDSIM_PLAIN_WAYS).
constexpr Way compiled(Way way) {
#ifdef LFDSIM_PLAIN_WAYS
    if (is_plain(way)) return way;
#else
    if (is_plain(way)) way = Way::plano_convex;
#endif
#ifdef LFDSIM_FEW_WAYS
    if (way == Way::placed_plano_convex || way == Way::placed_opaque) return Way::placed;
    return way == Way::glass || way == Way::placed ? way : Way::other;
#else
    return way;
#endif
}

/// do_it.operator()<way>() for the way through a display.
template <class S, class Do>
inline decltype(auto) with_way(const Scene<S>& scene, const Do& do_it) {
    switch (way_through(scene)) {
        case Way::plain:
            return do_it.template operator()<compiled(Way::plain)>();
        case Way::plain_schlick:
            return do_it.template operator()<compiled(Way::plain_schlick)>();
        case Way::plano_convex:
            return do_it.template operator()<compiled(Way::plano_convex)>();
        case Way::strips:
            return do_it.template operator()<compiled(Way::strips)>();
        case Way::staggered:
            return do_it.template operator()<compiled(Way::staggered)>();
        case Way::opaque:
            return do_it.template operator()<compiled(Way::opaque)>();
        case Way::ideal:
            return do_it.template operator()<compiled(Way::ideal)>();
        case Way::glass:
            return do_it.template operator()<compiled(Way::glass)>();
        case Way::placed_plano_convex:
            return do_it.template operator()<compiled(Way::placed_plano_convex)>();
        case Way::placed_opaque:
            return do_it.template operator()<compiled(Way::placed_opaque)>();
        case Way::placed:
            return do_it.template operator()<compiled(Way::placed)>();
        case Way::other:
        case Way::any:
            break;
    }
    return do_it.template operator()<Way::other>();
}

/// do_it.operator()<way>() for a way that is known while the code is compiled, or `any`.
template <Way through, class S, class Do>
LFDSIM_FN decltype(auto) by_way(const Scene<S>& scene, const Do& do_it) {
    if constexpr (through == Way::any)
        return with_way(scene, do_it);
    else
        return do_it.template operator()<through>();
}

/// do_it.operator()<way>() for all ways that code is compiled for, one after the other (some several times, where it is for few).
template <class Do>
inline void for_all_ways(const Do& do_it) {
    do_it.template operator()<compiled(Way::plain)>();
    do_it.template operator()<compiled(Way::plain_schlick)>();
    do_it.template operator()<compiled(Way::plano_convex)>();
    do_it.template operator()<compiled(Way::strips)>();
    do_it.template operator()<compiled(Way::staggered)>();
    do_it.template operator()<compiled(Way::opaque)>();
    do_it.template operator()<compiled(Way::ideal)>();
    do_it.template operator()<compiled(Way::glass)>();
    do_it.template operator()<compiled(Way::placed_plano_convex)>();
    do_it.template operator()<compiled(Way::placed_opaque)>();
    do_it.template operator()<compiled(Way::placed)>();
    do_it.template operator()<Way::other>();
}

// to_first_vertex() and sample_ray() return their result in the last argument: GCC 12 passes a returned value through memory, with
// half as many instructions again.

/// Moves a ray in the first plane, with its direction after the diffuser, to the vertex plane of the first surfaces, and turns its
/// direction into the array's frame.
template <bool plain = false, class F>
LFDSIM_FN void to_first_vertex(const Scene<Scalar<F>>& scene, Passage<F>& way) {
    using S = Scalar<F>;
    Vec3<F>&at = way.ray.at, &to = way.ray.to;
    way.alive = way.alive && (to.z < F(S(-1e-9)));
    if (!plain && scene.rotated) {
        const Place<F> turned = to_array(scene.lattice, to.x, to.y);
        to.x = turned.x;
        to.y = turned.y;
    }
    if (plain || scene.start_above != S(0)) {
        const F t = quotient(F(-scene.start_above), to.z);
        at.x = at.x + to.x * t;
        at.y = at.y + to.y * t;
    }
}

/// trace_array() by the display's way.
template <class F>
inline PanelPoint<F> trace_any(const Scene<Scalar<F>>&, const Extent<Scalar<F>>&, const PanelBase<Scalar<F>>&, const Ray<F>&,
                               const Mask<F>& alive);

/// From the first plane, where the ray starts with its direction after the diffuser, to the panel.
template <Way through, class F>
LFDSIM_FN PanelPoint<F> trace_array(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent,
                                    const PanelBase<Scalar<F>>& base, Ray<F> ray, Mask<F> alive) {
    if constexpr (through == Way::any) return trace_any<F>(scene, extent, base, ray, alive);
    constexpr bool plano_convex = through == Way::plano_convex || through == Way::placed_plano_convex,
                   in_rows = through == Way::opaque || through == Way::ideal || through == Way::placed_opaque;
    constexpr Shapes shapes = through == Way::plain           ? Shapes::plain
                              : through == Way::plain_schlick ? Shapes::plain_schlick
                              : plano_convex                  ? Shapes::plano_convex
                              : through == Way::strips        ? Shapes::plano_convex_strips
                              : through == Way::staggered     ? Shapes::plano_convex_staggered
                              : in_rows                       ? Shapes::any
                                                              : Shapes::all;
    assume<shapes>(scene);
    Passage<F> way{ray, {F(0), F(0)}, F(1), alive};
    to_first_vertex<is_plain(through)>(scene, way);
    if constexpr (through == Way::glass) {
        return trace_glass(scene, extent, base, way);
    } else if constexpr (through == Way::placed_plano_convex || through == Way::placed_opaque) {
        return trace_placed<shapes>(scene, extent, base, way);
    } else if constexpr (through == Way::placed) {
        if (!scene.thin && scene.surround != Surround::opaque) return trace_placed_plate(scene, extent, base, way);
        return trace_placed<shapes>(scene, extent, base, way);
    } else if constexpr (through == Way::ideal) {
        return trace_ideal(scene, extent, base, way);
    } else {
        if (through == Way::other && scene.thin) return trace_ideal(scene, extent, base, way);
        return trace_opaque<shapes>(scene, extent, base, way);
    }
}

/// trace_array(), compiled as a function of its own.
template <Way through, class F>
LFDSIM_APART PanelPoint<F> trace_apart(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent,
                                       const PanelBase<Scalar<F>>& base, const Ray<F>& ray, const Mask<F>& alive) {
    return trace_array<through>(scene, extent, base, ray, alive);
}

template <class F>
inline PanelPoint<F> trace_any(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, const PanelBase<Scalar<F>>& base,
                               const Ray<F>& ray, const Mask<F>& alive) {
    return with_way(scene, [&]<Way through>() { return trace_apart<through, F>(scene, extent, base, ray, alive); });
}

/// The ray of one sample of each pixel of a packet, in the first plane and after the diffuser; sampler(d) is the sample's number of
/// dimension d, in [-1, 1]. `plain` promises for_plain_facts().
template <bool plain = false, class F, class Samples>
LFDSIM_FN void sample_ray(const Scene<Scalar<F>>& scene, const View& view, const PixelRays<F>& pixels, const Samples& sampler,
                          Ray<F>& ray) {
    ray = {{pixels.x, pixels.y, F(0)}, pixels.to};
    if (!plain && (scene.box_filter || scene.thin_lens)) {
        F jitter_x = F(0), jitter_y = F(0), lens_x = F(0), lens_y = F(0);
        if (scene.box_filter) {
            jitter_x = sampler(2);
            jitter_y = sampler(3);
        }
        if (scene.thin_lens) disk(sampler(4), sampler(5), lens_x, lens_y);
        const PixelRays<F> centres = pixels;  // a copy, so that the original may stay in registers
        ray = displaced(view, centres, jitter_x, jitter_y, lens_x, lens_y);
    }
    if (plain || scene.has_diffuser) ray.to = scatter<plain>(scene, ray.to, sampler(0), sampler(1));
}

/// The panel pixel that one sample of each pixel reaches.
template <Way through, class F, class Samples>
LFDSIM_FN PanelHit<F> trace(const Scene<Scalar<F>>& scene, const View& view, const PixelRays<F>& pixels, const Samples& sampler) {
    Ray<F> ray;
    sample_ray<is_plain(through)>(scene, view, pixels, sampler, ray);
    const PanelPoint<F> point = trace_array<through>(scene, pixels.extent, pixels.base, ray, pixels.alive);
    return panel_pixel<is_plain(through)>(scene, pixels.base, point);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
