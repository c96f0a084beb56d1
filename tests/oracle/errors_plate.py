"""A moulded sheet whose caps are moved: glass is the slab between the rims and the caps together. By intersecting everything nearby."""
import itertools

import numpy as np

from surface import EPS


class MovedPlate:
    """The sheet for glass.trace_glass, with points and directions in the display's frame.

    A cap is what is under a lens's moved face over its moved aperture (over the lower face of a lens that bulges there), down to the
    slab; one that has sunk into the slab is hidden by it.
    """

    plate = True

    def __init__(self, display, lattice):
        self.lower, self.upper = display.surfaces
        self.lattice, self.index, self.glued = lattice, self.lower.n_above, display.glued
        self.faces = [(s, sign) for s, sign in ((self.upper, 1.0), (self.lower, -1.0)) if not s.flat]
        for surface, sign in self.faces:
            if (sign * (surface.height(np.linspace(0, surface.semi, 2001) ** 2) - surface.z_rim) < -EPS).any():
                raise ValueError("a plate's hollow faces have no caps that could move")
        self.z_min, self.z_max = min(lattice.low, self.lower.z_rim), max(lattice.high, self.upper.z_rim)
        self.reach = lattice.shape.extent if lattice.fills_cell else max(s.semi for s in display.surfaces)
        far = (np.max(self.reach) + lattice.margin) / lattice.pitch + 1
        self.around = list(itertools.product(*(range(-int(k), int(k) + 1) for k in far)))

    def cover(self, surface, sign, p, at, skip=None):
        """How high the glass of other lenses than skip and of the slab is at points p (n, 3) of the array's frame, as sign * z. A cap
        counts if its aperture holds the points `at`."""
        lattice, height = self.lattice, np.full(len(p), sign * surface.z_rim)
        if surface.flat:
            return height
        i0, j0, _ = lattice.cell(at)
        none = np.zeros_like(p)
        for di, dj in self.around:
            i, j = i0 + di, j0 + dj
            on = (i >= 0) & (i < lattice.nx) & (j >= 0) & (j < lattice.ny)
            if skip is not None:
                on &= (i != skip[0]) | (j != skip[1])
            k = np.flatnonzero(on)
            i, j = i[k], j[k]
            inside = lattice.in_aperture(lattice.into_lens(at[k], none[k], i, j)[0], surface.semi, 0.0)
            k, i, j = k[inside], i[inside], j[inside]
            s2 = surface.squared(lattice.into_lens(p[k], none[k], i, j)[0])
            height[k] = np.maximum(height[k], sign * (lattice.bent(surface, i, j).height(s2) + lattice.move[i, j, 2]))
        return height

    def cap_hits(self, q, u, i, j, leaving):
        """Nearest boundary of the sheet on one lens's cap per ray, in the lens's frame, crossed into glass (leaving False) or out of
        it: (t, outward normal)."""
        best, normal = np.full(len(q), np.inf), np.zeros((len(q), 3))
        place = self.lattice.axis(i, j) + self.lattice.move[i, j]  # no tilts: from here to the array's frame

        def offer(t, n, on):
            """on(k, p): whether points p of rays k are on the sheet's outside."""
            k = np.flatnonzero(np.isfinite(t) & (t > -EPS) & (t < best) & ((np.sum(u * n, axis=1) > 0) == leaving))
            k = k[on(k, q[k] + t[k, None] * u[k])]
            best[k], normal[k] = t[k], n[k]

        for base, sign in self.faces:
            surface = self.lattice.bent(base, i, j)

            def on_face(k, p):
                out = self.lattice.in_aperture(p, base.semi)
                at = p[out] + place[k[out]]
                out[out] = sign * at[:, 2] >= self.cover(base, sign, at, at, (i[k[out]], j[k[out]])) - EPS
                return out

            for t in surface.roots(q, u):
                p = q + np.where(np.isfinite(t), t, 0)[:, None] * u
                offer(t, sign * surface.normal(p), on_face)
            for t, n in self.upright(base, q, u):

                def on_wall(k, p):
                    out = self.lattice.in_aperture(p, base.semi)
                    p, k = p[out], k[out]
                    at = p + place[k]
                    inner = sign * (surface.of(k).height(base.squared(p)) + self.lattice.move[i[k], j[k], 2])
                    outer, z = self.cover(base, sign, at, at + 1e-6 * n[k]), sign * at[:, 2]
                    out[out] = (inner - outer > EPS) & (z >= outer - EPS) & (z <= inner + EPS)
                    return out

                offer(t, n, on_wall)
        return best, normal

    def upright(self, surface, q, u):
        """(t, outward normals) where lines in a lens's frame meet the upright sides of its aperture."""
        lattice, shape = self.lattice, self.lattice.shape
        sides = list(zip(shape.normals, shape.half)) if lattice.fills_cell else []
        if not lattice.across.all():
            sides.append((np.array([1.0, 0.0]), surface.semi))
        for n, half in sides:
            for sign in (-1, 1):
                with np.errstate(divide="ignore", invalid="ignore"):
                    t = (sign * half - q[:, :2] @ n) / (u[:, :2] @ n)
                yield t, np.broadcast_to([*(sign * n), 0.0], q.shape)
        if lattice.across.all():
            a, b = u[:, 0] ** 2 + u[:, 1] ** 2, q[:, 0] * u[:, 0] + q[:, 1] * u[:, 1]
            disc = b * b - a * (q[:, 0] ** 2 + q[:, 1] ** 2 - surface.semi**2)
            for sign in (-1, 1):
                with np.errstate(divide="ignore", invalid="ignore"):
                    t = np.where(disc >= 0, (-b + sign * np.sqrt(np.maximum(disc, 0))) / a, np.inf)
                yield t, (q + np.where(np.isfinite(t), t, 0)[:, None] * u) * [1, 1, 0] / surface.semi

    def slab_hits(self, o, d, leaving):
        """Nearest passage through the slab's flat faces where no cap stands on them; array's frame."""
        best, normal = np.full(len(o), np.inf), np.zeros((len(o), 3))
        for surface, sign in ((self.upper, 1.0), (self.lower, -1.0)):
            with np.errstate(divide="ignore", invalid="ignore"):
                t = (surface.z_rim - o[:, 2]) / d[:, 2]
            k = np.flatnonzero(np.isfinite(t) & (t > -EPS) & (t < best) & ((d[:, 2] * sign > 0) == leaving))
            p = o[k] + t[k, None] * d[k]
            k = k[self.cover(surface, sign, p, p) <= sign * surface.z_rim + EPS]
            best[k], normal[k] = t[k], [0, 0, sign]
        return best, normal

    def next_hit(self, o, d, i, j, leaving):
        """Nearest boundary for rays all in air or all in glass; (t, normal, i, j), (i, j) the lens met, -1 on the slab."""
        o, d = self.lattice.enter(o, d)
        t_slab, n_slab = self.slab_hits(o, d, leaving)
        with np.errstate(divide="ignore", invalid="ignore"):
            t0, t1 = np.sort(np.stack([(self.z_min - EPS - o[:, 2]) / d[:, 2], (self.z_max + EPS - o[:, 2]) / d[:, 2]]), axis=0)
        level, within = d[:, 2] == 0, (o[:, 2] >= self.z_min - EPS) & (o[:, 2] <= self.z_max + EPS)
        t0, t1 = np.where(level, np.where(within, 0, np.inf), np.maximum(t0, 0)), np.minimum(np.where(level, np.inf, t1), t_slab)
        t, normal, i, j = self.lattice.first_hit(o, d, t0, t1, self.reach, lambda *pair: self.cap_hits(*pair, leaving))
        slab = t_slab < t
        t, normal = np.where(slab, t_slab, t), np.where(slab[:, None], n_slab, normal)
        return t, normal @ self.lattice.turn.T, np.where(slab, -1, i), np.where(slab, -1, j)
