"""Checks of glass and layers against closed forms and points sampled along rays. Each returns (good, what was found)."""
import math

import numpy as np

from check_tools import ASPHERE, FACING, LAYERS, LENS, PINHOLE, brute_owner, close, display, land, rays, same
from glass import Glass
from lattice import Lattice
from path import TOTAL


def invisible(name, surround, aperture):
    """Lenses of index 1 change no ray and take no light."""
    o, d = rays()
    with np.errstate(divide="ignore", invalid="ignore"):  # it has no focal length
        air = display({**LENS, "index": 1.0}, name, surround=surround, aperture=aperture, fresnel="exact", layers=[{"thickness_mm": 2.0, "index": 1.0}])
    hits = land(air, o, d)
    ok, found = close(hits.at, (o - d * (o[:, 2] / d[:, 2])[:, None])[:, :2], 1e-7)
    return ok and (hits.weight[hits.column >= 0] == 1).all(), found


def energy(name, surround):
    """White panel: without Fresnel every ray that gets through has the weight 1; with it, all have less and none less than 0."""
    o, d = rays()
    for lens in (LENS, FACING, ASPHERE):
        plain = land(display(lens, name, surround=surround, layers=LAYERS), o, d)
        lossy = land(display(lens, name, surround=surround, layers=LAYERS, fresnel="exact"), o, d)
        on = plain.column >= 0
        if not ((plain.weight[on] == 1).all() and (plain.column == lossy.column).all() and (lossy.weight[on] < 1).all() and (lossy.weight[on] > 0).all()):
            return False, "a weight is wrong"
    return True, f"{100 * on.mean():.0f} % lit"


def cylinder():
    """One plano-convex strip by hand: in the plane across it Snell's law holds with sqrt(n^2 - k^2), k the constant share of the direction along it."""
    lens = {**LENS, "sphere_radius_mm": 6.0}
    d = display(lens, "strips", count=[1, 1], fresnel="exact")
    o, u = rays(wide=3.0, steepest=70.0)
    hits = land(d, o, u)
    radius, n, base = 6.0, 1.5, 9.0
    centre = base + 1.0 - math.sqrt(radius**2 - 3.9**2)
    k = u[:, 1]
    n1, n2 = np.sqrt(1 - k**2), np.sqrt(n**2 - k**2)
    flat, run = u[:, [0, 2]] / n1[:, None], o[:, [0, 2]] - [0, centre]  # in the plane across the strip, about the cylinder's axis
    b = np.sum(flat * run, axis=1)
    with np.errstate(invalid="ignore"):
        s = -b - np.sqrt(b * b - np.sum(run * run, axis=1) + radius**2)
        top = run + s[:, None] * flat
        facing = np.arctan2(top[:, 0], top[:, 1])  # of the normal, from the vertical
        coming = np.arctan2(-flat[:, 0], -flat[:, 1])
        going = facing + np.arcsin(n1 / n2 * np.sin(coming - facing))
        down = top[:, 1] + centre - base
        x = top[:, 0] - down * np.tan(going)
        y = o[:, 1] + s * k / n1 + down / np.cos(going) * k / n2
        leaving = np.arcsin(n2 / n1 * np.sin(going))
        x, y = x - base * np.tan(leaving), y + base / np.cos(leaving) * k / n1

        def passed(i, t):  # Fresnel, in and out, with the angles in space
            ci, ct = n1 * np.cos(i), n2 / n * np.cos(t)
            return 1 - 0.5 * (((ci - n * ct) / (ci + n * ct)) ** 2 + ((n * ci - ct) / (n * ci + ct)) ** 2)
        weight = passed(coming - facing, going - facing) * passed(leaving, going)
    met = hits.column >= 0
    ok, found = close(np.column_stack([x, y, weight])[met], np.column_stack([hits.at, hits.weight])[met], 1e-9)
    return ok and met.sum() > 250, f"{found}, {met.sum()} rays"


def inside_glass(display, lattice, p):
    """Whether points (n, 3) of the array's frame are in glass: by heights over the cell or circle that holds them, every lens tested."""
    lower, upper = display.surfaces
    held, i, j = brute_owner(lattice, p[:, :2])
    q = p - lattice.axis(i, j)
    s2 = q[:, :2] ** 2 @ lattice.across
    round_enough = s2 <= upper.semi**2
    in_lens = (held > 0) & round_enough
    z = p[:, 2]
    if display.array.surround == "plate":
        return (z > np.where(in_lens, lower.height(s2), lower.z_rim)) & (z < np.where(in_lens, upper.height(s2), upper.z_rim))
    return in_lens & (z > lower.height(s2)) & (z < upper.height(s2))


def bodies(name, lens, surround, aperture):
    """The first passage into glass, and from a plate's glass out of it, against points sampled along the ray."""
    d = display(lens, name, surround=surround, aperture=aperture)
    lattice, glass = Lattice(d), Glass(d, Lattice(d))
    wrong = tried = 0
    for leaving in (False, True) if surround == "plate" else (False,):
        rng = np.random.default_rng(5)
        o, u = rays(40, 80.0, 30.0, seed=6)
        if leaving:
            o = np.column_stack([rng.uniform(-30, 30, (400, 2)), rng.uniform(glass.z_min, glass.z_max, 400)])
            o = o[inside_glass(d, lattice, o)][:40]
            u = rng.normal(size=(len(o), 3))
            u /= np.linalg.norm(u, axis=1, keepdims=True)
        else:
            o = o + ((glass.z_max + 0.01 - o[:, 2]) / u[:, 2])[:, None] * u
        none = np.zeros(len(o), np.int64)
        t = glass.next_hit(o, u, none, none, leaving)[0]
        s = np.linspace(0, 40, 1201)
        inside = inside_glass(d, lattice, (o[:, None] + s[None, :, None] * u[:, None]).reshape(-1, 3)).reshape(len(o), -1)
        for ray in range(len(o)):
            change = np.flatnonzero(inside[ray] != leaving)
            first = s[change[0]] if len(change) else np.inf
            tried += 1
            # Between two samples a corner may be cut: then the passage found is earlier, and there is another state just behind it.
            if t[ray] > first + 1e-9 or (min(t[ray], 40) < min(first, 40) - s[1] and inside_glass(d, lattice, (o[ray] + (t[ray] + 1e-7) * u[ray])[None])[0] == leaving):
                wrong += 1
    return wrong == 0, f"{wrong} of {tried} passages differ"


def layer_of_air(name, lens, surround):
    """A layer of index 1 is air."""
    o, d = rays()
    given = {"surround": surround, "fresnel": "exact"}
    return same(land(display(lens, name, **given), o, d), land(display(lens, name, layers=[{"thickness_mm": 5.0, "index": 1.0}], **given), o, d), 1.0)


def halved_layer():
    """Two layers of one index are one layer of both thicknesses."""
    o, d = rays()
    half, whole = ([{"thickness_mm": t, "index": 1.6}] * k for t, k in ((1.1, 2), (2.2, 1)))
    return same(land(display(LENS, layers=half, fresnel="exact"), o, d), land(display(LENS, layers=whole, fresnel="exact"), o, d), 1.0)


def parallel_plates():
    """Pinholes over two plates: the shift, the light and the angle at the panel by Snell and Fresnel."""
    o, u = rays(steepest=80.0)
    d = display(PINHOLE, "square", layers=LAYERS, fresnel="exact", panel={"emission_exponent": 1.0})
    hits = land(d, o, u)
    sine = np.hypot(u[:, 0], u[:, 1])
    at = o + ((9.0 - o[:, 2]) / u[:, 2])[:, None] * u
    aside, weight, n1 = (9.0 - 2.2) * sine / np.sqrt(1 - sine**2), np.ones(len(o)), 1.0
    for plate in reversed(LAYERS):
        n2 = plate["index"]
        c1, c2 = np.sqrt(1 - (sine / n1) ** 2), np.sqrt(1 - (sine / n2) ** 2)
        aside = aside + plate["thickness_mm"] * (sine / n2) / c2
        weight = weight * 2 * n1 * n2 * c1 * c2 * (1 / (n1 * c1 + n2 * c2) ** 2 + 1 / (n1 * c2 + n2 * c1) ** 2)
        n1 = n2
    wanted = np.column_stack([at[:, :2] + aside[:, None] * u[:, :2] / sine[:, None], weight, c2])
    on = hits.column >= 0
    ok, found = close(np.column_stack([hits.at, hits.weight, hits.cosine])[on], wanted[on])
    return ok and on.sum() > 100, f"{found}, {on.sum()} rays"


def glued_of_one_glass(name, aperture):
    """A plate glued onto a layer of its own index is a thicker plate on the bare panel; so is a clear lens, for light that stays in it."""
    o, d = rays()
    layer = [{"thickness_mm": 3.0, "index": 1.5}]
    given = {"surround": "plate", "aperture": aperture, "fresnel": "exact"}
    on_layer = land(display(LENS, name, base_z_mm=3.0, layers=layer, **given), o, d)
    on_panel = land(display({**LENS, "cylinder_height_mm": 4.0}, name, base_z_mm=0.0, **given), o, d)
    return same(on_layer, on_panel)


def glued_loses_nothing():
    """At normal incidence a lens on the bare panel loses light at its upper face alone, one in air at both; one on a layer at three passages, glued at two."""
    o, d = np.array([[0.0, 0.0, 60.0]]), np.array([[0.0, 0.0, -1.0]])
    through = lambda n1, n2: 4 * n1 * n2 / (n1 + n2) ** 2
    layer = [{"thickness_mm": 2.0, "index": 1.7}]
    for surround in ("opaque", "clear", "plate"):
        weight = lambda base, layers=(): land(display(LENS, "square", layers=layers, fresnel="exact", base_z_mm=base, surround=surround, count=[9, 9]), o, d).weight[0]
        got = [weight(0.0), weight(1.0), weight(2.0, layer), weight(2.1, layer), weight(2.0, [{"thickness_mm": 2.0, "index": 1.5}])]
        glass = through(1, 1.5)
        ok, found = close(got, [glass, glass**2, glass * through(1.5, 1.7), glass**2 * through(1, 1.7), glass], 1e-12)
        if not ok:
            return ok, found
    return ok, found


def total_reflection():
    """Steep light in dense glass over a rare layer: black where layers meet and under opaque lenses, reflected at a clear lens's own glued face."""
    o, d = rays(steepest=75.0)
    dense = {**LENS, "index": 1.8, "sphere_radius_mm": 4.5}
    rare, alike = {"thickness_mm": 0.4, "index": 1.2}, {"thickness_mm": 0.4, "index": 1.8}
    statuses = [land(display(dense, surround=s, base_z_mm=0.8 if len(given) == 2 else 0.4, layers=given), o, d).status
                for s, given in (("opaque", [rare]), ("opaque", [rare, alike]), ("clear", [rare]), ("clear", [rare, alike]), ("plate", [rare]), ("plate", [rare, alike]))]
    total = [int((s == TOTAL).sum()) for s in statuses]
    return all(k > 5 for k in (total[0], total[1], total[3], total[5])) and total[2] == total[4] == 0, f"rays that end so: {total}"
