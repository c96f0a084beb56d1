// Refracting surfaces: where a ray meets one, the normal there, and the share of light transmitted (Fresnel). Floor 1.
#pragma once
#include "optics/traced_display.h"
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A vector with components along x, y and z.
template <class F>
struct Vec3 {
    F x, y, z;
};
template <class F>
LFDSIM_FN F dot(Vec3<F> a, Vec3<F> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Returns `a` in the lanes of `first`, `b` in the others.
template <class F>
LFDSIM_FN Vec3<F> choose(Mask<F> first, Vec3<F> a, Vec3<F> b) {
    return {select(first, a.x, b.x), select(first, a.y, b.y), select(first, a.z, b.z)};
}

/// A ray: position in mm, x and y from a lens's axis, z from the vertex of the current surface; unit direction.
template <class F>
struct Ray {
    Vec3<F> at, to;
};

/// Where a ray meets a surface: the point, relative to axis and vertex; the unit normal, towards the viewer's side; `cos` =
/// -to.normal, positive for rays from that side, and `cos2`, its square in full accuracy; `ok`: the ray does meet it, within
/// the semi-aperture.
template <class F>
struct Hit {
    Vec3<F> at, normal;
    F cos, cos2;
    Mask<F> ok;
};

// A surface is a SurfaceData, or one whose curvature differs from lane to lane (misaligned.h).

/// Computes the sag z, mm, and the slope at s2 = x^2 + y^2 of the sheet that contains the vertex: z = c s^2/(1 + sqrt(1 - (1 + k)
/// c^2 s^2)) + a4 s^4 + a6 s^6 + ... (docs/model.md, "Lenses"). `real`: the sheet extends as far as s. d = 2 dz/d(s^2), so that the
/// normal is along (-x d, -y d, 1).
template <class F, class Surface>
LFDSIM_FN void sag(const Surface& surface, F s2, F& z, F& d, Mask<F>& real) {
    const F c = surface.curvature, root2 = F(1) - c * c * (F(1) + F(surface.conic)) * s2;
    real = root2 > F(0);
    const F root = sqrt(max(root2, F(1e-12f)));
    z = c * s2 / (F(1) + root);
    d = c / root;
    F power = s2;  // s^(2 i) of the term a s^(2 i + 2)
    for (int i = 0; i < surface.terms; ++i) {
        const F a = surface.asphere[i];
        d = d + F(Scalar<F>(2 * (i + 2))) * a * power;
        power = power * s2;
        z = z + a * power;
    }
}

/// Intersects rays that come from the viewer's side with a sphere. They start in its vertex plane (at.z = 0). The distance t is
/// the root next to the vertex of c t^2/2 - (d_z - c b) t + c s^2/2 = 0, b = x d_x + y d_y, s^2 = x^2 + y^2, in a form without
/// cancellation that also holds for c = 0 (Welford, Aberrations of Optical Systems, 1986, sec. 4.5); on a sphere the cosine of
/// incidence is the square root of the discriminant.
template <class F, class Surface>
LFDSIM_FN Hit<F> meet_sphere(const Surface& surface, Ray<F> ray) {
    const F c = surface.curvature;
    const F cs2 = c * (ray.at.x * ray.at.x + ray.at.y * ray.at.y);
    const F g = ray.to.z - c * (ray.at.x * ray.to.x + ray.at.y * ray.to.y);
    const F cos2 = g * g - c * cs2;
    const F cosine = root(max(cos2, F(0)));
    const F t = quotient(cs2, g - cosine);
    const F x = ray.at.x + ray.to.x * t, y = ray.at.y + ray.to.y * t, z = ray.to.z * t;
    const F cz = c * z;
    Hit<F> hit{{x, y, z}, {-(c * x), -(c * y), F(1) - cz}, cosine, cos2, {}};
    hit.ok = both(cos2 > F(0), cz <= F(surface.c_rim));
    return hit;
}

/// Intersects rays with a circular cylinder along y'. In projection along y' the ray meets a circle: t is the root next to the
/// vertex of c l^2 t^2/2 - (d_z - c x d_x) t + c x^2/2 = 0, with length2 = l^2 = d_x^2 + d_z^2. The square root of the discriminant
/// is the cosine of incidence in space. Rays start as those of meet_sphere().
template <class F, class Surface>
LFDSIM_FN Hit<F> meet_round_cylinder(const Surface& surface, Ray<F> ray, F length2) {
    const F c = surface.curvature;
    const F cs2 = c * (ray.at.x * ray.at.x);
    const F g = ray.to.z - c * (ray.at.x * ray.to.x);
    const F cos2 = g * g - length2 * (c * cs2);
    const F cosine = root(max(cos2, F(0)));
    const F t = quotient(cs2, g - cosine);
    const F x = ray.at.x + ray.to.x * t, y = ray.at.y + ray.to.y * t, z = ray.to.z * t;
    const F cz = c * z;
    Hit<F> hit{{x, y, z}, {-(c * x), F(0), F(1) - cz}, cosine, cos2, {}};
    hit.ok = (cos2 > F(0)) && (cz <= F(surface.c_rim));
    return hit;
}

/// Intersects rays with a conic (closed form) or an even asphere (Newton's method from the conic; the iteration stops lane by lane,
/// so that its bits do not depend on neighbouring lanes). Rays start as those of meet_sphere(). Docs/model.md, "Refraction", has
/// the equations and the limits of the iteration.
template <class F, class Surface>
LFDSIM_FN Hit<F> meet_asphere(const Surface& surface, Ray<F> ray) {
    const F c = surface.curvature, k1 = F(1) + F(surface.conic);
    // The conic is c/2 (|p|^2 + k z^2) - z = 0, so along the ray t = c s^2/(G - sqrt(G^2 - A c s^2)), G = d_z - c (x d_x + y d_y),
    // A = c (1 + k d_z^2).
    const F cs2 = c * (ray.at.x * ray.at.x + ray.at.y * ray.at.y);
    const F g = ray.to.z - c * (ray.at.x * ray.to.x + ray.at.y * ray.to.y);
    const F a = c * (F(1) + (k1 - F(1)) * ray.to.z * ray.to.z);
    const F disc = g * g - a * cs2;
    F t = cs2 / (g - sqrt(max(disc, F(0))));
    F z, d;
    Mask<F> real = disc > F(0);
    Vec3<F> p{};
    // Moves p to the path length `at`, and z and d to the sag and slope there; returns whether the sheet extends as far as there.
    auto move_to = [&](F at) {
        p = {ray.at.x + ray.to.x * at, ray.at.y + ray.to.y * at, ray.to.z * at};
        Mask<F> sheet;
        sag(surface, p.x * p.x + p.y * p.y, z, d, sheet);
        return sheet;
    };
    Mask<F> sheet = move_to(t);
    if (surface.terms > 0) {
        // Where the ray misses the conic, start from the vertex plane.
        t = select(real, t, F(0));
        sheet = move_to(t);
        real = sheet || !sheet;  // all lanes
        Mask<F> moving = real;
        const F tolerance = F(Scalar<F>(sizeof(Scalar<F>) == 4 ? 1e-6 : 1e-13));
        for (int step = 0; step < 12 && any(moving); ++step) {
            // Newton's step for h(t) = z - sag, whose derivative along the ray is d_z - d (x d_x + y d_y)
            const F slope = ray.to.z - d * (p.x * ray.to.x + p.y * ray.to.y);
            const F change = (p.z - z) / slope;
            t = select(moving, t - change, t);
            sheet = move_to(t);
            moving = moving && (abs(change) > tolerance);
        }
        real = sheet && (abs(p.z - z) < F(Scalar<F>(1e-4)));
    }
    // The unit normal, (-x d, -y d, 1) / sqrt(1 + d^2 s^2)
    const F length2 = F(1) + d * d * (p.x * p.x + p.y * p.y), per_length = F(1) / sqrt(length2);
    const Vec3<F> normal{-(p.x * d) * per_length, -(p.y * d) * per_length, per_length};
    const F cosine = -dot(ray.to, normal);
    Hit<F> hit{p, normal, cosine, cosine * cosine, {}};
    hit.ok = real && sheet && (cosine > F(0)) && (p.x * p.x + p.y * p.y <= F(surface.semi_aperture) * F(surface.semi_aperture));
    return hit;
}

/// Returns the transmitted share 1 - F of a refraction (docs/model.md, "Refraction"), by Schlick's approximation or, for any other
/// `fresnel`, exactly; not for Fresnel::none. c1: cosine in the medium that the backward ray comes from (index n1); c2: in the
/// other (n2); c_thin: the one of the two in the less dense medium. schlick_t0 = 1 - R0.
template <class F>
LFDSIM_FN F transmittance(Fresnel fresnel, F schlick_t0, F n1, F n2, F c1, F c2, F c_thin) {
    if (fresnel == Fresnel::schlick) {          // always the cosine in the less dense medium, whether the ray goes down or up
        const F q = F(1) - c_thin, q2 = q * q;  // 1 - F = (1 - R0) (1 - (1 - cos)^5)
        return schlick_t0 - schlick_t0 * (q2 * q2 * q);
    }
    // Mean of both polarisations: 2 n1 n2 c1 c2 (1/(n1 c1 + n2 c2)^2 + 1/(n1 c2 + n2 c1)^2)
    const F s = n1 * c1 + n2 * c2, p = n1 * c2 + n2 * c1, sp = s * p;
    return (F(2) * n1 * n2) * (c1 * c2) * (s * s + p * p) / (sp * sp);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
