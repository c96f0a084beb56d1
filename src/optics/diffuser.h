// The diffuser: a thin plane that turns a ray by two random angles, without loss. Floor 1.
#pragma once
#include "optics/surface.h"
#include "optics/traced_display.h"
#include "simd/elementary.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Returns the scattering angle for u uniform in [-1, 1], in units of `scale`: u for a box, erfinv(u tail) for a normal
/// distribution of which `scale` is sigma sqrt(2) and `tail` the share of the light that it keeps (docs/model.md, "Diffuser").
template <class F>
LFDSIM_FN F scattering_angle(Profile profile, F scale, F u, F tail) {
    return scale * (profile == Profile::box ? u : erfinv(u * tail));
}

/// Returns the scattering angle, radians, for a number uniform in [-1, 1]. `box` promises a box.
template <bool box = false, class F>
LFDSIM_FN F diffuser_angle(const TracedDisplay<Scalar<F>>& display, int axis, F uniform) {
    return scattering_angle(box ? Profile::box : display.diffuser_profile, F(display.angle_scale[axis]), uniform,
                            F(display.within_horizon[axis]));
}

/// Returns the tangent of diffuser_angle().
template <class F>
LFDSIM_FN F diffuser_tangent(const TracedDisplay<Scalar<F>>& display, int axis, F uniform) {
    F sine, cosine;
    sincos(diffuser_angle(display, axis, uniform), display.small_angles, sine, cosine);
    return sine / cosine;
}

/// The inverse of diffuser_angle, of a box: the number whose angle has this tangent; outside [-1, 1] where the diffuser does not
/// turn a ray that far.
template <class F>
LFDSIM_FN F diffuser_uniform(const TracedDisplay<Scalar<F>>& display, int axis, F tangent) {
    return atan(tangent) / F(display.angle_scale[axis]);
}

/// t = Rx(b) Ry(a) i: about y first (spreads horizontally), then about x; right-handed. Keeps the unit length.
template <class F>
LFDSIM_FN Vec3<F> turn(Vec3<F> i, F sin_a, F cos_a, F sin_b, F cos_b) {
    const F x = cos_a * i.x + sin_a * i.z, z = cos_a * i.z - sin_a * i.x;
    return {x, cos_b * i.y - sin_b * z, sin_b * i.y + cos_b * z};
}

/// Returns the direction of a ray after the diffuser, t = Rx(b) Ry(a) i, for two numbers uniform in [-1, 1]; axis 0 spreads
/// horizontally, axis 1 vertically.
template <bool box = false, class F>
LFDSIM_FN Vec3<F> scatter(const TracedDisplay<Scalar<F>>& display, Vec3<F> to, F uniform_a, F uniform_b) {
    F sin_a, cos_a, sin_b, cos_b;
    sincos(diffuser_angle<box>(display, 0, uniform_a), display.small_angles, sin_a, cos_a);
    sincos(diffuser_angle<box>(display, 1, uniform_b), display.small_angles, sin_b, cos_b);
    return turn(to, sin_a, cos_a, sin_b, cos_b);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
