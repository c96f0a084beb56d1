"""Glass in air: separate lenses (`clear`) or caps on a common sheet (`plate`). One path, found by intersecting everything nearby.

Both are bodies between a lower and an upper height over the (x, y) plane. The nearest boundary that the ray crosses the right way (into
glass when in air, out of it when in glass) ends each step, so the surface just left can never be met again at distance 0. A lower face
that is glued on ends the way through the lenses: what passes it goes on through the layers.
"""
import numpy as np

from path import ALIVE, ESCAPED, LOST, TOO_MANY
from surface import EPS, refract, transmittance

MOST_SURFACES = 16


class Glass:
    def __init__(self, display, lattice):
        self.lower, self.upper = display.surfaces
        self.lattice, self.plate = lattice, display.array.surround == "plate"
        if not self.plate and self.lower.semi != self.upper.semi:
            raise ValueError("a clear lens whose two semi-apertures differ has no defined wall")
        self.index, self.glued = self.lower.n_above, display.glued
        self.z_min = min(self.lower.z_min, self.lower.z_rim)
        self.z_max = max(self.upper.z_max, self.upper.z_rim)
        self.reach = lattice.shape.extent if lattice.fills_cell else max(self.lower.semi, self.upper.semi)

    def lens_hits(self, o, d, i, j, leaving):
        """Nearest boundary of one lens per ray, in its frame, crossed into glass (leaving False) or out of it: (t, outward normal)."""
        best, normal = np.full(len(o), np.inf), np.zeros((len(o), 3))

        def offer(t, n, on):
            ok = on & (t > -EPS) & (t < best) & np.isfinite(t) & ((np.sum(d * n, axis=1) > 0) == leaving)
            best[ok], normal[ok] = t[ok], n[ok]

        for surface, sign in ((self.upper, 1), (self.lower, -1)):
            for t in surface.roots(o, d):
                p = _at(o, d, t)
                offer(t, sign * surface.normal(p), self.lattice.in_aperture(p, surface.semi))
        for t, n in self.upright(o, d):
            p = _at(o, d, t)
            if self.plate:
                self.offer_steps(t, p, n, i, j, offer)
            else:
                s2 = self.upper.squared(p)
                between = (p[:, 2] >= self.lower.height(s2) - EPS) & (p[:, 2] <= self.upper.height(s2) + EPS)
                offer(t, n, between & (self.lattice.in_cell(p) | (not self.lattice.fills_cell)))
        return best, normal

    def upright(self, o, d):
        """(t, outward normals) where lines in a lens's frame meet the upright sides of its body: of its cell, or of a round lens or strip narrower than that."""
        shape = self.lattice.shape
        if not self.lattice.fills_cell and self.plate:
            return
        if not self.lattice.fills_cell and self.lattice.across.all():
            a = d[:, 0] ** 2 + d[:, 1] ** 2
            b = o[:, 0] * d[:, 0] + o[:, 1] * d[:, 1]
            disc = b * b - a * (o[:, 0] ** 2 + o[:, 1] ** 2 - self.upper.semi**2)
            for sign in (-1, 1):
                with np.errstate(divide="ignore", invalid="ignore"):
                    t = np.where(disc >= 0, (-b + sign * np.sqrt(np.maximum(disc, 0))) / a, np.inf)
                yield t, _at(o, d, t) * [1, 1, 0] / self.upper.semi
            return
        for n, half in zip(shape.normals, shape.half if self.lattice.fills_cell else [self.upper.semi]):
            for sign in (-1, 1):
                with np.errstate(divide="ignore", invalid="ignore"):
                    t = (sign * half - o[:, :2] @ n) / (d[:, :2] @ n)
                yield t, np.broadcast_to([*(sign * n), 0.0], o.shape)

    def offer_steps(self, t, p, n, i, j, offer):
        """Upright faces of a plate whose lenses fill their cells: where a cap ends beside one of another height, or beside the flat sheet.

        p: points on the sides of the cells (i, j) whose outward normals are n. Glass is where the upper face is higher, the lower face lower.
        """
        near = np.flatnonzero(np.isfinite(t) & self.lattice.in_cell(p) & (p[:, 2] >= self.z_min - EPS) & (p[:, 2] <= self.z_max + EPS))
        at, axis = p[near], self.lattice.axis(i[near], j[near])
        beyond = at + axis + n[near] * 1e-6
        i2, j2, on = self.lattice.cell(beyond)
        there = at + axis - self.lattice.axis(i2, j2)
        for surface, sign in ((self.upper, 1), (self.lower, -1)):
            here, next_door = self.plate_height(surface, at, True), self.plate_height(surface, there, on)
            step = sign * (here - next_door)
            found = (np.abs(step) > EPS) & (at[:, 2] >= np.minimum(here, next_door) - EPS) & (at[:, 2] <= np.maximum(here, next_door) + EPS)
            valid, outward = np.zeros(len(t), bool), n.copy()
            valid[near], outward[near] = found, np.sign(step)[:, None] * n[near]
            offer(t, outward, valid)

    def plate_height(self, surface, q, on):
        """z of a plate's face at points relative to the axis of the lens in whose cell they are; flat outside its aperture and where no lens is (on False)."""
        s2 = surface.squared(q)
        return np.where(on & (s2 <= surface.semi**2), surface.height(s2), surface.z_rim)

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


def trace_glass(path, display, lattice, glass=None):
    """glass: what tells the next boundary; by default that of a perfect array."""
    glass = glass or Glass(display, lattice)
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
            n1 = np.where(inside[rays], glass.index, 1.0)
            n2 = 1 + glass.index - n1
            down = glass.glued & leaving & (normal[:, 2] < 0)  # through the face that is glued on; a lower face is flat then
            n2[down] = glass.lower.n_below
            path.met[rays] += n1 != n2  # a face between equal indices is none
            path.meet(rays, i, j, glass.plate & (normal[:, :2] == 0).all(axis=1))
            many = path.met[rays] > MOST_SURFACES
            path.status[rays[many]] = TOO_MANY
            path.advance(rays, t, display, lattice)
            bi[rays], bj[rays] = i, j
            bent, mirrored, cos1, cos2, total = refract(path.d[rays], normal, n1, n2)
            path.d[rays] = np.where(total[:, None], mirrored, bent)
            path.weight[rays] *= np.where(total, 1.0, transmittance(cos1, cos2, n1, n2, display.render.fresnel))
            inside[rays] = np.where(total, inside[rays], ~inside[rays])
            into_layers = rays[down & ~total]
            path.to_panel(into_layers[path.status[into_layers] == ALIVE], display, lattice, glass.lower.n_below)


def _at(o, d, t):
    """Points at t along the lines; at 0 where t is not finite."""
    return o + np.where(np.isfinite(t), t, 0)[:, None] * d
