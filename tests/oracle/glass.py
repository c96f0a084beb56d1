"""Glass in air: separate lenses (`clear`) or caps on a common sheet (`plate`). One path, found by intersecting everything nearby.

Both are bodies between a lower and an upper height over the (x, y) plane. The nearest boundary that the ray crosses the right way (into
glass when in air, out of it when in glass) ends each step, so the surface just left can never be met again at distance 0.
"""
import numpy as np

from path import ESCAPED, LOST, TOO_MANY
from surface import EPS, refract, transmittance

MOST_SURFACES = 16


class Glass:
    def __init__(self, display, lattice):
        self.lower, self.upper = display.surfaces
        self.lattice, self.plate = lattice, display.array.surround == "plate"
        if not self.plate and self.lower.semi != self.upper.semi:
            raise ValueError("a clear lens whose two semi-apertures differ has no defined wall")
        self.index = self.lower.n_above
        self.z_min = min(self.lower.z_min, self.lower.z_rim)
        self.z_max = max(self.upper.z_max, self.upper.z_rim)
        self.reach = lattice.pitch / 2 if lattice.fills_cell else max(self.lower.semi, self.upper.semi)

    def lens_hits(self, o, d, i, j, leaving):
        """Nearest boundary of one lens per ray, in its frame, crossed into glass (leaving False) or out of it: (t, outward normal)."""
        best, normal = np.full(len(o), np.inf), np.zeros((len(o), 3))

        def offer(t, normal_at, valid):
            p = o + np.where(np.isfinite(t), t, 0)[:, None] * d
            n = normal_at(p)
            ok = (t > -EPS) & (t < best) & np.isfinite(t) & ((np.sum(d * n, axis=1) > 0) == leaving) & valid(p)
            best[ok], normal[ok] = t[ok], n[ok]

        for surface, sign in ((self.upper, 1), (self.lower, -1)):
            for t in surface.roots(o, d):
                offer(t, lambda p: sign * surface.normal(p), lambda p: self.lattice.in_aperture(p, surface.semi))
        for t, normal_at, exists in self.walls(o, d, i, j):
            offer(t, normal_at, lambda p: exists & self.on_wall(p))
        return best, normal

    def walls(self, o, d, i, j):
        """(t, outward normal at p, which rays' lens has that wall) for the vertical walls of one lens per ray."""
        everywhere = np.ones(len(o), bool)
        if self.lattice.fills_cell:
            last = self.lattice.nx - 1, self.lattice.ny - 1
            for axis, cell in ((0, i), (1, j)):
                for sign, border in ((-1, 0), (1, last[axis])):
                    n = np.zeros(3)
                    n[axis] = sign
                    with np.errstate(divide="ignore", invalid="ignore"):
                        t = (sign * self.lattice.pitch[axis] / 2 - o[:, axis]) / d[:, axis]
                    # Inside a plate the caps of neighbouring cells meet at equal heights: only the array's border has walls.
                    yield t, lambda p, n=n: np.broadcast_to(n, p.shape), (cell == border) if self.plate else everywhere
        elif not self.plate:
            a = d[:, 0] ** 2 + d[:, 1] ** 2
            b = o[:, 0] * d[:, 0] + o[:, 1] * d[:, 1]
            disc = b * b - a * (o[:, 0] ** 2 + o[:, 1] ** 2 - self.upper.semi**2)
            for sign in (-1, 1):
                with np.errstate(divide="ignore", invalid="ignore"):
                    t = np.where(disc >= 0, (-b + sign * np.sqrt(np.maximum(disc, 0))) / a, np.inf)
                yield t, lambda p: p * [1, 1, 0] / self.upper.semi, everywhere

    def on_wall(self, p):
        s2, z = p[:, 0] ** 2 + p[:, 1] ** 2, p[:, 2]
        inside = (np.abs(p[:, :2]) <= self.lattice.pitch / 2 + EPS).all(axis=1) if self.lattice.fills_cell else True
        low, high = self.lower.height(s2), self.upper.height(s2)
        if not self.plate:
            return inside & (z >= low - EPS) & (z <= high + EPS)
        upper_step = (z - self.upper.z_rim) * (z - high) <= 0  # between the sheet's face and the cap's edge
        return inside & (upper_step | ((z - self.lower.z_rim) * (z - low) <= 0))

    def sheet_hits(self, o, d, leaving):
        """Nearest passage through the flat faces of a plate, between the caps."""
        best, normal = np.full(len(o), np.inf), np.zeros((len(o), 3))
        for surface, sign in ((self.upper, 1.0), (self.lower, -1.0)):
            with np.errstate(divide="ignore", invalid="ignore"):
                t = (surface.z_rim - o[:, 2]) / d[:, 2]
            p = o + np.where(np.isfinite(t), t, 0)[:, None] * d
            ok = np.isfinite(t) & (t > -EPS) & (t < best) & ((d[:, 2] * sign > 0) == leaving) & ~self.lattice.in_any_aperture(p, surface.semi, -EPS)
            best[ok], normal[ok] = t[ok], [0, 0, sign]
        return best, normal

    def next_hit(self, o, d, i, j, leaving):
        """Nearest boundary for rays all in air or all in glass; (t, normal, i, j), (i, j) the lens met."""
        if leaving and not self.plate:
            t, normal = self.lens_hits(o - self.lattice.axis(i, j), d, i, j, True)
            return t, normal, i, j
        sheet, sheet_normal = self.sheet_hits(o, d, leaving) if self.plate else (np.full(len(o), np.inf), None)
        with np.errstate(divide="ignore", invalid="ignore"):
            to_faces = np.sort(np.stack([(self.z_min - EPS - o[:, 2]) / d[:, 2], (self.z_max + EPS - o[:, 2]) / d[:, 2]]), axis=0)
        within = (o[:, 2] >= self.z_min - EPS) & (o[:, 2] <= self.z_max + EPS)
        flat = d[:, 2] == 0
        t0 = np.where(flat, np.where(within, 0, np.inf), np.maximum(to_faces[0], 0))
        t1 = np.minimum(np.where(flat, np.inf, to_faces[1]), sheet)
        t, normal, i, j = self.lattice.first_hit(o, d, t0, t1, self.reach, lambda *pair: self.lens_hits(*pair, leaving))
        face = sheet < t
        if face.any():
            t, normal = np.where(face, sheet, t), np.where(face[:, None], sheet_normal, normal)
            i, j = np.where(face, -1, i), np.where(face, -1, j)
        return t, normal, i, j


def trace_glass(path, display, lattice):
    glass = Glass(display, lattice)
    inside = np.zeros(len(path.o), bool)
    bi, bj = np.zeros(len(path.o), np.int64), np.zeros(len(path.o), np.int64)
    while len(path.alive()):
        for leaving in (False, True):
            rays = path.alive()
            rays = rays[inside[rays] == leaving]
            if not len(rays):
                continue
            t, normal, i, j = glass.next_hit(path.o[rays], path.d[rays], bi[rays], bj[rays], leaving)
            hit = np.isfinite(t)
            if leaving:  # only light that runs exactly level inside an endless sheet may miss
                path.status[rays[~hit]] = ESCAPED if glass.plate else LOST
            else:
                path.to_panel(rays[~hit], display, lattice)
            rays, t, normal, i, j = rays[hit], t[hit], normal[hit], i[hit], j[hit]
            path.met[rays] += 1
            path.meet(rays, i, j)
            many = path.met[rays] > MOST_SURFACES
            path.status[rays[many]] = TOO_MANY
            path.advance(rays, t, display, lattice)
            bi[rays], bj[rays] = i, j
            n1 = np.where(inside[rays], glass.index, 1.0)
            n2 = 1 + glass.index - n1
            bent, mirrored, cos1, cos2, total = refract(path.d[rays], normal, n1, n2)
            path.d[rays] = np.where(total[:, None], mirrored, bent)
            path.weight[rays] *= np.where(total, 1.0, transmittance(cos1, cos2, n1, n2, display.render.fresnel))
            inside[rays] = np.where(total, inside[rays], ~inside[rays])
