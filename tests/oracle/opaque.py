"""Lenses in a black sheet, the ideal lens and the pinhole: light passes each surface of one lens once, in order, or is absorbed."""
import numpy as np

from path import ALIVE, BLACK, ESCAPED, TOTAL
from surface import EPS, refract, transmittance


def trace_ideal(path, display, lattice):
    """A thin lens or a hole: the panel-side slope is the viewer-side one plus q / f, q the point of passage from the axis; along strips it stays."""
    rays = path.alive()
    path.status[rays[path.d[rays, 2] >= 0]] = ESCAPED
    rays = path.alive()
    path.advance(rays, (display.lens_z - path.o[rays, 2]) / path.d[rays, 2], display, lattice)
    rays = path.alive()
    p, d = path.o[rays], path.d[rays]
    i, j, on = lattice.cell(p)
    q = p - lattice.axis(i, j)
    inside = on & (display.fills_cell | lattice.in_aperture(q, getattr(display.lens, "aperture_radius_mm", np.inf), 0.0))
    path.status[rays[~inside]] = BLACK
    path.meet(rays[inside], i[inside], j[inside])
    slope = d[:, :2] / d[:, 2:] + q[:, :2] * lattice.across * display.power
    d = -np.column_stack([slope, np.ones(len(slope))])  # downwards: dz = -1
    path.d[rays] = d / np.linalg.norm(d, axis=1, keepdims=True)
    path.to_panel(path.alive(), display, lattice)


def trace_opaque(path, display, lattice):
    surfaces, top = display.surfaces, display.surfaces[-1]
    # The black sheet fills the heights from the lowest to the highest rim.
    floor, ceiling = min(s.z_rim for s in surfaces), max(s.z_rim for s in surfaces)
    rays = path.alive()
    path.status[rays[path.d[rays, 2] >= 0]] = ESCAPED
    rays = path.alive()
    o, d = path.o[rays], path.d[rays]
    reach = lattice.shape.extent if lattice.fills_cell else top.semi
    t0, t1 = (max(top.z_max, ceiling) - o[:, 2]) / d[:, 2], (top.z_min - EPS - o[:, 2]) / d[:, 2]
    t, normal, i, j = lattice.first_hit(o, d, t0, t1, reach, lambda o, d, i, j: entry(top, ceiling, o, d, lattice))
    axis = lattice.axis(i, j)  # of the lens each ray went into
    hit = np.isfinite(t)
    path.status[rays[~hit]] = BLACK
    path.meet(rays[hit], i[hit], j[hit])
    rays, t, normal, axis = rays[hit], t[hit], normal[hit], axis[hit]
    for number in reversed(range(len(surfaces))):
        here = surfaces[number]
        path.advance(rays, t, display, lattice)
        n1, n2 = np.full(len(rays), here.n_above), np.full(len(rays), here.n_below)
        bent, _, cos1, cos2, total = refract(path.d[rays], normal, n1, n2)
        path.weight[rays] *= transmittance(cos1, cos2, n1, n2, display.render.fresnel)
        path.d[rays] = bent
        path.status[rays[total & (path.status[rays] == ALIVE)]] = TOTAL
        keep = path.status[rays] == ALIVE
        rays, axis = rays[keep], axis[keep]
        if number:
            t, normal = passage(surfaces[number - 1], path.o[rays] - axis, path.d[rays], lattice)
            missed = ~np.isfinite(t)
            path.status[rays[missed]] = BLACK
            rays, t, normal, axis = rays[~missed], t[~missed], normal[~missed], axis[~missed]
    # A surface hollow towards the panel lies inside the sheet: the way out is through the hole in its lower face.
    o, d = path.o[rays] - axis, path.d[rays]
    with np.errstate(divide="ignore", invalid="ignore"):
        at_face = o + ((floor - o[:, 2]) / d[:, 2])[:, None] * d
    blocked = (o[:, 2] > floor + EPS) & (d[:, 2] < 0) & ~lattice.in_aperture(at_face, surfaces[0].semi)
    path.status[rays[blocked]] = BLACK
    path.to_panel(path.alive(), display, lattice, surfaces[0].n_below)


def entry(top, ceiling, o, d, lattice):
    """The first entry through a lens's top surface, in its frame. One below the black sheet's upper face, at `ceiling`, counts if the ray came in through
    the same lens's hole."""
    with np.errstate(divide="ignore", invalid="ignore"):
        at_face = o + ((ceiling - o[:, 2]) / d[:, 2])[:, None] * d
    through = (d[:, 2] < 0) & lattice.in_aperture(at_face, top.semi)
    return passage(top, o, d, lattice, lambda p: through | (p[:, 2] >= ceiling - EPS))


def passage(surface, o, d, lattice, counts=lambda p: True):
    """The first downward passage through a surface, in the frame of its lens, where counts(points) holds: (t, normal), t = inf for none."""
    best, normal = np.full(len(o), np.inf), np.zeros((len(o), 3))
    for t in surface.roots(o, d):
        p = o + np.where(np.isfinite(t), t, 0)[:, None] * d
        n = surface.normal(p)
        ok = (t > -EPS) & (t < best) & (np.sum(d * n, axis=1) < 0) & lattice.in_aperture(p, surface.semi) & counts(p)
        best[ok], normal[ok] = t[ok], n[ok]
    return best, normal
