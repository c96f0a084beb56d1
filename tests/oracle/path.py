"""The state of a batch of rays on their way from the camera to the panel, the stop that any of their steps may cross, the layers at the end."""
import numpy as np

from surface import refract, transmittance

ALIVE, PANEL, OFF_PANEL, BLACK, TOTAL, ESCAPED, TOO_MANY, LOST = range(8)
# ALIVE: under way. PANEL: reached a panel pixel. OFF_PANEL: passed the panel's plane outside it. BLACK: absorbed. TOTAL: total internal
# reflection, absorbed. ESCAPED: turned away from the panel. TOO_MANY: met more than 16 surfaces. LOST: a fault of this program.


class Path:
    """Rays in the array's frame: points o, unit directions d, Fresnel weight, status, surfaces met, the first lens met (n, 2), and the way: a number of
    all lenses met."""

    def __init__(self, o, d):
        n = len(o)
        self.o, self.d, self.weight = o.copy(), d.copy(), np.ones(n)
        self.status, self.met, self.way = np.full(n, ALIVE), np.zeros(n, np.int64), np.zeros(n, np.uint64)
        self.stop_seen = np.zeros(n, bool)
        self.lens = np.full((n, 2), -1)  # the first one met; -1: none, or flat faces of a sheet alone

    def meet(self, rays, i, j, flat=False):
        """Adds lenses (i, j), -1 between lenses, to the ways of the rays. Where `flat` the face is the same as between lenses: none is met."""
        fresh = (self.lens[rays, 0] < 0) & ~np.broadcast_to(flat, len(rays))
        self.lens[rays[fresh]] = np.column_stack([i, j])[fresh]
        here = ((i + 1) * 65536 + j + 2).astype(np.uint64)
        self.way[rays] = self.way[rays] * np.uint64(1000003) + here

    def alive(self):
        return np.flatnonzero(self.status == ALIVE)

    def advance(self, rays, t, display, lattice):
        """Moves rays (indices) by t along their directions; those whose first passage of the stop's plane misses its holes end."""
        p = self.o[rays] + t[:, None] * self.d[rays]
        if display.stop_radius:
            z = display.stop_z
            crosses = ~self.stop_seen[rays] & (self.o[rays, 2] > z) & (p[:, 2] <= z)
            with np.errstate(divide="ignore", invalid="ignore"):
                at = self.o[rays] + ((z - self.o[rays, 2]) / self.d[rays, 2])[:, None] * self.d[rays]
            at[~crosses] = 0
            self.stop_seen[rays] |= crosses
            self.status[rays[crosses & (lattice.to_nearest_axis(at) > display.stop_radius)]] = BLACK
        self.o[rays] = p

    def to_panel(self, rays, display, lattice, medium=1.0):
        """Rays that meet no more lens go through the layers to z = 0, or away from it. medium: the index they are in, air or what a lens is glued to."""
        down = self.d[rays, 2] < 0
        self.status[rays[~down]] = ESCAPED
        rays = rays[down]
        self.advance(rays, (display.layer_top - self.o[rays, 2]) / self.d[rays, 2], display, lattice)
        for thickness, index in reversed(display.layers):
            rays = rays[self.status[rays] == ALIVE]
            n1, n2 = np.full(len(rays), medium), np.full(len(rays), index)
            bent, _, cos1, cos2, total = refract(self.d[rays], np.broadcast_to([0.0, 0.0, 1.0], (len(rays), 3)), n1, n2)
            self.d[rays] = bent
            self.weight[rays] *= transmittance(cos1, cos2, n1, n2, display.render.fresnel)
            self.status[rays[total]] = TOTAL
            rays, medium = rays[~total], index
            self.advance(rays, -thickness / self.d[rays, 2], display, lattice)
        rays = rays[self.status[rays] == ALIVE]
        self.status[rays] = OFF_PANEL  # until the panel is asked
