"""Checks of lattices: where lenses stand, which cell holds a point, how many cover a panel, symmetries. Each returns (good, what was found)."""
import math

import numpy as np

from cases import to_toml
from check_tools import IDEAL, LATTICES, LAYERS, LENS, P, PINHOLE, brute_owner, close, display, land, rays, same, turned
from display import resolve
from lattice import Lattice
from path import OFF_PANEL, PANEL


def written():
    """Descriptions say numbers of NumPy, alone, in lists and in tables, as plain ones."""
    row = {"glass": {"nd": np.float64(1.5)}, "semi": np.float32(0.5)}
    text = to_toml({"schema": np.int64(1), "lens": {"size": np.array([1.5, 2.0]), "pair": [np.float64(3.0), True], "surface": [row]}})
    wanted = "schema = 1\n[lens]\nsize = [1.5, 2.0]\npair = [3.0, true]\n[[lens.surface]]\nglass = { nd = 1.5 }\nsemi = 0.5\n"
    return text == wanted, text


def cells(name):
    """Every point of the array lies in one cell, the one that cell() names."""
    lattice = Lattice(display(IDEAL, name))
    p = np.random.default_rng(2).uniform(-40, 40, (4000, 2))
    held, i, j = brute_owner(lattice, p)
    gi, gj, on = lattice.cell(np.column_stack([p, np.zeros(len(p))]))
    good = ((held > 0) == on) & (~on | ((gi == i) & (gj == j)))
    return good.all() and held.max() == 1, f"{100 * good.mean():.2f} % of the points"


def neighbours():
    """Six hexagons stand at the distance p; rows of bricks are half a pitch apart in x, odd ones to the right."""
    lattice = Lattice(display(IDEAL, "hexagon"))
    i, j = (k.ravel() for k in np.meshgrid(np.arange(9), np.arange(8)))
    away = np.hypot(*(lattice.axis(i, j) - lattice.axis(np.array(4), np.array(3)))[:, :2].T)
    brick = Lattice(display(IDEAL, "brick")).axis(np.array([0, 0]), np.array([0, 1]))[:, :2]
    good = np.sum(np.abs(away - P) < 1e-9) == 6 and np.sort(away)[1] > P - 1e-9
    ok, found = close(brick, [[-4 * 8.4 - 2.1, -3.5 * 7.9], [-4 * 8.4 + 2.1, -2.5 * 7.9]])
    return good and ok, found


def counts(name):
    """The count that is found covers the panel, turned and moved; with a lens or a row less the upright one is not covered."""
    rng, tried = np.random.default_rng(3), 0
    for k in range(20):
        upright = k % 2 == 0
        size = [int(v) for v in rng.integers(60, 900, 2)]
        given = {"lattice": name, "pitch_mm": P, **LATTICES[name], "aperture": "cell", "base_z_mm": 9.0, "rotation_deg": 0.0 if upright else float(rng.uniform(-180, 180)),
                 "offset_mm": [0.0, 0.0] if upright else list(rng.uniform(-5, 5, 2))}
        text = {"panel": {"pixels": size, "pixel_pitch_mm": 0.1}, "lens": IDEAL, "array": given}
        least = resolve(text).array.count
        edge = np.linspace(-0.5, 0.5, 601)
        border = np.concatenate([np.column_stack([edge, np.full(601, s)]) for s in (-0.5, 0.5)] + [np.column_stack([np.full(601, s), edge]) for s in (-0.5, 0.5)])
        p = np.column_stack([border * np.array(size) * 0.1 * (1 - 1e-9), np.zeros(len(border))])

        def covered(count):
            lattice = Lattice(resolve({**text, "array": {**given, "count": count}}))
            return lattice.cell(lattice.enter(p, p)[0])[2].all()

        if not covered(least):
            return False, f"{least} {name} do not cover {size}, turned by {given['rotation_deg']}"
        fewer = [[least[0] - 1, least[1]], [least[0], least[1] - 1]]
        for count in fewer if upright and min(least) > 2 else []:  # one row of hexagons or bricks needs less
            tried += 1
            if covered(count):
                return False, f"{count} cover {size}, {least} were found"
    return True, f"20 panels; {tried} arrays of one lens or row less"


def turn_of_everything(name, lens, surround, aperture):
    """An array turned by 37 degrees and rays turned with it: the panel is met where it was, turned."""
    o, d = rays()
    straight = land(display(lens, name, surround=surround, aperture=aperture, fresnel="exact"), o, d)
    other = land(display(lens, name, surround=surround, aperture=aperture, fresnel="exact", rotation_deg=37.0), turned(o, 37), turned(d, 37))
    other.at = turned(other.at, -37)
    other.status = np.where(other.status == OFF_PANEL, PANEL, other.status)  # the panel itself does not turn
    straight.status = np.where(straight.status == OFF_PANEL, PANEL, straight.status)
    both = (straight.column >= 0) & (other.column >= 0)
    straight.weight, other.weight = np.where(both, straight.weight, 0), np.where(both, other.weight, 0)
    return same(straight, other)


def slant():
    """slant_deg is a turn clockwise: upper ends to the right."""
    o, d = rays()
    plain = display(LENS, "strips", rotation_deg=-20.0, aperture="circle")
    ok, found = same(land(plain, o, d), land(display(LENS, "strips", slant_deg=20.0), o, d), 1.0, 1e-12)
    up = Lattice(display(LENS, "strips", slant_deg=20.0)).leave(np.array([[0.0, 1.0, 0.0]]), np.zeros((1, 3)))[0][0]
    return ok and up[0] > 0, found


def along_strips(surround, aperture):
    """Strips moved along themselves are the same strips."""
    o, d = rays()
    a = math.radians(25)
    moved = [5.3 * math.sin(a), 5.3 * math.cos(a)]
    given = {"surround": surround, "aperture": aperture, "slant_deg": 25.0, "fresnel": "exact"}
    return same(land(display(LENS, "strips", **given), o, d), land(display(LENS, "strips", offset_mm=moved, **given), o, d))


def sixth_of_a_turn(lens, surround, aperture):
    """Hexagons turned by 60 degrees about a lens's axis stand where they stood. Rays near the middle: the arrays' borders differ."""
    o, d = rays(wide=9.0, steepest=35.0)
    found = []
    for turn in (0.0, 60.0):
        given = {"surround": surround, "aperture": aperture, "rotation_deg": turn, "fresnel": "exact", "count": [15, 15]}
        axis = Lattice(display(lens, **given)).axis(np.array([7]), np.array([7]))[0]
        to_middle = -turned(axis[None], turn)[0, :2]
        found.append(land(display(lens, offset_mm=to_middle.tolist(), **given), o, d))
    return same(*found)


def one_row(surround, aperture):
    """One row of bricks is a row of rectangles that stands a quarter pitch to the left."""
    o, d = rays(wide=6.0)
    given = {"surround": surround, "aperture": aperture, "count": [9, 1], "fresnel": "exact", "pitch_mm": [8.4, 7.9]}
    return same(land(display(LENS, "brick", **given), o, d), land(display(LENS, "rectangle", offset_mm=[-2.1, 0.0], **given), o, d))


def ideal_by_hand(name):
    """Filled cells of ideal lenses: the lens by testing every cell, then one line."""
    o, u = rays()
    d = display(IDEAL, name, aperture="cell")
    hits, lattice = land(d, o, u), Lattice(d)
    at = o + ((9.0 - o[:, 2]) / u[:, 2])[:, None] * u
    held, i, j = brute_owner(lattice, at[:, :2])
    q = (at - lattice.axis(i, j))[:, :2] * lattice.across
    on = held > 0
    ok, found = close(hits.at[on], (at[:, :2] - 9.0 * (u[:, :2] / u[:, 2:] + q / 11.0))[on])
    return ok and np.isnan(hits.at[~on]).all(), found


def pinhole_as_ideal(name):
    """A pinhole is an ideal lens of no power."""
    o, d = rays()
    return same(land(display(PINHOLE, name, layers=LAYERS), o, d), land(display({**IDEAL, "aperture_radius_mm": 2.0, "focal_length_mm": 1e12}, name, layers=LAYERS), o, d))


def stop_beyond_the_cell():
    """The hole of a stop reaches as far as its radius: over the border of its brick and of the array."""
    d = display({**IDEAL, "aperture_radius_mm": 3.0, "stop_radius_mm": 4.5}, "brick")
    lattice = Lattice(d)
    p = np.column_stack([np.random.default_rng(7).uniform(-42, 42, (4000, 2)), np.zeros(4000)])
    i, j = (k.ravel() for k in np.meshgrid(np.arange(9), np.arange(8)))
    every = np.hypot(*(p[:, None] - lattice.axis(i, j))[:, :, :2].transpose(2, 0, 1)).min(axis=1)
    near = every < 6  # farther than any hole reaches
    return close(lattice.to_nearest_axis(p)[near], every[near])
