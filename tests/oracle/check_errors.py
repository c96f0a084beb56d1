"""Checks of displays with errors: against the perfect tracer, other descriptions of the same display, all lenses searched, points along
rays, closed forms. Each returns (good, what was found)."""
import numpy as np

import cases
import colour_cases
import errors
import lattice_cases
import pickup
import tracer
from check_tools import ASPHERE, FACING, IDEAL, LATTICES, LAYERS, LENS, PINHOLE, close, display, land, rays, same, turned
from display import resolve
from errors_plate import MovedPlate

BICONVEX = {"type": "surfaces", "surface": [{"curvature_per_mm": 0.05, "semi_aperture_mm": 3.9, "distance_mm": 3.4, "index": 1.5},
                                            {"curvature_per_mm": -0.1, "semi_aperture_mm": 3.9, "conic": -0.4}]}
ARRAY = {"shift_mm": [1.3, -0.8], "gap_mm": 0.35, "rotation_deg": 3.5, "pitch_ppm": 4000.0, "wedge_deg": [1.2, -1.9], "bow_mm": -0.6}


def titles():
    """The displays that others compare, without those of a million lenses."""
    every = {**cases.SHARP, **lattice_cases.SHORT, **lattice_cases.MORE, **colour_cases.SHORT, **colour_cases.MORE}
    return {name: text for name, text in every.items() if "million" not in name and text["array"].get("surround") != "clear"}


def none_at_all(text):
    """A display whose errors are all 0 is the perfect one: the same lenses, panel points to 3e-9 mm, light."""
    text = cases.merge(text, {"camera": {"resolution": [48, 27]}})
    plain, moved = resolve(text), resolve({**text, "errors": {"gap_mm": 0.0}})
    x, y = tracer.centers(plain)
    worst, away = 0.0, 0
    for (_, a), (_, b) in zip(plain.colours, moved.colours):
        through = tracer.camera_rays(plain, x, y)
        one, other = tracer.trace(a, *through), tracer.trace(b, *through)
        both = (one.column >= 0) & (other.column >= 0)
        alike = (one.status == other.status) & (one.met == other.met)
        if plain.array.surround != "plate":  # there a flat back is no lens's
            alike &= ~both | (one.way == other.way)
        away += (~alike).sum()
        far = np.abs(np.stack([one.x - other.x, one.y - other.y]))[:, both].max(initial=0) * plain.panel.pixel_pitch_mm
        worst = max(worst, far, np.abs(one.weight - other.weight).max(), np.abs(one.cosine - other.cosine).max())
    return away == 0 and worst < 3e-9, f"{away} rays differ, others by {worst:.1e}"


def rotation(axis, degrees):
    """(3, 3), by Rodrigues' formula, counter-clockwise about an axis (0 x, 1 y, 2 z) that points at who looks."""
    k = np.cross(np.eye(3)[axis], np.eye(3), axisb=1).T  # k @ v = axis x v
    a = np.radians(degrees)
    return np.eye(3) + np.sin(a) * k + (1 - np.cos(a)) * k @ k


def table(nx, ny, seed=4, strips=False, **size):
    """Rows for all lenses, each key within +- its size."""
    rng = np.random.default_rng(seed)
    size = {**{"dx_mm": 0.2, "dy_mm": 0.2, "dz_mm": 0.3, "tilt_x_deg": 3.0, "tilt_y_deg": 3.0, "curvature": 0.05}, **size}
    if strips:
        size.update(dy_mm=0.0, tilt_x_deg=0.0)
    return [{"i": i, "j": j, **{key: rng.uniform(-v, v) for key, v in size.items()}} for i in range(nx) for j in range(ny)]


def alike(nx, ny, **row):
    return [{"i": i, "j": j, **row} for i in range(nx) for j in range(ny)]


def count_of(name):
    return (9, 1) if name == "strips" else (9, 8)


def as_described(name, surround, aperture, lens=LENS):
    """Shift, gap, rotation, pitch and curvature of all are those of a display described so."""
    o, d = rays()
    given = {"surround": surround, "aperture": aperture, "fresnel": "exact", "layers": LAYERS}
    pitch = np.multiply(LATTICES[name].get("pitch_mm", 8.0), 1.003).tolist()
    wide = {**ASPHERE, "surface": [{**s, "semi_aperture_mm": 3.9 if aperture == "circle" else 5.9} for s in ASPHERE["surface"]]}
    flatter = lambda e: {"type": "surfaces", "surface": [
        {"curvature_per_mm": 0.0, "semi_aperture_mm": 3.9, "distance_mm": 2.2, "index": 1.5}, {"curvature_per_mm": -e / 7.0, "semi_aperture_mm": 3.9}]}
    pairs = [(lens, {"shift_mm": [1.2, -0.7]}, lens, {"offset_mm": [1.2, -0.7]}), (lens, {"gap_mm": 0.8}, lens, {"base_z_mm": 9.8}),
             (lens, {"rotation_deg": 5.0}, lens, {"rotation_deg": 5.0}), (wide, {"pitch_ppm": 3000.0}, wide, {"pitch_mm": pitch})]
    if surround == "opaque" and aperture == "circle":
        pairs.append((flatter(1), {"table": alike(*count_of(name), curvature=0.06)}, flatter(1.06), {}))
    for one, wrong, other, described in pairs:
        ok, found = same(land(display(one, name, errors=wrong, **given), o, d), land(display(other, name, **{**given, **described}), o, d), 1.0, 1e-7)
        if not ok:
            return False, f"{wrong}: {found}"
    return ok, found


def all_moved(name, surround, lens):
    """A table that moves all lenses alike is a shift and a gap, in the array's axes; of a plate, a shift."""
    o, d = rays()
    strips, plate = name == "strips", surround == "plate"
    given = {"surround": surround, "fresnel": "exact", "rotation_deg": 30.0}
    move = np.array([[0.3, 0.0 if strips else -0.2, 0.0]])
    raised = {} if plate else {"dz_mm": 0.4}
    by_table = {"table": alike(*count_of(name), dx_mm=move[0, 0], dy_mm=move[0, 1], **raised)}
    of_array = {"shift_mm": turned(move, 30.0)[0, :2].tolist(), "gap_mm": raised.get("dz_mm", 0.0)}
    return same(land(display(lens, name, errors=by_table, **given), o, d), land(display(lens, name, errors=of_array, **given), o, d), 0.999, 1e-8)


def one_lens_turned(lens, strips):
    """A single lens that is tilted is an array of one that is wedged; without a stop, whose hole does not tilt."""
    o, d = rays(wide=4.0, steepest=30.0)
    given = {"lattice": "strips" if strips else "square", "count": [1, 1], "fresnel": "exact"}
    tilt = [0.0 if strips else 4.0, -3.0]
    by_table = {"table": [{"i": 0, "j": 0, "tilt_x_deg": tilt[0], "tilt_y_deg": tilt[1]}]}
    return same(land(display(lens, errors=by_table, **given), o, d), land(display(lens, errors={"wedge_deg": tilt}, **given), o, d), 1.0, 1e-8)


def exit_lines(d_low, d_high, o, u, raised):
    """(points in z = 0, unit directions) of the light that leaves a perfect display's lenses: by the same display `raised` mm higher."""
    low, high = land(d_low, o, u).at, land(d_high, o + [0, 0, raised], u).at
    step = np.column_stack([high - low, np.full(len(o), -raised)])
    return np.column_stack([low, np.zeros(len(o))]), step / np.linalg.norm(step, axis=1, keepdims=True), low


def wedged(name, surround, lens):
    """A wedged and turned array is the perfect one for rays that are turned back: its light, turned, meets the panel where wanted."""
    o, u = rays(steepest=45.0)
    given = {"surround": surround, "lattice": name}
    wrong = {"wedge_deg": [3.0, -4.0], "rotation_deg": 20.0, "shift_mm": [0.4, 0.7], "gap_mm": 1.5}
    got = land(display(lens, errors=wrong, **given), o, u)
    perfect, higher = display(lens, **given), display(lens, base_z_mm=19.0, **given)
    middle, moved = np.array([0, 0, perfect.vertex_plane]), np.array([0.4, 0.7, perfect.vertex_plane + 1.5])
    turn = rotation(1, -4.0) @ rotation(0, 3.0) @ rotation(2, 20.0)
    p, v, reached = exit_lines(perfect, higher, (o - moved) @ turn + middle, u @ turn, 10.0)
    p, v = (p - middle) @ turn.T + moved, v @ turn.T
    wanted = (p - (p[:, 2] / v[:, 2])[:, None] * v)[:, :2]
    both = np.isfinite(got.at[:, 0]) & np.isfinite(reached[:, 0])
    ok, found = close(got.at[both], wanted[both], 1e-8)
    stray = (np.isfinite(got.at[:, 0]) != np.isfinite(reached[:, 0])).sum()  # that the array's frame and the display's see going up or down
    return ok and both.sum() > 200 and stray <= 2, f"{found}, {both.sum()} rays, {stray} stray"


def motion(d, wrong, i, j, row):
    """The rigid motion (turn (3, 3), from, to) of the perfect lens (i, j) about its own axis to where it is, written once more:
    q goes to turn (q - from) + to."""
    px, py = d.array.pitch_mm
    shift = px / 4 if d.array.lattice in ("brick", "hexagon") else 0.0
    axis = np.array([(i + 0.5 - d.array.count[0] / 2) * px + (shift if j % 2 else -shift), 0.0 if d.strips else (j + 0.5 - d.array.count[1] / 2) * py, 0.0])
    half = d.array.count[0] * px / 2 if d.strips else np.hypot(d.array.count[0] * px, d.array.count[1] * py) / 2
    lift = wrong["bow_mm"] * (1 - (np.linalg.norm(axis) / half) ** 2)
    own = np.array([row["dx_mm"], row["dy_mm"], row["dz_mm"] + lift])
    whole = rotation(1, wrong["wedge_deg"][1]) @ rotation(0, wrong["wedge_deg"][0]) @ rotation(2, wrong["rotation_deg"])
    tilt = rotation(1, row["tilt_y_deg"]) @ rotation(0, row["tilt_x_deg"])
    vertex = np.array([0.0, 0.0, d.vertex_plane])
    to = vertex + [*wrong["shift_mm"], wrong["gap_mm"]] + whole @ (axis * (1 + 1e-6 * wrong["pitch_ppm"]) + own)
    return whole @ tilt, vertex, to


def vertices(name):
    """Rays through the middle of any thin lens go straight on, wherever errors have put it and however it is turned."""
    nx, ny = count_of(name)
    rows = table(nx, ny, strips=name == "strips")
    plain = display(IDEAL, name)
    d = display(IDEAL, name, errors={**ARRAY, "table": rows})
    through = np.array([motion(plain, ARRAY, row["i"], row["j"], row)[2] for row in rows])
    rng = np.random.default_rng(8)
    off = np.column_stack([rng.uniform(-0.2, 0.2, (len(rows), 2)), np.ones(len(rows))])
    if name == "strips":  # straight on only in the plane along the strip
        off = np.array([motion(plain, ARRAY, row["i"], row["j"], row)[0] @ [0, rng.uniform(-0.3, 0.3), 1] for row in rows])
    hits = land(d, through + 40 * off, -off)
    return close(hits.at, (through - off * (through[:, 2] / off[:, 2])[:, None])[:, :2], 1e-9)


def lens_by_lens(name, lens, aperture):
    """Whatever light gets through is what a perfect lens alone, of the curvature it has, makes of the ray in the lens's own frame; each lens tried."""
    o, u = rays(600, steepest=45.0, wide=14.0)
    count, strips = ([3, 1] if name == "strips" else [3, 3]), name == "strips"
    rows = table(*count, strips=strips, curvature=0.0)
    base = {"lattice": name, "aperture": aperture, "fresnel": "exact"}
    got = land(display(lens, count=count, errors={**ARRAY, "pitch_ppm": 0.0, "table": rows}, **base), o, u)
    plain = display(lens, count=count, **base)
    alone = {**base, "count": [1, 1], "offset_mm": [0.25 * plain.array.pitch_mm[0] if name in ("brick", "hexagon") else 0.0, 0.0]}
    low, high = display(lens, **alone), display(lens, base_z_mm=19.0, **alone)
    found, tried = np.full(len(o), np.inf), 0
    lit, some = np.isfinite(got.at[:, 0]), np.zeros(len(o), bool)
    for row in rows:
        turn, vertex, to = motion(plain, {**ARRAY, "pitch_ppm": 0.0}, row["i"], row["j"], row)
        p, v, reached = exit_lines(low, high, (o - to) @ turn + vertex, u @ turn, 10.0)
        p, v = (p - vertex) @ turn.T + to, v @ turn.T
        passes = np.isfinite(reached[:, 0]) & (v[:, 2] < 0)
        wanted = (p - (p[:, 2] / v[:, 2])[:, None] * v)[:, :2]
        error = np.where(passes, np.hypot(*(got.at - wanted).T), np.inf)
        found, some, tried = np.fmin(found, error), some | passes, tried + passes.sum()
    hidden = (some & ~lit).sum()  # behind the black inside of the lens before it
    good = (found[lit] < 1e-7).all() and not (lit & ~some).any() and hidden < 0.03 * lit.sum()
    return good and lit.sum() > 60, f"largest difference {found[lit].max():.1e}, {lit.sum()} lit rays, {hidden} hidden of {tried}"


def every_lens_searched(name, lens, aperture, surround="opaque"):
    """The search near a ray's path finds the lens that a search over all lenses finds."""
    o, u = rays(400 if surround == "opaque" else 60, steepest=80.0)
    nx, ny = count_of(name)
    flat = {"tilt_x_deg": 0.0, "tilt_y_deg": 0.0} if surround == "plate" else {}
    wrong = {**ARRAY, "table": table(nx, ny, strips=name == "strips", **flat)}
    given = {"aperture": aperture, "surround": surround, "fresnel": "exact"}
    d = display(lens, name, errors=wrong, **given)
    near = land(d, o, u)
    search = errors.MovedLattice.first_hit

    def everywhere(self, o, d, t0, t1, reach, hit):
        best, normal = np.full(len(o), np.inf), np.zeros((len(o), 3))
        found = np.zeros((2, len(o)), np.int64)
        for k in range(self.nx * self.ny):
            i, j = np.full(len(o), k % self.nx), np.full(len(o), k // self.nx)
            t, n = hit(*self.into_lens(o, d, i, j), i, j)
            ok = (t < best) & (t <= t1 + 1e-9)
            best[ok], normal[ok], found[:, ok] = t[ok], n[ok], np.array([i, j])[:, ok]
        return best, normal, *found

    errors.MovedLattice.first_hit = everywhere
    try:
        return same(near, land(d, o, u), 1.0, 1e-9)
    finally:
        errors.MovedLattice.first_hit = search


def in_glass(d, wrong, p):
    """Whether points (n, 3) of the array's frame are in a plate's glass: by the heights of all caps, each lens tested."""
    lower, upper = d.surfaces
    inside = np.ones(len(p), bool)
    for surface, sign in ((upper, 1), (lower, -1)):
        height = np.full(len(p), sign * surface.z_rim)
        for row in wrong["table"] if not surface.flat else []:
            _, vertex, to = motion(d, {**ARRAY, "shift_mm": [0, 0], "gap_mm": 0.0, "wedge_deg": [0, 0], "rotation_deg": 0.0}, row["i"], row["j"], row)
            q = p - (to - vertex)
            s2 = surface.squared(q)
            ok = s2 <= surface.semi**2
            if d.fills_cell:
                ok &= (np.abs(q[:, :2] @ d.cell.normals.T) <= d.cell.half * (1 + 1e-6 * ARRAY["pitch_ppm"])).all(axis=1)
            top = surface.bent(np.full(len(p), 1 + row["curvature"])).height(s2) + (to - vertex)[2]
            height = np.where(ok, np.maximum(height, sign * top), height)
        inside &= sign * p[:, 2] < height
    return inside


def bodies(name, lens, aperture):
    """The first passage into a plate's glass, and out of it, against points sampled along the ray."""
    nx, ny = count_of(name)
    rows = table(nx, ny, strips=name == "strips", tilt_x_deg=0.0, tilt_y_deg=0.0)
    wrong = {**ARRAY, "table": rows}
    d = display(lens, name, surround="plate", aperture=aperture, errors=wrong)
    lattice = errors.MovedLattice(d)
    plate = MovedPlate(d, lattice)
    wrongly = tried = 0
    for leaving in (False, True):
        rng = np.random.default_rng(5)
        o, u = rays(30, 80.0, 26.0, seed=6)
        if leaving:
            o = np.column_stack([rng.uniform(-28, 28, (400, 2)), rng.uniform(plate.z_min, plate.z_max, 400)])
            o = o[in_glass(d, wrong, o)][:30]
            u = rng.normal(size=(len(o), 3))
            u /= np.linalg.norm(u, axis=1, keepdims=True)
        else:
            o = o + ((plate.z_max + 0.01 - o[:, 2]) / u[:, 2])[:, None] * u
        none = np.zeros(len(o), np.int64)
        t = plate.next_hit(*lattice.leave(o, u), none, none, leaving)[0]
        s = np.linspace(0, 25, 501)
        inside = in_glass(d, wrong, (o[:, None] + s[None, :, None] * u[:, None]).reshape(-1, 3)).reshape(len(o), -1)
        behind = in_glass(d, wrong, o + (np.where(np.isfinite(t), t, 0) + 1e-7)[:, None] * u) != leaving  # another state just behind the passage
        for ray in range(len(o)):
            change = np.flatnonzero(inside[ray] != leaving)
            first = s[change[0]] if len(change) else np.inf
            tried += 1
            wrongly += t[ray] > first + 1e-9 or (min(t[ray], s[-1]) < min(first, s[-1]) - s[1] and not behind[ray])
    return wrongly == 0, f"{wrongly} of {tried} passages differ"


def holes():
    """Lenses without power in cells, and a stop: a ray goes straight on that passes a hole, at its own height, and a cell, both as errors put them."""
    o, u = rays(2000, steepest=40.0)
    plain_lens = {**IDEAL, "focal_length_mm": 1e12, "stop_radius_mm": 2.6}
    rows = table(9, 8, curvature=0.0)
    d = display(plain_lens, "brick", aperture="cell", errors={**ARRAY, "table": rows})
    hits = land(d, o, u)
    cell, hole, px, py = np.zeros(len(o), bool), np.zeros(len(o), bool), *d.array.pitch_mm * (1 + 1e-6 * ARRAY["pitch_ppm"])
    for row in rows:
        for level in (False, True):
            turn, vertex, to = motion(d, ARRAY, row["i"], row["j"], {**row, "tilt_x_deg": 0.0, "tilt_y_deg": 0.0} if level else row)
            q, v = (o - to) @ turn, u @ turn
            at = (q - (q[:, 2] / v[:, 2])[:, None] * v)[:, :2]
            if level:
                hole |= np.hypot(*at.T) <= 2.6
            else:
                cell |= (np.abs(at) <= [px / 2, py / 2]).all(axis=1)
    lit = np.isfinite(hits.at[:, 0])
    straight = (o - (o[:, 2] / u[:, 2])[:, None] * u)[:, :2]
    ok, found = close(hits.at[lit], straight[lit], 1e-8)
    wrong = (lit != (hole & cell)).sum()
    return ok and wrong == 0 and 100 < lit.sum() < 1900, f"{found}, {lit.sum()} lit, {wrong} wrongly"


def decentred():
    """A decentre d turns the line that a viewer is shown through the lens's middle by d (1/g + 1/(D - z_r)) in slope."""
    for layers in ((), LAYERS):
        eye, move, rows = np.array([31.0, -12.0, 480.0]), np.array([0.21, -0.34]), alike(9, 8, dx_mm=0.21, dy_mm=-0.34)
        content = {"viewing_distance_mm": eye[2]}
        plain = display(IDEAL, "rectangle", layers, content=content)
        moved = display(IDEAL, "rectangle", layers, content=content, errors={"table": rows})
        lattice, slopes = errors.Lattice(plain), []
        i, j = np.array([2, 4, 5]), np.array([3, 4, 6])
        for d, at in ((plain, [0, 0]), (moved, move)):
            middle = lattice.axis(i, j) + [*at, d.paraxial.rear]
            u = middle - eye
            u[:, :2] *= 1e-4 if layers else 1.0  # through layers the gap is paraxial
            lines = pickup.nodal_lines(d, land(d, middle - u, u).at)
            slopes.append(lines.slope)
        wanted = move * (1 / plain.gap + (1e-4 if layers else 1.0) / (eye[2] - plain.paraxial.rear))
        ok, found = close(slopes[0] - slopes[1], np.tile(wanted, (3, 1)), 1e-9 if not layers else 1e-6)
        if not ok:
            return ok, found
    return ok, found


def refocused():
    """With a gap error, a bow, a height or a curvature the light of a panel point meets at 1/L = 1/f - 1/g, each with its own f and g."""
    f, point = IDEAL["focal_length_mm"], np.array([0.3, -0.5])
    for wrong, g, f1 in (({"gap_mm": 0.9}, 9.9, f), ({"bow_mm": -0.4}, 8.6, f), ({"table": [{"i": 4, "j": 4, "dz_mm": 0.7}]}, 9.7, f),
                         ({"table": [{"i": 4, "j": 4, "curvature": -0.04}]}, 9.0, f / 0.96)):
        depth = 1 / (1 / f1 - 1 / g)  # virtual: behind the lens
        d = display(IDEAL, "square", count=[9, 9], errors=wrong)
        image = np.array([*(-point * depth / g), g + depth])
        rng = np.random.default_rng(1)
        at = np.column_stack([rng.uniform(-2.5, 2.5, (200, 2)), np.full(200, g)])
        u = (image - at) * np.sign(depth)
        ok, found = close(land(d, at + u * 20 / np.abs(u[:, 2:]), -u).at, np.tile(point, (200, 1)), 1e-8)
        if not ok:
            return False, f"{wrong}: {found}"
    return ok, found


def refused():
    """What cannot be is refused: lenses that are not there, two rows, motions that a plate, strips, glued lenses, pinholes and clear lenses do not have."""
    tilt, bend = ({"table": [{"i": 1, "j": 0, key: 0.1}]} for key in ("tilt_x_deg", "curvature"))
    glued = {"base_z_mm": 2.2, "layers": LAYERS}
    for lens, wrong, given in ((LENS, {"table": [{"i": 9, "j": 0}]}, {}), (LENS, {"table": [{"i": 1, "j": 0}] * 2}, {}), (LENS, tilt, {"surround": "plate"}),
                               (LENS, tilt, {"lattice": "strips"}), (PINHOLE, bend, {}), (LENS, tilt, glued), (LENS, {"gap_mm": 0.1}, glued), (LENS, {"bow_mm": 0.1}, glued),
                               (LENS, {"shift_mm": [0.1, 0]}, {"surround": "clear"}), (FACING, {"tilt_sd_deg": 0.1}, {})):
        try:
            display(lens, errors=wrong, **given)
        except ValueError:
            continue
        return False, f"{wrong} is not"
    return True, "ten displays"
