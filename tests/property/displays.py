"""Displays drawn at random: the same number, the same display. A description is a dictionary with the tables and keys of docs/format.md."""
import math

import numpy as np

import oracle

SIZES = ("160x90", "240x135", "320x180")  # of pictures
KINDS = {"near-eye": ((18, 45), (0.2, 2)), "hand-held": ((150, 450), (0.2, 5)), "desk": ((400, 1200), (0.4, 25)),
         "wall": ((1500, 5000), (3, 60))}  # eye to lenses and lens pitch, from and to, mm
CONTENTS = ("built-in:spheres", "relief.obj", "pyramid.gltf")  # the files are written by contents.py


OTHERS = 500  # of each thousand numbers those from here on are products as they are sold, and kinds that draw() seldom or never has
WIDER = 750  # of each thousand numbers those from here on are the displays from number 0 on, with lenses beyond the panel


def draw(number, most_pixels):
    """Display `number`, with at most most_pixels panel pixels. Not all that is drawn can be built: `check` refuses some."""
    if number % 1000 >= WIDER:
        return with_lenses_beyond(number, draw(number - WIDER, most_pixels))
    if number % 1000 >= OTHERS:
        return draw_other(number, most_pixels)
    rng = np.random.default_rng([2024, number])
    pitch = log_uniform(rng, 0.2, 60)
    kind = rng.choice([name for name, (_, (least, most)) in KINDS.items() if least <= pitch <= most])
    eye = log_uniform(rng, *KINDS[kind][0])
    lens, aperture = draw_lens(rng, pitch)
    sides = draw_sides(number, aperture)
    if "stop_radius_mm" in lens:
        lens["stop_radius_mm"] *= min(sides)
    lattice = {"pitch_mm": pitch} if sides[0] == sides[1] else {"lattice": "rectangle", "pitch_mm": [pitch * side for side in sides]}
    trial = oracle.resolve({"lens": lens, "array": {**lattice, "aperture": aperture, "gap_mm": 0.0}})
    gap = draw_gap(rng, trial.paraxial.f, eye)
    array = {**lattice, "gap_mm": gap, "aperture": aperture}
    if lens["type"] == "plano_convex" and rng.random() < 0.35:
        array["surround"] = str(rng.choice(["clear", "plate"]))
    height = gap + trial.vertex_plane  # of the vertex plane
    distance = eye + height  # of the eye from the panel
    per_lens = log_uniform(rng, 6, 100)
    array["count"] = count(rng, pitch * sides[0], eye, per_lens, most_pixels, sides[1] / sides[0])
    viewing = float(rng.choice([1, 1, 1, 1, 1, 1, 1, 0.7, 1.5, math.inf])) * distance
    stretch = 1 + gap / (viewing - height)
    pixel = pitch * sides[0] / per_lens
    cover = stretch if rng.random() < 0.6 else 1.0  # wide enough for the outermost elemental images, or as wide as the array
    # A pixel whose centre lies between two elemental images belongs to either: an even number of lenses on an odd number of pixels has such.
    columns, rows = (math.ceil(n * per_lens * side / sides[0] * cover / 2) * 2 for n, side in zip(array["count"], sides))
    if rng.random() < 0.15:
        array["rotation_deg"] = float(rng.uniform(-45, 45))
    if rng.random() < 0.2:
        array["offset_mm"] = [float(v) for v in rng.uniform(-pitch, pitch, 2)]
    description = {
        "schema": 1, "name": f"{kind} {number}",
        "panel": {"pixels": [columns, rows], "pixel_pitch_mm": pixel, "emission_exponent": float(rng.choice([0, 0, 0, 0, 1]))},
        "lens": lens, "array": array,
        "camera": {"position_mm": [0.0, 0.0, distance], "resolution": [int(v) for v in SIZES[number % 3].split("x")]},
        "content": {"viewing_distance_mm": viewing, "model": CONTENTS[number // 3 % 3]},
        "render": {"fresnel": str(rng.choice(["exact", "exact", "exact", "schlick", "none"])), "seed": number},
    }
    if rng.random() < 0.5:
        description["diffuser"] = draw_diffuser(rng, pitch, eye)
    as_others_are_built(np.random.default_rng([2026, number]), description)
    if number % 2:
        in_colour(np.random.default_rng([2027, number]), description)
    return description


def draw_other(number, most_pixels):
    """By turns: lenticular sheets glued to glass, pinholes, a stop between two surfaces of a lens, two views, staggered lenses that fill their cells.

    None has a count: as many lenses as cover the panel. All but the third have subpixels.
    """
    rng = np.random.default_rng([2028, number])
    kind = ("lenticular", "pinholes", "stop inside", "two views", "staggered")[number % 5]
    pixel = log_uniform(rng, 0.04, 0.3)
    columns = int(min(rng.integers(160, 1200), math.sqrt(1.6 * most_pixels)))
    panel = {"pixels": [columns, int(columns * rng.uniform(0.5, 0.7))], "pixel_pitch_mm": pixel}
    if kind != "stop inside":
        panel["subpixels"] = str(rng.choice([layout for layout in LAYOUTS if layout not in ("none", "custom")]))
        panel["aperture_ratio"] = float(rng.choice([1.0, rng.uniform(0.4, 1)]))
    eye = log_uniform(rng, 250, 1500)
    views = 2.0 if kind == "two views" else float(rng.choice([rng.integers(5, 40), rng.uniform(5, 40)]))
    index, array, gap = float(rng.uniform(1.45, 1.65)), {"lattice": "strips", "aperture": "cell"}, None
    apart = float(rng.uniform(60, 66))  # of a viewer's eyes
    if kind == "two views":  # g = a E / apart puts them beside each other
        gap = pixel * eye / apart
        pitch = 2 * pixel / (1 + gap / eye)
        slits = {"type": "pinhole", "aperture_radius_mm": float(rng.uniform(0.1, 0.25)) * pitch}
        lens = slits if rng.random() < 0.5 else {"type": "ideal", "focal_length_mm": gap * float(rng.uniform(0.9, 1.1))}
        if lens is slits:
            array["aperture"] = "circle"
    else:
        pitch = pixel * views
        gap = pitch / (2 * math.tan(math.radians(float(rng.uniform(10, 40))) / 2))
    if kind == "lenticular":  # R = (n - 1) g is in focus
        slant = float(rng.choice([0.0, math.degrees(math.atan(1 / 3)), math.degrees(math.atan(1 / 6)), rng.uniform(-30, 30)]))
        array |= {"slant_deg": slant, "surround": str(rng.choice(["opaque", "plate"]))}
        pitch *= math.cos(math.radians(slant))
        radius = max((index - 1) * gap * float(rng.uniform(0.9, 1.1)), 0.52 * pitch)
        height = float(rng.uniform(0.1, 0.9)) * radius
        lens = {"type": "plano_convex", "sphere_radius_mm": radius, "aperture_radius_mm": pitch / 2, "cylinder_height_mm": height, "index": index}
        glass = gap * 1.5 - height / index
        if glass > 0.1 and rng.random() < 0.7:  # glued on: the cover's thickness makes the gap
            panel["layer"] = [{"thickness_mm": glass, "index": 1.5}]
            array["base_z_mm"] = glass
    elif kind == "pinholes":
        array["lattice"] = str(rng.choice(["square", "hexagon", "strips"]))
        array["aperture"] = "circle"
        lens = {"type": "pinhole", "aperture_radius_mm": float(rng.uniform(0.05, 0.3)) * pitch}
    elif kind == "stop inside":  # light passes the middle surface through a narrower hole than the others
        array |= {"lattice": "square", "aperture": "circle"}
        half, focal = pitch / 2, gap * float(rng.uniform(0.8, 1))
        bend = 1 / (2 * (index - 1) * focal)
        lens = {"type": "surfaces", "surface": [
            {"curvature_per_mm": bend, "semi_aperture_mm": half, "index": index, "distance_mm": 0.4 * pitch},
            {"curvature_per_mm": 0.0, "semi_aperture_mm": float(rng.uniform(0.3, 0.8)) * half, "index": index, "distance_mm": 0.4 * pitch},
            {"curvature_per_mm": -bend, "semi_aperture_mm": half}]}
    elif kind == "staggered":
        array["lattice"] = str(rng.choice(["hexagon", "brick"]))
        radius = max((index - 1) * gap * float(rng.uniform(0.8, 1)), 1.05 * pitch)
        lens = {"type": "plano_convex", "sphere_radius_mm": radius, "cylinder_height_mm": 0.1 * pitch, "index": index}
    array["pitch_mm"] = [pitch, pitch * float(rng.uniform(0.8, 1.2))] if array["lattice"] == "brick" else pitch
    if "base_z_mm" not in array:
        array["gap_mm"] = gap
    trial = oracle.resolve({"lens": lens, "array": {**array, "base_z_mm": 0.0} if "base_z_mm" in array else array})
    distance = float(eye + trial.vertex_plane + array.get("base_z_mm", 0.0))
    description = {"schema": 1, "name": f"{kind} {number}", "panel": panel, "lens": lens, "array": array,
                   "camera": {"position_mm": [0.0, 0.0, distance], "resolution": [int(v) for v in SIZES[number % 3].split("x")]},
                   "content": {"viewing_distance_mm": distance}, "render": {"seed": number}}
    if kind not in ("two views", "lenticular") and rng.random() < 0.5:
        description["diffuser"] = draw_diffuser(rng, pitch, eye)
    return description


def with_lenses_beyond(number, description):
    """Gives an array 1.2 to 3 times as many lenses, each way, as before: eyes see none of those that lie far beside the panel."""
    rng = np.random.default_rng([2031, number])
    description["array"]["count"] = [n if n == 1 else math.ceil(n * rng.uniform(1.2, 3)) for n in description["array"]["count"]]
    return description


def as_others_are_built(rng, description):
    """Of one display in three hexagons, bricks or slanted strips, of one in four layers under the lenses or glued to them, of thin round lenses some pinholes.

    With numbers of its own: the others stay as they are.
    """
    array, lens = description["array"], description["lens"]
    lattice, layers, hole = rng.random(), rng.random(), rng.random()
    slant, share, indices, holes = rng.uniform(-40, 40), rng.uniform(0.2, 0.8), rng.uniform(1.3, 1.7, 2), rng.uniform(0.3, 0.9)
    if lattice < 0.35:
        kind = ("hexagon", "brick", "strips")[int(lattice * 20) % 3]
        across, up = np.broadcast_to(np.asarray(array["pitch_mm"], float), 2)
        array["lattice"] = kind
        array["pitch_mm"] = [float(across), float(up)] if kind == "brick" else float(min(across, up))
        if kind == "hexagon":
            array["count"][1] = math.ceil(array["count"][1] * 2 / math.sqrt(3))
        if kind == "strips":
            array["count"][1] = 1
            array.pop("rotation_deg", None)
            array["slant_deg"] = float(slant)
            if hole < 0.5:  # as without a count: the smallest number that covers the panel, with corners that reach far over it
                wide, high = np.array(description["panel"]["pixels"]) * description["panel"]["pixel_pitch_mm"]
                turn = math.radians(abs(slant))
                array["count"][0] = math.ceil((wide * math.cos(turn) + high * math.sin(turn)) / array["pitch_mm"])
    if lens["type"] == "ideal" and array["aperture"] == "circle" and "stop_radius_mm" not in lens and hole < 0.6:
        description["lens"] = {"type": "pinhole", "aperture_radius_mm": float(holes * lens["aperture_radius_mm"])}
    space = oracle.resolve({"lens": description["lens"], "array": array})  # under the lenses
    space = space.lens_z if space.ideal else min(s.z_min for s in space.surfaces)
    glued = layers < 0.08 and lens["type"] == "plano_convex" and lens["facing"] == "viewer"
    if layers < 0.25 and space > 0:  # by their reduced thickness they leave theory as it is
        reduced = (1.0 if glued else share) * space * np.array([0.7, 0.3])
        description["panel"]["layer"] = [{"thickness_mm": float(t * n), "index": float(n)} for t, n in zip(reduced, indices)]
        if glued:
            del array["gap_mm"]
            array["base_z_mm"] = float(reduced @ indices)


def misassemble(number, description):
    """Gives a display errors of its array, each with two chances of three: they move the outermost lenses by up to 0.3 pitches or a tenth of the gap."""
    rng = np.random.default_rng([2029, number])
    array, trial = description["array"], oracle.resolve(description)
    half = 0.5 * np.hypot(*(trial.array.pitch_mm * trial.array.count)) if not trial.strips else 0.5 * trial.array.pitch_mm[0] * trial.array.count[0]
    beside, along = trial.array.pitch_mm[0] * rng.uniform(-0.3, 0.3, 4), trial.gap * rng.uniform(-0.1, 0.1, 4)
    drawn = {"shift_mm": [float(v) for v in beside[:2]], "rotation_deg": math.degrees(beside[2] / half), "pitch_ppm": 1e6 * float(beside[3] / half)}
    if "base_z_mm" not in array:  # glued lenses keep their height
        drawn |= {"gap_mm": float(along[0]), "wedge_deg": [math.degrees(v / half) for v in along[1:3]], "bow_mm": float(along[3])}
    chosen = rng.random(len(drawn)) < 0.67
    description["errors"] = {key: value for (key, value), take in zip(drawn.items(), chosen) if take} or {"shift_mm": drawn["shift_mm"]}


LAYOUTS = ("none", "rgb_stripe", "bgr_stripe", "rgb_rows", "pentile_rgbg", "delta", "custom", "custom")
GLASSES = ("PMMA", "N-BK7", "PC")


def in_colour(rng, description):
    """Subpixels, a black matrix or both, and to two of three lenses of glass, and some layers, a glass that disperses.

    With numbers of its own, for odd displays alone: the others stay as they are. The gap keeps its share of the focal length.
    """
    panel, lens, array = description["panel"], description["lens"], description["array"]
    layout = str(rng.choice(LAYOUTS))
    if layout == "none" or rng.random() < 0.5:
        panel["aperture_ratio"] = float(rng.uniform(0.3, 1))
    if layout != "none":
        panel["subpixels"] = layout
    if layout == "custom":
        panel |= draw_cell(rng)
    rows = [lens] if lens["type"] == "plano_convex" else lens.get("surface", [])[:-1]
    focal = oracle.resolve(description).paraxial.f
    for row, share in [(row, 0.67) for row in rows] + [(layer, 0.4) for layer in panel.get("layer", [])]:
        if rng.random() < share:
            row["glass"] = draw_glass(rng, row.pop("index"))
    if "gap_mm" in array and rows:
        array["gap_mm"] *= oracle.resolve(description).paraxial.f / focal
    if rng.random() < 0.2:
        panel["primary_widths_nm"] = [float(v) for v in rng.uniform(10, 60, 3)]
        description["render"]["wavelength_samples"] = int(rng.integers(2, 5))


def draw_cell(rng):
    """A cell of 1 x 1 to 3 x 2 pixels cut into columns and rows of places, most with a rectangle in it; all are moved alike, some over the cell's border."""
    size = [int(rng.integers(1, 4)), int(rng.integers(1, 3))]
    columns, rows = int(rng.integers(3, 6)), int(rng.integers(1, 4))
    cuts = [np.concatenate([[0.0], np.cumsum(part / part.sum())]) * n for n, part in zip(size, (rng.uniform(0.5, 1, columns), rng.uniform(0.5, 1, rows)))]
    channels = list(rng.permutation(list("rgb"))) + list(rng.choice(list("rgb"), columns * rows - 3))
    moved, found = rng.uniform(-0.5, 0.5, 2), []
    for k, channel in enumerate(channels):
        low = np.array([cuts[0][k % columns], cuts[1][k // columns]])
        high = np.array([cuts[0][k % columns + 1], cuts[1][k // columns + 1]])
        corners = [low + rng.uniform(0, 0.3, 2) * (high - low) + moved, high - rng.uniform(0, 0.3, 2) * (high - low) + moved]
        if k < 3 or rng.random() < 0.8:
            found.append({"channel": str(channel), "pixel": [int(v) for v in (low + high) / 2], "rect": [float(v) for v in np.concatenate(corners)]})
    return {"subpixel_cell": size, "subpixel": found}


def draw_glass(rng, index):
    """By its name, or with about this index."""
    abbe, kind = float(rng.uniform(20, 80)), int(rng.integers(5))
    if kind == 0:
        return str(rng.choice(GLASSES))
    b = (index - 1) / abbe / 1.9099  # between F and C 1/l^2 differs by 1.9099 per square micrometre
    if kind == 1:
        return {"cauchy": [index - b / 0.345, b, 1e-3 * b]}
    if kind == 2:  # mostly one resonance
        square = index**2 - 1
        c = 2 * index * b / square
        return {"sellmeier": [square * (1 - c / 0.345), c, 0.01, 100.0, 0.0, 200.0]}
    return {"nd": index, "vd": abbe}


def draw_sides(number, aperture):
    """A cell's sides against the drawn pitch, across and up: of one display in five unequal, with numbers of its own, so that the others stay as they are.

    Round lenses as wide as the pitch fit into the cell; glass that covers a square's corners covers the cell's.
    """
    rng = np.random.default_rng([2025, number])
    up = log_uniform(rng, 0.6, 1.6) if rng.random() < 0.2 else 1.0
    whole = max(1.0, up) if aperture == "cell" else min(1.0, up)
    return 1.0 / whole, up / whole


def log_uniform(rng, low, high):
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def draw_lens(rng, pitch):
    """A lens for cells of `pitch` mm, f/1 to f/12, and the aperture's shape."""
    aperture = str(rng.choice(["circle", "circle", "cell"]))
    semi = pitch / 2 * (1.0 if aperture == "cell" else float(rng.choice([1.0, rng.uniform(0.6, 1)])))
    focal = log_uniform(rng, 1, 12) * 2 * semi
    index = float(rng.uniform(1.45, 1.75))
    kind = rng.choice(["ideal", "plano_convex", "plano_convex", "asphere", "two surfaces"])
    corner = pitch / math.sqrt(2) if aperture == "cell" else semi  # how far from the axis the glass reaches
    radius = focal * (index - 1)
    if kind == "ideal":
        lens = {"type": "ideal", "focal_length_mm": focal, "aperture_radius_mm": semi}
    elif kind == "plano_convex":
        lens = {"type": "plano_convex", "sphere_radius_mm": max(radius, 1.02 * corner), "aperture_radius_mm": semi, "index": index,
                "cylinder_height_mm": float(rng.uniform(0.05, 0.4)) * semi, "facing": str(rng.choice(["viewer", "viewer", "panel"]))}
    elif kind == "asphere":  # a conic that brings collimated light together, bent a little at the rim
        radius = max(radius, 1.1 * corner)
        bend = [float(rng.uniform(-0.02, 0.02)) / radius**3, float(rng.uniform(-0.02, 0.02)) / radius**5]
        curved = {"curvature_per_mm": -1 / radius, "conic": float(rng.uniform(-1, 0)), "even_asphere": bend, "semi_aperture_mm": corner}
        flat = {"curvature_per_mm": 0.0, "semi_aperture_mm": corner, "index": index, "distance_mm": corner**2 / radius + 0.1 * corner}
        lens = {"type": "surfaces", "surface": [flat, curved]}
    else:
        share = float(rng.uniform(0.2, 0.8))  # of the power, on the panel's side
        first, last = (share * (index - 1) and share / radius), (1 - share) / radius
        steep = max(first, last) * corner
        shrink = min(1.0, 0.9 / steep)
        thick = corner**2 * (first + last) * shrink + 0.1 * corner
        lens = {"type": "surfaces", "surface": [
            {"curvature_per_mm": first * shrink, "conic": float(rng.uniform(-1, 0)), "semi_aperture_mm": corner, "index": index, "distance_mm": thick},
            {"curvature_per_mm": -last * shrink, "conic": float(rng.uniform(-1, 0)), "semi_aperture_mm": corner}]}
    if rng.random() < 0.15:
        lens["stop_radius_mm"] = float(rng.uniform(0.2, 0.8)) * semi
    return lens, aperture


def draw_gap(rng, focal, eye):
    """The gap for a central depth plane that is real, virtual or infinitely far."""
    kind = rng.choice(["real", "real", "virtual", "infinite"])
    if kind == "infinite":
        return focal
    if kind == "real":
        near = 2 * focal
        return 1 / (1 / focal - 1 / log_uniform(rng, near, max(0.8 * eye, 1.5 * near)))
    return 1 / (1 / focal + 1 / log_uniform(rng, max(2 * focal, 0.3 * eye), 30 * max(focal, eye)))


def count(rng, pitch, eye, per_lens, most_pixels, up):
    """Lenses across and up, `up` times as far apart: 5 x 5 to about 300 x 200, not wider than 1.5 times the eye's distance, nor higher than wide."""
    most = min(300, 1.5 * eye / pitch, math.sqrt(1.6 * most_pixels) / per_lens)
    across = max(5, round(log_uniform(rng, 5, max(5.01, most))))
    return [across, max(5, round(across * float(rng.uniform(0.5, 1)) / up))]


def draw_diffuser(rng, pitch, eye):
    """Spreads light over about a lens pitch where it stands, which joins neighbouring lenses."""
    distance = min(log_uniform(rng, pitch, 60 * pitch), 0.6 * eye)
    angles = np.minimum(np.degrees(2 * math.atan(pitch / 2 / distance)) * rng.uniform(0.4, 1.6, 2), 28)
    return {"distance_mm": distance, "angle_deg": [float(v) for v in angles], "profile": str(rng.choice(["box", "gaussian"]))}
