"""What the checks of self_check.py share: displays in few words, rays, where they land, when two results are the same. Lengths in mm."""
import math

import numpy as np

import tracer
from display import resolve
from path import OFF_PANEL, PANEL

P = 8.0
LENS = {"type": "plano_convex", "sphere_radius_mm": 7.0, "aperture_radius_mm": 3.9, "cylinder_height_mm": 1.0, "index": 1.5}
FACING = {**LENS, "facing": "panel"}
ASPHERE = {"type": "surfaces", "surface": [{"curvature_per_mm": 0.02, "semi_aperture_mm": 3.9, "distance_mm": 3.0, "index": 1.5, "conic": -1.5},
                                           {"curvature_per_mm": -0.12, "semi_aperture_mm": 3.9, "even_asphere": [1e-4]}]}
IDEAL, PINHOLE = {"type": "ideal", "focal_length_mm": 11.0, "aperture_radius_mm": 3.9}, {"type": "pinhole", "aperture_radius_mm": 2.0}
LATTICES = {"square": {}, "rectangle": {"pitch_mm": [9.0, P]}, "brick": {"pitch_mm": [8.4, 7.9]}, "hexagon": {}, "strips": {}}
LAYERS = [{"thickness_mm": 1.9, "index": 1.52}, {"thickness_mm": 0.3, "index": 1.41}]


def display(lens, lattice="hexagon", layers=(), fresnel="none", panel=(), content=(), wavelength_samples=1, errors=None, **array):
    """A display of 9 x 8 lenses (strips 9), 9 mm above the panel unless a gap is given, before a panel of 400 x 400 mm."""
    base = {} if "gap_mm" in array else {"base_z_mm": 9.0}
    given = {"pitch_mm": P, **base, **LATTICES[lattice], "lattice": lattice, "count": [9, 1] if lattice == "strips" else [9, 8], **array}
    return resolve({**({} if errors is None else {"errors": errors}), "panel": {"pixels": [4000, 4000], "pixel_pitch_mm": 0.1, "layer": list(layers), **dict(panel)}, "lens": lens, "array": given,
                    "content": dict(content), "render": {"fresnel": fresnel, "wavelength_samples": wavelength_samples}})


def rays(n=1500, steepest=60.0, wide=26.0, seed=1):
    """n rays towards points of the square |x|, |y| <= wide in z = 12, up to `steepest` degrees off the normal: points (n, 3), unit directions (n, 3)."""
    rng = np.random.default_rng(seed)
    aim = np.column_stack([rng.uniform(-wide, wide, (n, 2)), np.full(n, 12.0)])
    off, about = np.radians(steepest) * np.sqrt(rng.random(n)), 2 * np.pi * rng.random(n)
    d = np.column_stack([np.sin(off) * np.cos(about), np.sin(off) * np.sin(about), -np.cos(off)])
    return aim - 60 * d, d


def land(d, o, direction):
    """The hits of rays, with `at`, where they meet the panel's plane in mm (n, 2); nan for those that do not."""
    hits = tracer.trace(d, o, direction)
    (columns, rows), a = d.panel.pixels, d.panel.pixel_pitch_mm
    reached = np.isin(hits.status, (PANEL, OFF_PANEL))
    hits.at = np.where(reached[:, None], np.column_stack([hits.x * a - columns * a / 2, rows * a / 2 - hits.y * a]), np.nan)
    return hits


def same(a, b, least=0.999, tolerance=1e-6):
    """Whether two sets of hits end alike: all but a few rays, that meet a border, at the same place and with the same weight."""
    alike = (a.status == b.status) & (np.isnan(a.at).all(axis=1) | (np.abs(a.at - b.at) < tolerance).all(axis=1)) & (np.abs(a.weight - b.weight) < tolerance)
    return alike.mean() >= least and np.isfinite(a.at).any(), f"{100 * alike.mean():.2f} % alike"


def close(got, wanted, tolerance=1e-9):
    error = np.abs(np.asarray(got) - wanted).max()
    return bool(error <= tolerance), f"largest difference {error:.1e}"


def turned(v, degrees):
    """Points or directions (n, 3 or 2), counter-clockwise about z."""
    a = np.radians(degrees)
    return np.column_stack([v[:, 0] * np.cos(a) - v[:, 1] * np.sin(a), v[:, 0] * np.sin(a) + v[:, 1] * np.cos(a), v[:, 2:]])


def brute_owner(lattice, p):
    """Of points (n, 2) in the array's frame: number of cells that hold each, and the first of those as (i, j), by testing every lens."""
    i, j = (k.ravel() for k in np.meshgrid(np.arange(lattice.nx), np.arange(lattice.ny)))
    corners = np.radians(np.arange(30, 390, 60))
    hexagon = lattice.pitch[0] / math.sqrt(3) * np.column_stack([np.cos(corners), np.sin(corners)])
    q = p[:, None, :] - lattice.axis(i, j)[None, :, :2]
    if len(lattice.shape.half) == 3:  # left of all sides of the polygon
        edge = np.roll(hexagon, -1, axis=0) - hexagon
        inside = np.all([e[0] * (q[:, :, 1] - c[1]) - e[1] * (q[:, :, 0] - c[0]) >= 0 for c, e in zip(hexagon, edge)], axis=0)
    else:
        inside = (np.abs(q) <= np.where(lattice.across > 0, lattice.pitch / 2, np.inf)).all(axis=2)
    first = inside.argmax(axis=1)
    return inside.sum(axis=1), i[first], j[first]
