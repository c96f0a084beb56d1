"""One refracting surface, of revolution or extruded along y, and what happens to light there. Double precision, arrays of rays.

Points and directions are (n, 3) arrays in the lens's own frame: x and y from the lens axis, z from the panel, all in mm.
"""
import copy

import numpy as np

EPS = 1e-9  # mm: joins of surfaces overlap by this much, so that no ray slips through between them
SCAN = 33   # points at which an asphere is sampled to bracket its roots


class Surface:
    """z = z_vertex + sag(s), s <= semi; n_below on the panel's side, n_above on the viewer's.

    s is the distance from the axis or, on a cylindrical lens, from the plane x = 0: `across` says which of x and y count.
    """

    def __init__(self, z, curvature, conic, even, semi, n_below, n_above, cylindrical=False):
        self.z, self.c, self.k, self.even, self.semi = z, curvature, conic, list(even), semi
        self.n_below, self.n_above = n_below, n_above
        self.flat = curvature == 0 and not any(self.even)
        self.across = np.array([1.0, 0.0 if cylindrical else 1.0])
        s = np.linspace(0.0, semi, 2001)
        heights = self.height(s * s)
        self.z_min, self.z_max, self.z_rim = heights.min(), heights.max(), heights[-1]

    def bent(self, factor):
        """The surface with its curvature times `factor`: a number for each ray (n,). The vertex and the aspheric terms stay."""
        out = copy.copy(self)
        out.c, s2 = self.c * factor, np.linspace(0.0, self.semi, 2001)[:, None] ** 2
        extremes = copy.copy(self)
        extremes.c = self.c * np.array([factor.min(), factor.max()]) if len(factor) else self.c
        heights = extremes.height(s2)
        out.z_min, out.z_max, out.z_rim = heights.min(), heights.max(), out.height(self.semi**2)  # z_rim (n,)
        return out

    def of(self, rays):
        """The surface as it is for some of the rays that it was bent for."""
        if not np.ndim(self.c):
            return self
        out = copy.copy(self)
        out.c, out.z_rim = self.c[rays], self.z_rim[rays]
        return out

    def squared(self, p):
        """s^2 of points (..., 3)."""
        return p[..., :2] ** 2 @ self.across

    def height(self, s2):
        """z of the surface at the squared distance s2, with the rays along its last axis where each has a curvature of its own."""
        root = np.sqrt(np.maximum(1 - (1 + self.k) * self.c**2 * s2, 0))
        return self.z + self.c * s2 / (1 + root) + sum(a * s2 ** (m + 2) for m, a in enumerate(self.even))

    def normal(self, p):
        """Unit normal with positive z: the gradient of z - height(s^2)."""
        s2 = self.squared(p)
        root = np.sqrt(np.maximum(1 - (1 + self.k) * self.c**2 * s2, 1e-30))
        slope = self.c / root + sum(2 * (m + 2) * a * s2 ** (m + 1) for m, a in enumerate(self.even))  # (d sag / d s) / s
        n = np.column_stack([-slope[:, None] * p[:, :2] * self.across, np.ones(len(p))])
        return n / np.linalg.norm(n, axis=1, keepdims=True)

    def roots(self, o, d):
        """All t at which the lines o + t d meet the surface inside its semi-aperture (a list of (n,) arrays, inf: none)."""
        return self._asphere_roots(o, d) if any(self.even) else self._conic_roots(o, d)

    def _conic_roots(self, o, d):
        # c (s^2 + (1 + k) z^2) - 2 z = 0 with z from the vertex.
        w = np.array([*self.across, 1.0 + self.k])
        o = o - [0, 0, self.z]
        a = self.c * ((d * d) @ w)
        b = self.c * ((o * d) @ w) - d[:, 2]
        c = self.c * ((o * o) @ w) - 2 * o[:, 2]
        disc = b * b - a * c
        q = -(b + np.copysign(np.sqrt(np.maximum(disc, 0)), b))
        with np.errstate(divide="ignore", invalid="ignore"):
            found = [q / a, c / q]
        return [self._kept(t, o, d, disc >= 0) for t in found]

    def _kept(self, t, o, d, ok):
        t = np.where(ok & np.isfinite(t), t, np.inf)
        p = o + np.where(np.isfinite(t), t, 0)[:, None] * d
        near_vertex = 1 - (1 + self.k) * self.c * p[:, 2] >= 0  # the sheet that the sag formula describes
        return np.where(near_vertex & (self.squared(p) <= (self.semi + EPS) ** 2), t, np.inf)

    def _asphere_roots(self, o, d):
        # Sample the height over the stretch of the line inside the surface's bounding box, bracket, bisect.
        wide = np.where(self.across > 0, self.semi + EPS, np.inf)
        lo, hi = box_interval(o, d, wide, self.z_min - EPS, self.z_max + EPS)
        some = np.flatnonzero(lo < hi)
        found = [np.full(len(o), np.inf) for _ in range(4)]
        if not len(some):
            return found
        o, d, lo, hi, here = o[some], d[some], lo[some], hi[some], self.of(some)

        def above(t):  # (rays, k) -> signed height over the surface
            p = o[:, None, :] + t[:, :, None] * d[:, None, :]
            return p[:, :, 2] - here.height(here.squared(p).T).T

        t = lo[:, None] + (hi - lo)[:, None] * np.linspace(0, 1, SCAN)
        f = above(t)
        # A ray that grazes the surface changes sign twice within one step: add the parabola's extremum about each sample.
        bend = f[:, :-2] - 2 * f[:, 1:-1] + f[:, 2:]
        with np.errstate(divide="ignore", invalid="ignore"):
            shift = np.clip(np.nan_to_num(0.5 * (f[:, :-2] - f[:, 2:]) / bend), -1, 1)
        extra = t[:, 1:-1] + shift * ((hi - lo) / (SCAN - 1))[:, None]
        t = np.sort(np.concatenate([t, extra], axis=1), axis=1)
        f = above(t)
        change = (f[:, :-1] > 0) != (f[:, 1:] > 0)
        for slot in found:
            has = change.any(axis=1)
            if not has.any():
                break
            k = change.argmax(axis=1)
            rows = np.arange(len(k))
            a, b, fa = t[rows, k], t[rows, k + 1], f[rows, k]
            for _ in range(52):
                m = 0.5 * (a + b)
                same = (above(m[:, None])[:, 0] > 0) == (fa > 0)
                a, b = np.where(same, m, a), np.where(same, b, m)
            slot[some[has]] = (0.5 * (a + b))[has]
            change[rows, k] = False
        return found


def box_interval(o, d, wide, z_min, z_max):
    """Where the lines are inside |x| <= wide[0], |y| <= wide[1] and z_min <= z <= z_max: (t_in, t_out), in > out if never."""
    lo, hi = np.full(len(o), -np.inf), np.full(len(o), np.inf)
    for axis, (low, high) in enumerate([(-wide[0], wide[0]), (-wide[1], wide[1]), (z_min, z_max)]):
        with np.errstate(divide="ignore", invalid="ignore"):
            t = np.sort(np.stack([(low - o[:, axis]) / d[:, axis], (high - o[:, axis]) / d[:, axis]]), axis=0)
        flat = d[:, axis] == 0
        inside = (o[:, axis] >= low) & (o[:, axis] <= high)
        lo = np.maximum(lo, np.where(flat, np.where(inside, -np.inf, np.inf), t[0]))
        hi = np.minimum(hi, np.where(flat, np.where(inside, np.inf, -np.inf), t[1]))
    return lo, hi


def refract(d, n, n1, n2):
    """Snell: unit directions d meet a surface with unit normal n (either sign), from index n1 to n2.

    Returns (refracted, reflected, cos1, cos2, total): total marks total internal reflection (refracted is then useless).
    """
    n = np.where((np.sum(d * n, axis=1) > 0)[:, None], -n, n)
    cos1 = -np.sum(d * n, axis=1)
    eta = n1 / n2
    radicand = 1 - eta**2 * (1 - cos1**2)
    cos2 = np.sqrt(np.maximum(radicand, 0))
    refracted = eta[:, None] * d + (eta * cos1 - cos2)[:, None] * n
    return refracted, d + 2 * cos1[:, None] * n, cos1, cos2, radicand < 0


def transmittance(cos1, cos2, n1, n2, kind):
    """Share 1 - F of unpolarised light that passes; kind: exact | schlick | none."""
    if kind == "none":
        return np.ones_like(cos1)
    if kind == "schlick":
        r0 = ((n1 - n2) / (n1 + n2)) ** 2
        return 1 - (r0 + (1 - r0) * (1 - np.where(n1 < n2, cos1, cos2)) ** 5)  # the angle in the less dense medium
    across = (n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2)
    along = (n2 * cos1 - n1 * cos2) / (n2 * cos1 + n1 * cos2)
    return 1 - 0.5 * (across**2 + along**2)
