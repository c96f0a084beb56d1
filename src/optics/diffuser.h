// The diffuser: a thin plane that turns a ray by two random angles, without loss. Floor 1.
#pragma once
#include "optics/scene.h"
#include "optics/surface.h"
#include "simd/elementary.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The angle in radians for a number uniform in [-1, 1]: box or normal distribution, the normal one cut at +-89 degrees.
/// `box` promises the first.
template <bool box = false, class F>
LFDSIM_FN F diffuser_angle(const Scene<Scalar<F>>& scene, int axis, F uniform) {
    if (box || scene.diffuser_profile == Profile::box) return uniform * F(scene.half_angle[axis]);
    return F(scene.half_angle[axis]) * erfinv(uniform * F(scene.gaussian_tail[axis]));
}

/// The tangent of that angle.
template <class F>
LFDSIM_FN F diffuser_tangent(const Scene<Scalar<F>>& scene, int axis, F uniform) {
    F sine, cosine;
    sincos(diffuser_angle(scene, axis, uniform), scene.small_angles, sine, cosine);
    return sine / cosine;
}

/// The inverse of diffuser_angle, of a box: the number whose angle has this tangent; outside [-1, 1] where the diffuser does not
/// turn a ray that far.
template <class F>
LFDSIM_FN F diffuser_uniform(const Scene<Scalar<F>>& scene, int axis, F tangent) {
    return atan(tangent) / F(scene.half_angle[axis]);
}

/// t = Rx(b) Ry(a) i: about y first (spreads horizontally), then about x; right-handed. Keeps the unit length.
template <class F>
LFDSIM_FN Vec3<F> turn(Vec3<F> i, F sin_a, F cos_a, F sin_b, F cos_b) {
    const F x = cos_a * i.x + sin_a * i.z, z = cos_a * i.z - sin_a * i.x;
    return {x, cos_b * i.y - sin_b * z, sin_b * i.y + cos_b * z};
}

template <bool box = false, class F>
LFDSIM_FN Vec3<F> scatter(const Scene<Scalar<F>>& scene, Vec3<F> to, F uniform_a, F uniform_b) {
    F sin_a, cos_a, sin_b, cos_b;
    sincos(diffuser_angle<box>(scene, 0, uniform_a), scene.small_angles, sin_a, cos_a);
    sincos(diffuser_angle<box>(scene, 1, uniform_b), scene.small_angles, sin_b, cos_b);
    return turn(to, sin_a, cos_a, sin_b, cos_b);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
