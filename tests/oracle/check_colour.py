"""Checks of subpixels, glasses and wavelengths against closed forms and brute force. Each returns (good, what was found)."""
import math
from types import SimpleNamespace

import numpy as np

import colour
import dispersion
import pickup
from check_tools import FACING, IDEAL, LAYERS, LENS, PINHOLE, close, display, land
from colour_cases import CORNERS, ODD, QUAD, RGBG, SPARSE, SWAPPED, VIVID, of
from display import focus
from lattice import Lattice
from subpixels import PRESETS, Subpixels

CUSTOM = {"odd": ODD, "corners": CORNERS, "swapped": SWAPPED, "sparse": SPARSE, "quads": QUAD, "rgbg": RGBG}
KINDS = ["none", *PRESETS, *CUSTOM]


def panel(kind, q=1.0, pixels=(24, 18)):
    """A panel's part of a display with subpixels of this kind."""
    cell = {"subpixels": "custom", "subpixel_cell": CUSTOM[kind][0], "subpixel": CUSTOM[kind][1]} if kind in CUSTOM else {"subpixels": kind}
    return {**cell, "aperture_ratio": q, "pixels": list(pixels)}


def subpixels(kind, q=1.0, pixels=(24, 18)):
    return Subpixels(SimpleNamespace(**panel(kind, q, pixels)))


# What a panel of 2 x 2 pixels shows: a row of letters every 1/6 pixel along a line in the middle of each row of pixels, small letters for pixels off the panel.
PICTURES = {
    "rgb_stripe": ["RRGGBBRRGGBB"] * 2, "bgr_stripe": ["BBGGRRBBGGRR"] * 2,
    "pentile_rgbg": ["RRRGGGBBBGGG", "BBBGGGRRRGGG"], "delta": ["RRGGBBRRGGBB", "gbbRRGGBBRRG"],
}


def drawn(kind):
    """The presets, drawn."""
    parts, found = subpixels(kind, pixels=(2, 2)), []
    for row in range(2):
        line = [" "] * 12
        for c in range(3):
            number, column, at = met = parts.met(c, (np.arange(12) + 0.4) / 6, np.full(12, row + 0.5))
            for k in np.flatnonzero(number >= 0):
                line[k] = "RGB"[c] if parts.shown(*met)[k] else "rgb"[c]
        found.append("".join(line))
    return found == PICTURES[kind], " ".join(found)


def rows_drawn():
    """Full-width stripes, red uppermost."""
    parts, y = subpixels("rgb_rows"), np.array([0.1, 0.5, 0.9])
    return all((np.flatnonzero(parts.met(c, np.full(3, 0.5), y)[0] >= 0) == c).all() for c in range(3)), "three rows"


def by_brute_force(kind, q):
    """Every rectangle of every cell about a small panel, tested one by one: what a point meets, and that channels and repetitions never overlap."""
    columns, rows = 7, 5
    parts = subpixels(kind, q, (columns, rows))
    size, rectangles = CUSTOM[kind] if kind in CUSTOM else PRESETS[kind]
    at = np.random.default_rng(4).uniform([0, 0], [columns, rows], (3000, 2))
    wanted, hits = np.full((3, len(at), 2), -99), np.zeros(len(at), int)
    for m in range(-3, columns + 3):
        for n in range(-3, rows + 3):
            for row in rectangles:
                x0, y0, x1, y1 = row["rect"]
                middle = np.array([m * size[0] + (x0 + x1) / 2, n * size[1] + (y0 + y1) / 2])
                inside = (2 * np.abs(at - middle) < math.sqrt(q) * np.array([x1 - x0, y1 - y0])).all(axis=1)
                hits += inside
                wanted["rgb".index(row["channel"]), inside] = [m * size[0] + row["pixel"][0], n * size[1] + row["pixel"][1]]
    good = hits.max() == 1
    for c in range(3):
        met = parts.met(c, *at.T)
        good &= ((met[0] >= 0) == (wanted[c, :, 0] > -99)).all() and (met[1:].T == wanted[c])[met[0] >= 0].all()
        on = ((wanted[c] >= 0) & (wanted[c] < [columns, rows])).all(axis=1)
        good &= (parts.shown(*met) == on).all()
    return bool(good), f"{100 * (hits > 0).mean():.0f} % shine"


def white(kind, q):
    """White's mean over whole cells in the middle of a panel is 1 in every channel, by points as even as a Latin square."""
    parts = subpixels(kind, q)
    n = 1 << 17
    at = 6.0 + 6.0 * np.column_stack([(np.arange(n) + 0.5) / n, (np.arange(n) * 0.6180339887498949) % 1])  # 6 x 6 pixels: whole cells of every kind
    means = [parts.gain[c] * parts.shown(*parts.met(c, *at.T)).mean() for c in range(3)]
    return close(means, 1.0, 1e-3)


def behind_lenses(kind, q):
    """A white panel through an array, averaged over many rays: white, but for the lenses' edges; each ray carries one channel at most."""
    d = display(IDEAL, "square", panel=panel(kind, q, (1000, 1000)), aperture="cell")
    rng, n = np.random.default_rng(12), 40000
    o = np.column_stack([rng.uniform(-16, 16, (n, 2)), np.full(n, 12.0)])
    u = np.column_stack([rng.uniform(-0.2, 0.2, (n, 2)), np.full(n, -1.0)])
    seen = colour.shade(d, colour.trace(d, o, u), np.broadcast_to(1.0, (1000, 1000, 3)))
    one = ((seen > 0).sum(axis=1) <= 1).all() or kind == "none"
    ok, found = close(seen.mean(axis=0), 1.0, 6 * seen.std(axis=0).max() / math.sqrt(n))
    return bool(ok and one), found


def centroids(kind, q):
    """The centres of gravity that content is made for, from points spread over the panel."""
    columns, rows = 12, 12
    parts = subpixels(kind, q, (columns, rows))
    line = (np.arange(600) + 0.5) / 50
    x, y = (v.ravel() for v in np.meshgrid(line, line))
    for c in range(3):
        number, column, row = parts.met(c, x, y)
        inner = (number >= 0) & (column > 2) & (column < 9) & (row > 2) & (row < 9)
        key = (row * columns + column)[inner]
        count = np.bincount(key, minlength=144)
        at = np.column_stack([np.bincount(key, v[inner], 144) for v in (x, y)]) / np.maximum(count, 1)[:, None]
        j, i = np.divmod(np.arange(144), columns)
        middle = (i > 2) & (i < 9) & (j > 2) & (j < 9)
        point, shows = parts.centroids(c, i, j)
        if (shows != (count > 0))[middle].any() or np.abs(point - at)[middle & shows].max() > 0.02:
            return False, f"channel {c}"
    return True, "3 channels"


def shrunk_in_place(kind):
    """A black matrix moves no centre, and the panel's frame has y upwards."""
    d = display(PINHOLE, panel=panel(kind, 0.3, (40, 30)))
    whole = display(PINHOLE, panel=panel(kind, 1.0, (40, 30)))
    i, j = np.arange(40), np.arange(40) // 2 % 30
    for c in range(3):
        small, shows = pickup.subpixel_points(d, c, i, j)
        if not close(small[shows], pickup.subpixel_points(whole, c, i, j)[0][shows], 1e-12)[0]:
            return False, "moved"
        off = (small - pickup.pixel_centres(d, i, j))[shows] / 0.1
        point = whole.subpixels.centroids(c, i, j)[0] - np.column_stack([i, j]) - 0.5
        if not close(off, (point * [1, -1])[shows], 1e-9)[0]:
            return False, "elsewhere"
    return True, "3 channels"


def made_for_eyes(kind):
    """Through a lens's centre an eye meets a subpixel whose content is made for a place beside it by at most half of what the subpixel's width covers there."""
    d = display(IDEAL, aperture="cell", rotation_deg=14.0, panel=panel(kind, 1.0, (1000, 1000)), content={"viewing_distance_mm": 650.0})
    lattice, rng, n = Lattice(d), np.random.default_rng(13), 2000
    axis = lattice.axis(rng.integers(0, lattice.nx, n), rng.integers(0, lattice.ny, n)) + [0.0, 0.0, 9.0]
    through = lattice.leave(axis, axis)[0]
    eye = np.column_stack([rng.uniform(-60, 60, (n, 2)), np.full(n, 650.0)])
    hits, tried = land(d, eye, through - eye), 0
    for c in range(3):
        number, column, row = met = d.subpixels.met(c, hits.x, hits.y)
        on = np.flatnonzero(d.subpixels.shown(*met))
        points, shows = pickup.subpixel_points(d, c, column[on], row[on])
        lines = pickup.nodal_lines(d, points)
        own = lines.owned & (np.abs(lines.start - through[on]) < 1e-9).all(axis=1)  # not those that belong to a neighbour
        at = lines.start[:, :2] + lines.slope * (650.0 - 9.0)
        mine = d.subpixels.channel == c
        reach = (d.subpixels.high - d.subpixels.low)[mine].max(axis=0) / 2 * 0.1 / d.gap * (650.0 - 9.0)
        if not shows.all() or (np.abs(at - eye[on, :2]) > reach + 1e-6)[own].any():
            return False, f"channel {c}"
        tried += own.sum()
    return bool(tried > 0.7 * n), f"{tried} lines"


FIGURES = {  # n_d, V_d
    "PMMA": (1.4925274, 59.367), "N-BK7": (1.5168000, 64.167), "PC": (1.5854699, 29.909),
    "one term": ({"sellmeier": [1.1819, 0.011313, 0, 0, 0, 0]}, 1.4906182, 53.18), "two figures": ({"nd": 1.4918, "vd": 57.4}, 1.4918, 57.4),
}


def glasses():
    """n_d and V_d of the glasses used, to the digits known."""
    for name, (*glass, nd, vd) in FIGURES.items():
        n = {line: dispersion.index_of({"glass": glass[0] if glass else name}, nm) for line, nm in (("d", dispersion.NM_D), ("F", dispersion.NM_F), ("C", dispersion.NM_C))}
        if abs(n["d"] - nd) > 6e-8 or abs((n["d"] - 1) / (n["F"] - n["C"]) - vd) > 6e-3:
            return False, f"{name}: {n}"
    n = dispersion.index_of({"glass": {"cauchy": [1.5, 0.01, 0.001]}}, 500.0)
    return close(n, 1.5 + 0.04 + 0.016, 1e-12)


def quadrature():
    """Gauss-Hermite sums give the moments of a normal distribution of the full width at half maximum given, as far as K nodes can."""
    sigma = 30.0 / (2 * math.sqrt(2 * math.log(2)))
    for samples in range(1, 9):
        nm, share = np.array(dispersion.wavelengths(550.0, 30.0, samples)).T
        for power in range(2 * samples):
            wanted = 0.0 if power % 2 else math.prod(range(1, power, 2)) * sigma**power
            if abs((share * (nm - 550.0) ** power).sum() - wanted) > 1e-9 * sigma**power * math.factorial(power):
                return False, f"{samples} nodes, power {power}"
    nm, share = np.array(dispersion.wavelengths(550.0, 30.0, 3)).T
    return close(np.append(nm, share), [550 - math.sqrt(3) * sigma, 550, 550 + math.sqrt(3) * sigma, 1 / 6, 2 / 3, 1 / 6], 1e-9)


def lensmaker(lens, radii, thickness, glass):
    """Focal lengths in three colours against the lensmaker's formula; parallel light of each colour near the axis lands where that colour's f and g say."""
    d = display(of(glass, lens), "square", layers=[{"thickness_mm": 2.0, "glass": VIVID}, LAYERS[1]], surround="clear", count=[9, 9])
    h, wanted = 1e-4, []
    for c, nm in enumerate(d.panel.wavelengths_nm):
        n = dispersion.index_of({"glass": glass}, nm)
        bent = [1 / r if r else 0.0 for r in radii]
        power = (n - 1) * (bent[0] - bent[1] + (n - 1) * thickness * bent[0] * bent[1] / n)
        wanted.append(1 / power)
        at = land(d.primaries[c], np.array([[h, 0.0, 60.0]]), np.array([[0.0, 0.0, -1.0]])).at[0, 0]
        if not close(at / h, 1 - d.primaries[c].gap / d.primaries[c].paraxial.f, 1e-6)[0]:
            return False, f"parallel light of channel {c}"
    f = np.array([f for f, _ in focus(d)])
    ok, found = close(f, wanted, 1e-9)
    return bool(ok and np.ptp(f) > 0.1), f"{found}, f = {np.round(f, 3)} mm"


LENSES = {"plano-convex": (LENS, (0, -7.0), 1.0 + 7.0 - math.sqrt(7.0**2 - 3.9**2)), "panel facing": (FACING, (7.0, 0), 1.0 + 7.0 - math.sqrt(7.0**2 - 3.9**2)),
          "biconvex": ({"type": "surfaces", "surface": [{"curvature_per_mm": 0.05, "semi_aperture_mm": 3.5, "distance_mm": 3.0},
                                                        {"curvature_per_mm": -0.1, "semi_aperture_mm": 3.5}]}, (20.0, -10.0), 3.0)}


def one_colour():
    """Glasses whose index does not change are constant indices, bit for bit; three wavelengths of them, too, but for the sum."""
    plain = display(LENS, "hexagon", layers=LAYERS, fresnel="exact", panel=panel("delta", 0.8, (1000, 1000)))
    constant = [{"thickness_mm": t["thickness_mm"], "glass": {"cauchy": [t["index"], 0, 0]}} for t in LAYERS]
    image = np.random.default_rng(1).random((1000, 1000, 3))
    rng = np.random.default_rng(2)
    o, u = np.column_stack([rng.uniform(-26, 26, (2000, 2)), np.full(2000, 40.0)]), np.column_stack([rng.uniform(-0.5, 0.5, (2000, 2)), np.full(2000, -1.0)])
    seen = []
    for over in ({}, {"primary_widths_nm": [20.0, 20.0, 20.0]}):
        d = display(of({"cauchy": [1.5, 0.0, 0.0]}, LENS), "hexagon", layers=constant, fresnel="exact", panel={**panel("delta", 0.8, (1000, 1000)), **over}, wavelength_samples=3 if over else 1)
        seen.append(colour.shade(d, colour.trace(d, o, u), image))
    wanted = colour.shade(plain, colour.trace(plain, o, u), image)
    return bool((seen[0] == wanted).all() and close(seen[1], wanted, 1e-12)[0] and (wanted > 0).sum() > 400), f"{(wanted > 0).sum()} lit"


def each_alone():
    """A channel's light is that of a display whose glass has the index of that channel's wavelength."""
    text = {"sellmeier": [1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653]}
    rng = np.random.default_rng(3)
    o, u = np.column_stack([rng.uniform(-26, 26, (2000, 2)), np.full(2000, 40.0)]), np.column_stack([rng.uniform(-0.5, 0.5, (2000, 2)), np.full(2000, -1.0)])
    image = rng.random((1000, 1000, 3))
    given = {"lattice": "brick", "fresnel": "exact", "panel": panel("pentile_rgbg", 0.6, (1000, 1000)), "surround": "plate"}
    d = display(of(text, LENS), layers=[{"thickness_mm": 2.0, "glass": VIVID}], **given)
    seen = colour.shade(d, colour.trace(d, o, u), image)
    for c, nm in enumerate(d.panel.wavelengths_nm):
        index, layer = (dispersion.index_of({"glass": glass}, nm) for glass in (text, VIVID))
        alone = display({**LENS, "index": index}, layers=[{"thickness_mm": 2.0, "index": layer}], **given)
        if not (colour.shade(alone, colour.trace(alone, o, u), image)[:, c] == seen[:, c]).all():
            return False, f"channel {c}"
    return bool((seen > 0).sum() > 400), f"{(seen > 0).sum()} lit"


def gap_of_green():
    """A gap given with a glass is green's: the other colours have gaps of their own, and heights are the same for all."""
    d = display(of(VIVID, FACING), layers=[{"thickness_mm": 2.0, "glass": VIVID}], gap_mm=9.0)
    heights = [[s.z for s in at.surfaces] for at in d.primaries]
    ok, found = close(np.array(heights), np.array([s.z for s in d.surfaces]), 1e-12)
    gaps = [at.gap for at in d.primaries]
    return bool(ok and abs(gaps[1] - 9.0) < 1e-12 and gaps[0] > 9.01 and gaps[2] < 8.99), f"{found}, gaps {np.round(gaps, 3)}"
