"""Checks of the reduced gap, the theory and the nodal pick-up by traced rays. Each returns (good, what was found)."""
import math

import numpy as np

import pickup
from check_tools import ASPHERE, FACING, IDEAL, LAYERS, LENS, P, PINHOLE, brute_owner, close, display, land, turned
from display import exact_field
from lattice import Lattice


def paraxial_rays(lens, given):
    """Close to the axis: parallel light at the height h lands at h (1 - g/f), light through the rear principal point with the slope m at -m g."""
    d = display(lens, "square", count=[9, 9], surround="plate" if lens["type"] == "plano_convex" else "opaque", **given)
    h, g, f = 1e-4, d.gap, d.paraxial.f
    rear = np.array([0.0, 0.0, d.paraxial.rear])
    o = np.array([[h, 0, 60.0], rear + 60 * np.array([h, 0, 1])])
    u = np.array([[0.0, 0.0, -1.0], [-h, 0.0, -1.0]])
    at = land(d, o, u).at[:, 0]
    return close(at / h, [1 - g / f, -g], 1e-6)


def gap_given():
    """A display with its own reduced gap given stands where it stood."""
    for lens in (LENS, FACING, ASPHERE, IDEAL):
        placed = display(lens, layers=LAYERS)
        again = display(lens, layers=LAYERS, gap_mm=placed.gap)
        if abs(again.vertex_plane - placed.vertex_plane) > 1e-12:
            return False, f"{lens['type']}: {again.vertex_plane}, {placed.vertex_plane}"
    return True, "four lenses"


def exact_fields():
    """The ray at the end of the exact field, through the pinhole above the panel's centre, ends at the end of the elemental image."""
    for name, left in (("hexagon", P / 4), ("brick", 8.4 / 4), ("strips", 0.0)):  # how far to the left the only lens of a row stands
        d = display(PINHOLE, name, layers=LAYERS, count=[1, 1], offset_mm=[left, 0.0], content={"viewing_distance_mm": 500.0})
        slope = math.tan(math.radians(exact_field(d)[0] / 2))
        at = land(d, np.array([[slope * 50, 0.0, 59.0]]), np.array([[-slope, 0.0, -1.0]])).at[0, 0]
        ok, found = close(at, -d.cell.width[0] / 2 * (1 + d.gap / (500.0 - 9.0)), 1e-9)
        if not ok:
            return ok, f"{name}: {found}"
    return ok, found


def picked_up(name, distance):
    """Nodal pick-up, ideal lenses without layers: the line of the panel point that a ray from the eye meets, through a lens's centre, is that ray."""
    d = display(IDEAL, name, rotation_deg=-18.0, aperture="cell", content={"viewing_distance_mm": distance})
    lattice, rng = Lattice(d), np.random.default_rng(8)
    n = 300
    i, j = rng.integers(0, lattice.nx, n), rng.integers(0, lattice.ny, n)
    on_axis = lattice.axis(i, j) + np.column_stack([np.zeros(n), rng.uniform(-30, 30, n) * (1 - lattice.across[1]), np.full(n, 9.0)])
    through = lattice.leave(on_axis, on_axis)[0]
    eye = np.array([0.0, 0.0, distance]) + np.column_stack([rng.uniform(-0.2, 0.2, n) * distance, np.zeros((n, 2))])
    at = land(d, eye, through - eye).at
    lines = pickup.nodal_lines(d, at)
    own = lines.owned & (lines.lens[:, 0] == i) & (lines.lens[:, 1] == j)
    slope = (eye - through)[:, :2] / (eye - through)[:, 2:]
    ok, found = close(np.column_stack([lines.start, lines.slope])[own], np.column_stack([through, slope])[own], 1e-7)
    return ok and own.sum() > 60, f"{found}, {own.sum()} lines"


def picked_up_through_glass(lens, base):
    """Strips of glass on layers, close to the axis: the line of a panel point leads from the eye line y = 0, z = D back to that point."""
    d = display(lens, "strips", layers=LAYERS, base_z_mm=base, rotation_deg=-18.0, content={"viewing_distance_mm": 900.0})
    points = np.random.default_rng(11).uniform(-0.04, 0.04, (200, 2))
    lines = pickup.nodal_lines(d, points)
    eye = lines.start + (900.0 - d.paraxial.rear) * np.column_stack([lines.slope, np.ones(200)])
    at = land(d, eye, lines.start - eye).at
    return close(np.column_stack([at, eye[:, 1]]), np.column_stack([points, np.zeros(200)]), 2e-5)  # of third order


def picked_up_far():
    """Strips for a viewer without end are those for one far away; owners do not change with the sign of the slant but by mirroring."""
    points = np.random.default_rng(9).uniform(-25, 25, (500, 2))
    far, endless = (pickup.nodal_lines(display(ASPHERE, "strips", layers=LAYERS, rotation_deg=-18.0, content={"viewing_distance_mm": v}), points) for v in (1e9, math.inf))
    left = pickup.nodal_lines(display(IDEAL, "strips", slant_deg=18.0), points)
    right = pickup.nodal_lines(display(IDEAL, "strips", slant_deg=-18.0), points * [-1, 1])
    ok, found = close(np.column_stack([far.start, far.slope]), np.column_stack([endless.start, endless.slope]), 1e-5)
    return ok and (left.lens[:, 0] == 8 - right.lens[:, 0]).all() and close(left.slope, right.slope * [-1, 1])[0], found


def picked_up_owner(name):
    """The owner is the lens whose cell, scaled to the elemental images' pitch, holds the point."""
    d = display(IDEAL, name, rotation_deg=33.0, offset_mm=[1.1, -0.7], content={"viewing_distance_mm": 300.0})
    points = pickup.pixel_centres(d, *np.random.default_rng(10).integers(1650, 2350, (2, 3000)))
    lines, stretch = pickup.nodal_lines(d, points), 1 + 9.0 / (300.0 - 9.0)
    held, i, j = brute_owner(Lattice(d), turned(points / stretch - [1.1, -0.7], -33))
    good = ((held > 0) == lines.owned) & (~lines.owned | ((lines.lens == np.column_stack([i, j])).all(axis=1)))
    return bool(good.all()), f"{100 * good.mean():.2f} % of the points"
