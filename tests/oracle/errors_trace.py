"""Rays through arrays whose lenses are not where they should be: `opaque`, `ideal`, `pinhole`; of a `plate` see errors_plate.py.

Paths are in the display's frame. Every lens near a ray is looked at in its own frame, where it is the perfect lens, and the first that
is met has the ray.
"""
import numpy as np

from errors import MovedLattice
from errors_plate import MovedPlate
from glass import trace_glass
from opaque import entry, passage
from path import ALIVE, BLACK, ESCAPED, TOTAL, Path
from surface import EPS, refract, transmittance


def trace(display, o, d, status):
    """The path of rays, in the display's frame, from the diffuser to the panel's plane."""
    lattice, path = MovedLattice(display), MovedPath(o, d)
    path.status[:] = status
    if display.ideal:
        trace_ideal(path, display, lattice)
    elif display.array.surround == "opaque":
        trace_opaque(path, display, lattice)
    else:
        trace_glass(path, display, lattice, MovedPlate(display, lattice))
    return path


class MovedPath(Path):
    """As Path, in the display's frame. A stop's holes lie at heights of their own: a ray passes that goes down through any of them where
    it first gets so low."""

    def __init__(self, o, d):
        super().__init__(o, d)
        self.passed, self.lowest = np.zeros(len(o), bool), np.full(len(o), np.inf)

    def advance(self, rays, t, display, lattice):
        if display.stop_radius:
            self._cross_holes(rays, t, display, lattice)
        self.o[rays] += t[:, None] * self.d[rays]

    def _cross_holes(self, rays, t, display, lattice):
        """Notes the rays that pass a hole within t, and ends those that have come below all holes and passed none."""
        o, d = lattice.enter(self.o[rays], self.d[rays])
        before = np.where(np.isfinite(self.lowest[rays]), self.lowest[rays], o[:, 2])  # no height is passed over by rounding
        after = np.minimum(before, o[:, 2] + t * d[:, 2])
        self.lowest[rays] = after
        holes = display.stop_z + lattice.move[:, :, 2]
        k = np.flatnonzero((after < before) & (before > holes.min()) & (after <= holes.max()))

        def hole(q, u, i, j):
            s = (display.stop_z - q[:, 2]) / u[:, 2]
            away = np.sqrt((q + s[:, None] * u)[:, :2] ** 2 @ lattice.across)
            return np.where((s > -EPS) & (away <= display.stop_radius), s, np.inf), np.zeros((len(q), 3))

        start = o[k] + ((before - o[:, 2])[k] / d[k, 2])[:, None] * d[k]
        down = (after - before)[k] / d[k, 2]
        found = lattice.upright().first_hit(start, d[k], np.zeros(len(k)), down, display.stop_radius, hole)[0]
        self.passed[rays[k[np.isfinite(found)]]] = True
        self.status[rays[(before > holes.min()) & (after <= holes.min()) & ~self.passed[rays]]] = BLACK


def _going_down(path, lattice):
    """Rays that may meet a lens, and their points and directions in the array's frame; the others have escaped."""
    _, d = lattice.enter(path.o, path.d)
    path.status[(path.status == ALIVE) & (d[:, 2] >= 0)] = ESCAPED
    rays = path.alive()
    return rays, *lattice.enter(path.o[rays], path.d[rays])


def _first_lens(path, lattice, reach, hit):
    """Rays that meet a lens, by hit() as Lattice.first_hit has it: (rays, t, normal in the lens's frame, i, j). The others end."""
    rays, o, d = _going_down(path, lattice)
    t0, t1 = (lattice.high + EPS - o[:, 2]) / d[:, 2], (lattice.low - EPS - o[:, 2]) / d[:, 2]
    t, normal, i, j = lattice.first_hit(o, d, t0, t1, reach, hit)
    met = np.isfinite(t)
    path.status[rays[~met]] = BLACK
    rays, t, normal, i, j = (v[met] for v in (rays, t, normal, i, j))
    path.meet(rays, i, j)
    return rays, t, normal, i, j


def trace_ideal(path, display, lattice):
    """Thin lenses and holes: the first whose aperture a ray passes, in the lens's own plane, bends it as the perfect one does, with
    f / (1 + curvature)."""
    radius = getattr(display.lens, "aperture_radius_mm", 0.0)

    def hit(o, d, i, j):
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (display.lens_z - o[:, 2]) / d[:, 2]
        p = o + np.where(np.isfinite(t), t, 0)[:, None] * d
        inside = lattice.in_cell(p) if lattice.fills_cell else lattice.in_aperture(p, radius, 0.0)
        return np.where((d[:, 2] < 0) & (t > -EPS) & inside, t, np.inf), np.zeros((len(o), 3))

    rays, t, _, i, j = _first_lens(path, lattice, lattice.shape.extent if lattice.fills_cell else radius, hit)
    path.advance(rays, t, display, lattice)
    q, d = lattice.into_lens(*lattice.enter(path.o[rays], path.d[rays]), i, j)
    power = display.power * (1 + lattice.errors.bend[i, j])
    slope = d[:, :2] / d[:, 2:] + q[:, :2] * lattice.across * power[:, None]
    d = -np.column_stack([slope, np.ones(len(slope))])  # downwards: dz = -1
    path.d[rays] = lattice.out_of_lens(d / np.linalg.norm(d, axis=1, keepdims=True), i, j)
    path.to_panel(path.alive(), display, lattice)


def trace_opaque(path, display, lattice):
    """Lenses each in a black holder of its own. A ray enters the first whose outer surface it meets or, of hollow ones, whose hole in the
    holder's face, and then knows only that lens's surfaces and walls."""
    surfaces, top = display.surfaces, display.surfaces[-1]
    hollow = top.z < top.z_rim - EPS

    def faces(o, d, i, j):
        bent = [lattice.bent(s, i, j) for s in surfaces]
        ceiling = np.max([s.z_rim for s in bent], axis=0)
        if not hollow:
            return entry(bent[-1], ceiling, o, d, lattice)
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (ceiling - o[:, 2]) / d[:, 2]
        inside = (d[:, 2] < 0) & (t > -EPS) & lattice.in_aperture(o + np.where(np.isfinite(t), t, 0)[:, None] * d, top.semi)
        return np.where(inside, t, np.inf), np.zeros((len(o), 3))

    def next_surface(surface, rays, i, j):
        """Rays that come to it, without those that are lost on their way; as _first_lens."""
        q, u = lattice.into_lens(*lattice.enter(path.o[rays], path.d[rays]), i, j)
        t, normal = passage(lattice.bent(surface, i, j), q, u, lattice)
        met = np.isfinite(t)
        path.status[rays[~met]] = BLACK
        return rays[met], t[met], normal[met], i[met], j[met]

    rays, t, normal, i, j = _first_lens(path, lattice, lattice.shape.extent if lattice.fills_cell else top.semi, faces)
    if hollow:
        path.advance(rays, t, display, lattice)
        alive = path.status[rays] == ALIVE
        rays, t, normal, i, j = next_surface(top, rays[alive], i[alive], j[alive])
    for number in reversed(range(len(surfaces))):
        here = surfaces[number]
        path.advance(rays, t, display, lattice)
        n1, n2 = np.full(len(rays), here.n_above), np.full(len(rays), here.n_below)
        bent, _, cos1, cos2, total = refract(path.d[rays], lattice.out_of_lens(normal, i, j), n1, n2)
        path.d[rays] = bent
        path.weight[rays] *= transmittance(cos1, cos2, n1, n2, display.render.fresnel)
        path.status[rays[total & (path.status[rays] == ALIVE)]] = TOTAL
        alive = path.status[rays] == ALIVE
        rays, i, j = rays[alive], i[alive], j[alive]
        if number:
            rays, t, normal, i, j = next_surface(surfaces[number - 1], rays, i, j)
    q, u = lattice.into_lens(*lattice.enter(path.o[rays], path.d[rays]), i, j)
    # A surface hollow towards the panel lies inside the holder: the way out is through the hole in its lower face.
    floor = np.min([lattice.bent(s, i, j).z_rim for s in surfaces], axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        at_face = q + ((floor - q[:, 2]) / u[:, 2])[:, None] * u
    path.status[rays[(q[:, 2] > floor + EPS) & (u[:, 2] < 0) & ~lattice.in_aperture(at_face, surfaces[0].semi)]] = BLACK
    path.to_panel(path.alive(), display, lattice, surfaces[0].n_below)
