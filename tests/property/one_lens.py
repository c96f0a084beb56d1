"""Light of a panel point through one lens by itself, forward: fans of rays in the plane of the point and the lens's axis, their width at depths, and all of it.

A lens's own frame: x and y from its axis, z from the panel; depths from the rear principal plane. A fan along y (axis 1) is reckoned as one along x
that ends at the other borders of the cell: all else of a lens is round.
"""
import numpy as np

from surface import EPS, refract

FAN = 4001  # rays tried


def through(display, axis, x, slopes):
    """Rays from (x, 0, 0) with dx/dz = slopes: (place at the rear principal plane, slope) of each behind the lens, nan where it does not get through."""
    border = np.array([display.array.pitch_mm[axis] / 2, np.inf]) if display.fills_cell else np.full(2, np.inf)
    places, out = bent(display, border, [x, 0.0], np.column_stack([slopes, np.zeros_like(slopes), np.ones_like(slopes)]))
    return places[:, 0], out[:, 0]


def bent(display, border, start, d):
    """Rays from a point of the panel, along d (n, 3): (places (n, 2) at the rear principal plane, nan where they do not get through; slopes (n, 2))."""
    o = np.tile([*map(float, start), 0.0], (len(d), 1))
    d = d / np.linalg.norm(d, axis=1, keepdims=True)
    if display.ideal:
        slopes = d[:, :2] / d[:, 2:]
        q = o[:, :2] + slopes * display.lens_z
        inside = (np.abs(q) <= border + EPS).all(axis=1) & (np.hypot(*q.T) <= (display.stop_radius or np.inf) + EPS)
        if not display.fills_cell:
            inside &= np.hypot(*q.T) <= display.lens.aperture_radius_mm + EPS
        return np.where(inside[:, None], q, np.nan), slopes - q / display.lens.focal_length_mm
    ok = in_stop(display, o, d) if display.stop_z < display.surfaces[-1].z else np.ones(len(o), bool)
    for surface in display.surfaces:
        t, normal = forward(surface, o, d)
        ok &= np.isfinite(t)
        o = o + np.where(ok, t, 0.0)[:, None] * d
        ok &= (np.abs(o[:, :2]) <= border + EPS).all(axis=1)
        turned, _, _, _, total = refract(d, normal, np.full(len(o), surface.n_below), np.full(len(o), surface.n_above))
        ok &= ~total
        d = np.where(ok[:, None], turned, d)
    ok &= in_stop(display, o, d) if display.stop_z >= display.surfaces[-1].z else True
    slopes = d[:, :2] / d[:, 2:]
    return np.where(ok[:, None], o[:, :2] + (display.paraxial.rear - o[:, 2:]) * slopes, np.nan), slopes


def in_stop(display, o, d):
    at = o[:, :2] + ((display.stop_z - o[:, 2]) / d[:, 2])[:, None] * d[:, :2]
    return np.hypot(*at.T) <= (display.stop_radius or np.inf)


def forward(surface, o, d):
    """The first passage towards the viewer."""
    best, normal = np.full(len(o), np.inf), np.zeros((len(o), 3))
    normal[:, 2] = 1.0
    for t in surface.roots(o, d):
        p = o + np.where(np.isfinite(t), t, 0.0)[:, None] * d
        n = surface.normal(p)
        ok = np.isfinite(t) & (t > -EPS) & (t < best) & (np.sum(d * n, axis=1) > 0)
        best[ok], normal[ok] = t[ok], n[ok]
    return best, normal


def fan(display, axis, x=0.0):
    """The rays that get through, evenly spread and to the very rims: (places, slopes); empty if none does."""
    pitch = display.array.pitch_mm[axis]
    reach = 1.5 * pitch / min(s.z_min for s in display.surfaces) if display.surfaces else pitch / display.lens_z
    slopes = np.linspace(-reach, reach, FAN) - x / display.paraxial.front
    lit = np.flatnonzero(np.isfinite(through(display, axis, x, slopes)[0]))
    if not len(lit):
        return np.array([]), np.array([])
    ends = [rim(display, axis, x, slopes[lit[0]], slopes[max(lit[0] - 1, 0)]), rim(display, axis, x, slopes[lit[-1]], slopes[min(lit[-1] + 1, FAN - 1)])]
    places, out = through(display, axis, x, np.linspace(*ends, FAN))
    lit = np.isfinite(places)
    return places[lit], out[lit]


def rim(display, axis, x, passes, fails):
    """The last slope that gets through."""
    for _ in range(45):
        middle = 0.5 * (passes + fails)
        if np.isfinite(through(display, axis, x, np.array([middle]))[0][0]):
            passes = middle
        else:
            fails = middle
    return passes


GRIDS = (311, 293, 277, 263)  # of directions, across: each meets the rims elsewhere


def centroids(display, start, z):
    """(GRIDS, 2) mean places in the plane z = `z` of a panel point's light through the lens; None if none gets through.

    The light is equally dense in direction cosines. Each of the grids of these tells the place anew: by what they differ they are wrong.
    """
    border = display.array.pitch_mm / 2 if display.fills_cell else np.full(2, np.inf)
    low, high, found = np.full(2, -1.0), np.full(2, 1.0), []
    for n in (150, 150, *GRIDS):  # ever closer about those that get through
        step = (high - low) / n
        l, m = (v.ravel() for v in np.meshgrid(*(low[k] + step[k] * (np.arange(n) + 0.5) for k in (0, 1))))
        up = l**2 + m**2 < 1
        l, m = l[up], m[up]
        places, slopes = bent(display, border, start, np.column_stack([l, m, np.sqrt(1 - l**2 - m**2)]))
        lit = np.isfinite(places[:, 0])
        if not lit.any():
            return None
        found.append((places[lit] + (z - display.paraxial.rear) * slopes[lit]).mean(axis=0))
        if n not in GRIDS:
            low, high = np.array([l[lit].min(), m[lit].min()]) - step, np.array([l[lit].max(), m[lit].max()]) + step
    return np.array(found[2:])


def width_over_depth(rays, u):
    """Width of a fan at z = 1/u, divided by |z|; continuous in u (1/mm), also at 0."""
    at = rays[0] * u + rays[1]
    return at.max() - at.min()


def sharp_range(rays, most):
    """The range of u = 1/z where the fan's width is at most `most` |z|, or None. The width over |z| is convex in u."""
    low, high = -1.0, 1.0
    while width_over_depth(rays, low) <= width_over_depth(rays, 0.9 * low):
        low *= 2
    while width_over_depth(rays, high) <= width_over_depth(rays, 0.9 * high):
        high *= 2
    best = least(lambda u: width_over_depth(rays, u), low, high)
    if width_over_depth(rays, best) > most:
        return None
    return crossing(rays, most, best, low), crossing(rays, most, best, high)


def least(f, low, high):
    """Where a convex function is least, by golden sections."""
    ratio = (5**0.5 - 1) / 2
    a, b = high - ratio * (high - low), low + ratio * (high - low)
    fa, fb = f(a), f(b)
    for _ in range(90):
        if fa < fb:
            high, b, fb = b, a, fa
            a = high - ratio * (high - low)
            fa = f(a)
        else:
            low, a, fa = a, b, fb
            b = low + ratio * (high - low)
            fb = f(b)
    return 0.5 * (low + high)


def crossing(rays, most, inside, outside):
    while width_over_depth(rays, outside) <= most:
        outside += outside - inside
    for _ in range(80):
        middle = 0.5 * (inside + outside)
        if width_over_depth(rays, middle) <= most:
            inside = middle
        else:
            outside = middle
    return inside
