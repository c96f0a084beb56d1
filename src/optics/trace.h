// The main idea on one page: a backward ray goes from the camera through the diffuser and the lens array to a panel pixel. Floor 1.
#pragma once
#include "optics/camera.h"
#include "optics/clear_surround.h"
#include "optics/diffuser.h"
#include "optics/ideal.h"
#include "optics/misaligned.h"
#include "optics/misaligned_plate.h"
#include "optics/opaque_surround.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

// to_first_vertex() and sample_ray() return their result in the last argument: GCC 12 passes a returned value through memory, with
// half as many instructions again.

/// Moves a ray in the first plane, with its direction after the diffuser, to the vertex plane of the first surfaces, and turns its
/// direction into the array's frame (its position is in that frame already). Ends rays that do not go down.
template <Facts facts = Facts{}, class F>
LFDSIM_FN void to_first_vertex(const TracedDisplay<Scalar<F>>& display, Passage<F>& passage) {
    using S = Scalar<F>;
    constexpr bool plain = facts.plain_light == Known::yes;
    Vec3<F>&at = passage.ray.at, &to = passage.ray.to;
    passage.alive = passage.alive && (to.z < F(S(-1e-9)));
    if (!plain && display.rotated) {
        const Vec2<F> turned = to_array(display.lattice, to.x, to.y);
        to.x = turned.x;
        to.y = turned.y;
    }
    if (plain || display.start_above != S(0)) {
        const F t = quotient(F(-display.start_above), to.z);
        at.x = at.x + to.x * t;
        at.y = at.y + to.y * t;
    }
}

/// Traces a ray to the panel. It starts in the first plane, x and y in mm from the base lens's axis in the array's frame, with its
/// direction after the diffuser in the display's. The weight of the result is the product of all transmittances, times cos^m of the
/// angle at the panel, m the emission exponent.
template <Facts facts, class F>
LFDSIM_FN PanelPoint<F> trace_array(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                                    const PanelBase<Scalar<F>>& base, Ray<F> ray, Mask<F> alive) {
    assume<facts>(display);
    Passage<F> passage{ray, {F(0), F(0)}, F(1), alive};
    to_first_vertex<facts>(display, passage);
    if constexpr (facts.misaligned != Known::no)
        if (holds<facts.misaligned>(display.misaligned.given)) {
            if constexpr (facts.lit_between != Known::no)
                if (is_lit_between(display)) return trace_misaligned_plate(display, extent, base, passage);
            return trace_misaligned<facts>(display, extent, base, passage);
        }
    if constexpr (facts.lit_between != Known::no)
        if (holds<facts.lit_between>(is_lit_between(display))) return trace_glass(display, extent, base, passage);
    if constexpr (facts.ideal != Known::no)
        if (holds<facts.ideal>(display.ideal)) return trace_ideal(display, extent, base, passage);
    return trace_opaque<facts>(display, extent, base, passage);
}

/// Does what trace_array() does, compiled as a separate function.
template <Facts facts, class F>
LFDSIM_APART PanelPoint<F> trace_apart(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                                       const PanelBase<Scalar<F>>& base, const Ray<F>& ray, const Mask<F>& alive) {
    return trace_array<facts>(display, extent, base, ray, alive);
}

/// Does what trace_array() does, with the display's facts found at run time: for code that traces few rays and is compiled once.
template <class F>
inline PanelPoint<F> trace_any(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                               const PanelBase<Scalar<F>>& base, const Ray<F>& ray, const Mask<F>& alive) {
    return with_facts(display, [&]<Facts facts>() { return trace_apart<facts, F>(display, extent, base, ray, alive); });
}

/// Computes the ray of one sample of each pixel of a packet, in the first plane and after the diffuser. sampler(d) is the sample's
/// number of dimension d, in [-1, 1] (docs/model.md, "Sampling"): 0 and 1 turn the ray, 2 and 3 move it within the pixel, 4 and 5
/// within the pupil.
template <Facts facts = Facts{}, class F, class Samples>
LFDSIM_FN void sample_ray(const TracedDisplay<Scalar<F>>& display, const RayOrigin& view, const PixelRays<F>& pixels,
                          const Samples& sampler, Ray<F>& ray) {
    constexpr bool plain = facts.plain_light == Known::yes;
    ray = {{pixels.x, pixels.y, F(0)}, pixels.to};
    if (!plain && (display.box_filter || display.thin_lens)) {
        F jitter_x = F(0), jitter_y = F(0), lens_x = F(0), lens_y = F(0);
        if (display.box_filter) {
            jitter_x = sampler(2);
            jitter_y = sampler(3);
        }
        if (display.thin_lens) disk(sampler(4), sampler(5), lens_x, lens_y);
        const PixelRays<F> centres = pixels;  // a copy, so that the original may stay in registers
        ray = displaced(view, centres, jitter_x, jitter_y, lens_x, lens_y);
    }
    if (plain || display.has_diffuser) ray.to = scatter<plain>(display, ray.to, sampler(0), sampler(1));
}

/// Returns the panel pixel that one sample of each pixel reaches, and the share of its light that arrives.
template <Facts facts, class F, class Samples>
LFDSIM_FN PanelHit<F> trace(const TracedDisplay<Scalar<F>>& display, const RayOrigin& view, const PixelRays<F>& pixels,
                            const Samples& sampler) {
    Ray<F> ray;
    sample_ray<facts>(display, view, pixels, sampler, ray);
    const PanelPoint<F> point = trace_array<facts>(display, pixels.extent, pixels.base, ray, pixels.alive);
    return panel_pixel<facts.plain_light == Known::yes>(display, pixels.base, point);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
