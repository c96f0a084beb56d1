// The layers on the panel: plane plates, through which rays go down to it. Floor 1.
#pragma once
#include "optics/lattice.h"
#include "optics/surface.h"
#include "optics/traced_display.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Traces a ray from the top of the layers down to the panel by Snell's law and returns its end, mm; `to` becomes its direction
/// in the lowest layer, and `weight` is multiplied by the transmittances. Rays of the lanes in `glued` are already in the top
/// layer, all others come from air.
template <class F>
LFDSIM_RARE Vec2<F> through_layers(const TracedDisplay<Scalar<F>>& display, Vec2<F> at, Mask<F> glued, Vec3<F>& to, F& weight,
                                   Mask<F>& alive) {
    for (int k = 0; k < display.layer_count; ++k) {
        const Interface<Scalar<F>>& media = display.layer[k].media;
        const Mask<F> enters = k > 0 ? alive : alive && !glued;
        // Snell's law at a plane: c2^2 = 1 - eta^2 (1 - c1^2), c1 and c2 the cosines above and below
        const F eta = F(media.eta), c1 = -to.z, cos2 = (F(1) - eta * eta) + eta * eta * (c1 * c1), c2 = sqrt(max(cos2, F(0)));
        alive = alive && (!enters || (cos2 > F(0)));  // total reflection is black
        if (display.fresnel != Fresnel::none && media.n_above != media.n_below) {
            const F share = transmittance(display.fresnel, F(media.schlick_t0), F(media.n_above), F(media.n_below), c1, c2,
                                          media.n_above < media.n_below ? c1 : c2);
            weight = select(enters, weight * share, weight);
        }
        // The normal is along z, so the lateral components are multiplied by eta.
        to = {select(enters, eta * to.x, to.x), select(enters, eta * to.y, to.y), select(enters, -c2, to.z)};
        const F t = F(-display.layer[k].thickness) / to.z;
        at = {at.x + to.x * t, at.y + to.y * t};
    }
    return at;
}

/// Returns where a ray that has left its lens at `at`, z from the panel, reaches the panel; x and y as those of `at`, mm. `to`
/// becomes the direction there, and `weight` is multiplied by the transmittances of the layers; total reflection clears `alive`.
template <class F>
LFDSIM_FN Vec2<F> down_to_panel(const TracedDisplay<Scalar<F>>& display, Vec3<F> at, Mask<F> glued, Vec3<F>& to, F& weight,
                                Mask<F>& alive) {
    const F t = (display.layer_count == 0 ? -at.z : F(display.layers_top) - at.z) / to.z;
    const Vec2<F> below{at.x + to.x * t, at.y + to.y * t};
    return display.layer_count == 0 ? below : through_layers(display, below, glued, to, weight, alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
