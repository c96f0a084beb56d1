"""The displays and cameras of the comparison: every lens, surround, aperture, facing, angle and option, in small pictures."""
import copy
import math

import numpy as np

import errors

SPHERE = {"type": "plano_convex", "sphere_radius_mm": 5.0, "aperture_radius_mm": 3.9, "cylinder_height_mm": 1.0, "index": 1.49}
ROUNDER = {**SPHERE, "sphere_radius_mm": 6.4}  # for square cells of 7.92 mm: R must reach the corners
TURNED, ROUNDER_TURNED = {**SPHERE, "facing": "panel"}, {**ROUNDER, "facing": "panel"}
IDEAL = {"type": "ideal", "focal_length_mm": 10.2, "aperture_radius_mm": 3.9}


def surface(curvature, semi, distance=0.0, index=1.0, conic=0.0, even=()):
    return {"curvature_per_mm": curvature, "conic": conic, "even_asphere": list(even), "semi_aperture_mm": semi, "distance_mm": distance, "index": index}


def surfaces(*rows):
    return {"type": "surfaces", "surface": list(rows)}


ASPHERE = surfaces(surface(0.0, 3.9, 2.6, 1.4918), surface(-1 / 5.0, 3.9, conic=-0.36, even=[1.2e-4, 3e-6]))
CONICS = surfaces(surface(0.06, 3.9, 3.4, 1.5, conic=-2.3), surface(-0.11, 3.9, conic=0.8))
HOLLOW = surfaces(surface(-0.05, 3.9, 1.2, 1.6), surface(0.07, 3.9))                   # both faces hollow
WIDE_HOLLOW = surfaces(surface(-0.09, 5.61, 1.2, 1.8), surface(0.02, 5.61))              # for square cells
MENISCUS = surfaces(surface(0.16, 3.9, 3.0, 1.53), surface(0.04, 3.9))                  # hollow to the viewer
CEMENTED = surfaces(surface(0.03, 3.8, 1.5, 1.62), surface(0.12, 3.8, 3.2, 1.49), surface(-0.12, 3.8))
SPACED = surfaces(surface(0.02, 3.8, 1.6, 1.5), surface(-0.09, 3.8, 0.8, 1.0), surface(0.05, 3.7, 2.0, 1.58, even=[2e-5]), surface(-0.06, 3.6))
WIDE_ASPHERE = surfaces(surface(0.0, 5.61, 3.2, 1.4918), surface(-1 / 6.6, 5.61, conic=-0.5, even=[2e-5]))  # for square cells
FLAT_CONICS = surfaces(surface(0.03, 5.6, 3.8, 1.5, conic=-1.7), surface(-0.09, 5.6, conic=-0.6))  # for cells whose corners its circle leaves out


def merge(base, over):
    out = copy.deepcopy(base)
    for key, value in over.items():
        out[key] = merge(out[key], value) if isinstance(value, dict) and key in out and key != "lens" else value
    return out


BASE = {
    "schema": 1,
    "panel": {"pixels": [1200, 800], "pixel_pitch_mm": 0.09, "encoding": "linear", "emission_exponent": 0.0},
    "lens": SPHERE,
    "array": {"count": [13, 9], "pitch_mm": 7.92, "base_z_mm": 8.953, "surround": "opaque", "aperture": "circle"},
    "camera": {"position_mm": [0.0, 0.0, 700.0], "target_mm": [0.0, 0.0, 0.0], "frame_width_mm": 111.3, "resolution": [192, 108]},
    "render": {"samples": 1, "fresnel": "none"},
}


def seen_from(right, up=0.0, distance=700.0):
    """A camera turned `right` and `up` degrees off the axis about the panel's centre; the target is not on a panel pixel's border."""
    a, b = math.radians(right), math.radians(up)
    return {"position_mm": [distance * math.sin(a) * math.cos(b), distance * math.sin(b), distance * math.cos(a) * math.cos(b)], "target_mm": [0.37, -0.21, 0.0]}


def case(lens, surround="opaque", aperture="circle", view=None, **over):
    array = {"surround": surround, "aperture": aperture}
    over = merge({"array": array, "camera": seen_from(*(view or (0,)))}, over)
    display = merge(BASE, {"lens": lens, **over})
    if "fov_deg" in display["camera"]:
        del display["camera"]["frame_width_mm"]
    return display


EXACT, SCHLICK = {"fresnel": "exact"}, {"fresnel": "schlick"}
OBLIQUE = (-11, 17)
TILTED = {"rotation_deg": 12.5, "offset_mm": [1.3, -2.1]}
WIDE, TALL = ({"lattice": "rectangle", "pitch_mm": p, "count": n} for p, n in (([10.4, 7.2], [10, 9]), ([6.9, 9.3], [13, 8])))
NARROW, REACHING = {**SPHERE, "aperture_radius_mm": 3.45}, {**ROUNDER, "aperture_radius_mm": 6.33}  # within WIDE and TALL cells; over their corners

# Pictures of one ray per pixel: compared pixel by pixel.
SHARP = {
    "opaque circle, on axis": case(SPHERE),
    "opaque circle, 15 degrees, exact": case(SPHERE, view=(15,), render=EXACT),
    "opaque circle, 30 degrees, schlick": case(SPHERE, view=(30,), render=SCHLICK),
    "opaque circle, 60 degrees": case(SPHERE, view=(60,), render=EXACT),
    "opaque circle, rotated and offset, oblique": case(SPHERE, view=OBLIQUE, array=TILTED, render=EXACT),
    "opaque circle, panel facing, on axis": case(TURNED, render=EXACT),
    "opaque circle, panel facing, 30 degrees": case(TURNED, view=(30,)),
    "opaque square, 15 degrees": case(ROUNDER, aperture="cell", view=(15,), render=EXACT),
    "opaque square, 45 degrees, past the border": case(ROUNDER, aperture="cell", view=(30, 30), camera={"frame_width_mm": 150.0}),
    "opaque square, panel facing, oblique": case(ROUNDER_TURNED, aperture="cell", view=OBLIQUE, array=TILTED),
    "opaque circle, stop, 15 degrees": case({**SPHERE, "stop_radius_mm": 1.1}, view=(15,), render=EXACT),
    "opaque circle, panel facing, stop, 15 degrees": case({**TURNED, "stop_radius_mm": 1.4}, view=(15,)),
    "opaque circle, tall walls, oblique": case({**SPHERE, "cylinder_height_mm": 4.0}, view=OBLIQUE, array={"base_z_mm": 6.0}),
    "opaque circle, half balls, on axis": case({**SPHERE, "sphere_radius_mm": 3.9, "cylinder_height_mm": 0.0}, array={"base_z_mm": 2.0}),
    "opaque circle, half balls, panel facing, 15 degrees": case({**TURNED, "sphere_radius_mm": 3.9, "cylinder_height_mm": 0.0}, view=(15,), array={"base_z_mm": 2.0}),
    "clear circle, half balls, oblique": case({**SPHERE, "sphere_radius_mm": 3.9, "cylinder_height_mm": 0.0}, "clear", view=OBLIQUE, array={"base_z_mm": 2.0}),
    "clear circle, on axis, exact": case(SPHERE, "clear", render=EXACT),
    "clear circle, 30 degrees": case(SPHERE, "clear", view=(30,)),
    "clear circle, 45 degrees, schlick": case(SPHERE, "clear", view=(45,), render=SCHLICK),
    "clear circle, 75 degrees": case(SPHERE, "clear", view=(75,), camera={"frame_width_mm": 60.0}),
    "clear circle, tall walls, rotated, oblique": case({**SPHERE, "cylinder_height_mm": 4.0}, "clear", view=OBLIQUE, array={"base_z_mm": 6.0, **TILTED}, render=EXACT),
    "clear circle, panel facing, 15 degrees": case(TURNED, "clear", view=(15,), render=EXACT),
    "clear circle, stop, oblique": case({**SPHERE, "stop_radius_mm": 2.2}, "clear", view=OBLIQUE),
    "clear circle, panel facing, stop, 20 degrees": case({**TURNED, "stop_radius_mm": 2.2}, "clear", view=(20,)),
    "clear square, on axis, exact": case(ROUNDER, "clear", "cell", render=EXACT),
    "clear square, 30 degrees": case(ROUNDER, "clear", "cell", view=(30,)),
    "clear square, light guides that meet 12 to 18 surfaces": case({**SPHERE, "sphere_radius_mm": 60.0, "cylinder_height_mm": 80.0}, "clear", "cell", view=(35, 20),
        array={"count": [26, 18], "pitch_mm": 4.0}, camera={"frame_width_mm": 80.0}),
    "clear square, panel facing, rotated, oblique": case(ROUNDER_TURNED, "clear", "cell", view=OBLIQUE, array=TILTED, render=EXACT),
    "clear biconvex conics, 15 degrees": case(CONICS, "clear", view=(15,), render=EXACT),
    "clear hollow lens, oblique": case(HOLLOW, "clear", view=OBLIQUE),
    "clear asphere, 30 degrees": case(ASPHERE, "clear", view=(30,), render=EXACT),
    "plate circle, on axis": case(SPHERE, "plate", render=EXACT),
    "plate circle, 15 degrees": case(SPHERE, "plate", view=(15,)),
    "plate circle, 45 degrees, rotated": case(SPHERE, "plate", view=(20, 40), array=TILTED, render=EXACT),
    "plate circle, panel facing, oblique": case(TURNED, "plate", view=OBLIQUE, render=SCHLICK),
    "plate circle, stop, 15 degrees": case({**SPHERE, "stop_radius_mm": 2.0}, "plate", view=(15,)),
    "plate square, 15 degrees": case(ROUNDER, "plate", "cell", view=(15,), render=EXACT),
    "plate square, panel facing, 45 degrees, past the border": case(ROUNDER_TURNED, "plate", "cell", view=(45,), camera={"frame_width_mm": 150.0}),
    "plate biconvex conics, oblique": case(CONICS, "plate", view=OBLIQUE),
    "plate asphere, square, 30 degrees": case(WIDE_ASPHERE, "plate", "cell", view=(30,)),
    "asphere, 15 degrees, exact": case(ASPHERE, view=(15,), render=EXACT),
    "asphere, 45 degrees, rotated": case(ASPHERE, view=(30, 32), array=TILTED, render=SCHLICK),
    "asphere, square, oblique": case(WIDE_ASPHERE, aperture="cell", view=OBLIQUE),
    "conics, oblique": case(CONICS, view=OBLIQUE, render=EXACT),
    "meniscus, 30 degrees": case(MENISCUS, view=(30,)),
    "hollow lens, 30 degrees": case(HOLLOW, view=(30,), render=EXACT),
    "hollow lens, square, 30 degrees": case(WIDE_HOLLOW, aperture="cell", view=(30, 15)),
    "cemented doublet, 15 degrees": case(CEMENTED, view=(15,), render=EXACT),
    "two spaced elements, oblique, stop": case({**SPACED, "stop_radius_mm": 2.5}, view=OBLIQUE, render=EXACT),
    "ideal circle, 15 degrees": case(IDEAL, view=(15,)),
    "ideal square, 30 degrees, rotated, emission 1": case(IDEAL, aperture="cell", view=(30,), array=TILTED, panel={"emission_exponent": 1.0}),
    "ideal, stop, oblique, gap": case({**IDEAL, "stop_radius_mm": 1.5}, view=OBLIQUE),
    "emission 2.5, sRGB panel": case(SPHERE, view=(15,), panel={"emission_exponent": 2.5, "encoding": "srgb"}),
    "black matrix, oblique": case(SPHERE, view=OBLIQUE, panel={"aperture_ratio": 0.55}),
    "odd pitches, rectangle of 5 x 2, even and odd": case({**SPHERE, "sphere_radius_mm": 4.1, "aperture_radius_mm": 3.03}, view=OBLIQUE, camera={"frame_width_mm": 61.7},
        panel={"pixels": [777, 333], "pixel_pitch_mm": 0.0737}, array={"count": [5, 2], "pitch_mm": 6.3137, "offset_mm": [0.7, 0.4]}),
    "one lens": case(SPHERE, "clear", view=(15,), array={"count": [1, 1]}, camera={"frame_width_mm": 14.0}),
    "clear, past the border": case(SPHERE, "clear", view=(30, 20), array={"count": [3, 2]}, camera={"frame_width_mm": 60.0}),
    "a million lenses, oblique": case({"type": "plano_convex", "sphere_radius_mm": 0.066, "aperture_radius_mm": 0.05, "cylinder_height_mm": 0.03, "index": 1.49}, view=OBLIQUE,
        array={"count": [1000, 1000], "pitch_mm": 0.108, "base_z_mm": 0.1}, panel={"pixels": [3840, 3600], "pixel_pitch_mm": 0.03}, camera={"frame_width_mm": 9.0}),
    "camera close by": case(ROUNDER, "plate", "cell", camera={"position_mm": [-20.0, 10.0, 60.0], "target_mm": [5.0, 3.0, 0.0], "frame_width_mm": 90.0, "up": [0.2, 1.0, 0.1]}, render=EXACT),
    "wide cells, opaque circle, rotated and offset, oblique": case(NARROW, view=OBLIQUE, array={**WIDE, **TILTED}, render=EXACT),
    "tall cells, clear circle, 30 degrees": case(NARROW, "clear", view=(30,), array=TALL),
    "wide cells filled, opaque, 45 degrees, past the border": case(REACHING, aperture="cell", view=(30, 30), array=WIDE, camera={"frame_width_mm": 150.0}),
    "tall cells filled, plate, rotated, oblique": case(REACHING, "plate", "cell", view=OBLIQUE, array={**TALL, **TILTED}, render=EXACT),
    "wide cells filled, clear, panel facing, oblique": case({**REACHING, "facing": "panel"}, "clear", "cell", view=OBLIQUE, array=WIDE, render=EXACT),
    "tall cells, ideal, filled, oblique": case(IDEAL, aperture="cell", view=OBLIQUE, array=TALL),
    "wide cells, conics cut to them, oblique": case(FLAT_CONICS, aperture="cell", view=OBLIQUE, array=WIDE, render=EXACT),
    "wide cells filled, stop, 15 degrees up": case({**REACHING, "stop_radius_mm": 2.4}, aperture="cell", view=(0, 15), array=WIDE),
    "rectangles of one number": case(SPHERE, "clear", view=(15,), array={"lattice": "rectangle"}),
    "camera close by, clear, fov_deg": case(SPHERE, "clear", camera={"position_mm": [9.0, -12.0, 45.0], "fov_deg": 70.0}),
}

# Those that are left out where time is short: others ask the same of the program.
LONG = ("tall cells, clear circle, 30 degrees", "wide cells filled, opaque, 45 degrees, past the border", "tall cells, ideal, filled, oblique",
        "wide cells filled, clear, panel facing, oblique", "wide cells filled, stop, 15 degrees up", "rectangles of one number")

SMALL = {"resolution": [8, 5]}  # pictures whose pixels are means over many samples
DIFFUSER = {"distance_mm": 40.0, "angle_deg": [12.0, 7.0], "profile": "box"}
PUPIL = {"pupil_diameter_mm": 18.0, "focus_distance_mm": 600.0}
BLURRED = {
    "box diffuser": case(SPHERE, view=(8,), camera=SMALL, diffuser=DIFFUSER, render=EXACT),
    "gaussian diffuser, oblique": case(SPHERE, view=OBLIQUE, camera=SMALL, diffuser={**DIFFUSER, "profile": "gaussian"}),
    "wide box diffuser, oblique": case(SPHERE, view=(20, 35), camera=SMALL, diffuser={**DIFFUSER, "angle_deg": [140.0, 60.0]}),
    "gaussian diffuser of unequal widths, ideal": case(IDEAL, view=(15,), camera=SMALL, diffuser={"distance_mm": 3.0, "angle_deg": [60.0, 0.0], "profile": "gaussian"}),
    "box diffuser, clear": case(SPHERE, "clear", view=(15,), camera=SMALL, diffuser=DIFFUSER),
    "box diffuser, plate, square": case(ROUNDER, "plate", "cell", camera=SMALL, diffuser=DIFFUSER),
    "box diffuser, black matrix": case(SPHERE, view=(15,), camera=SMALL, diffuser=DIFFUSER, panel={"aperture_ratio": 0.4}),
    "box filter, asphere": case(ASPHERE, view=(15,), camera={**SMALL, "pixel_filter": "box"}),
    "thin-lens camera": case(SPHERE, view=(12, 5), camera={**SMALL, **PUPIL}),
    "all at once": case(ASPHERE, view=OBLIQUE, camera={**SMALL, **PUPIL, "pixel_filter": "box"}, diffuser={**DIFFUSER, "profile": "gaussian"},
        array=TILTED, panel={"emission_exponent": 1.0, "encoding": "srgb"}, render=EXACT),
}


def to_toml(value):
    """A description as TOML text. A list of tables ([[lens.surface]], [[panel.layer]]) stands in a table."""
    def text(v):
        if isinstance(v, dict):  # a glass
            return "{ " + ", ".join(f"{k} = {text(w)}" for k, w in v.items()) + " }"
        if isinstance(v, (np.generic, np.ndarray)):  # whose repr() names its type in some versions of NumPy
            v = v.tolist()
        if isinstance(v, (list, tuple)):
            return "[" + ", ".join(map(text, v)) + "]"
        return {True: "true", False: "false"}[v] if isinstance(v, bool) else f'"{v}"' if isinstance(v, str) else repr(v)
    lines = [f"{k} = {text(v)}" for k, v in value.items() if not isinstance(v, dict)]
    for name, table in value.items():
        if isinstance(table, dict):
            rows = {k: v for k, v in table.items() if isinstance(v, list) and v and isinstance(v[0], dict)}
            lines += [f"[{name}]"] + [f"{k} = {text(v)}" for k, v in table.items() if k not in rows]
            for kind, list_of_tables in rows.items():
                for row in list_of_tables:
                    lines += [f"[[{name}.{kind}]]"] + [f"{k} = {text(v)}" for k, v in row.items()]
    return "\n".join(lines) + "\n"


def write(folder, description):
    """display.toml in a folder (pathlib.Path), and the rows of a table of errors in lenses.csv beside it; returns the first's path."""
    if "table" in description.get("errors", {}):
        errors.write_table(folder / "lenses.csv", description["errors"]["table"])
        description = {**description, "errors": {**description["errors"], "table": "lenses.csv"}}
    path = folder / "display.toml"
    path.write_text(to_toml(description))
    return path
