"""The displays and cameras of errors: of the array alone, of each lens by a table, drawn. Each title has the word `errors`.

A table is a list of rows here; run.py writes it to a file beside the description.
"""
import numpy as np

from cases import (ASPHERE, CEMENTED, CONICS, DIFFUSER, EXACT, HOLLOW, IDEAL, MENISCUS, OBLIQUE, ROUNDER, ROUNDER_TURNED, SCHLICK, SMALL, SPACED, SPHERE, TILTED,
                   TURNED, WIDE_ASPHERE, WIDE_HOLLOW)
from colour_cases import BK7, VIVID, of, shown
from display import resolve
from lattice_cases import (ADHESIVE, AHEAD, ASPHERE_CELL, BICONVEX_CELL, BRICK, BRICK_TALL, BRICK_WIDE, DENSE, GLASS, HEXAGON, HEXAGONS_FEW, LEAN, LEAN_LEFT, NEAR,
                           PAST_BORDER, PINHOLE, REACHING, SPHERE_TALL, STEEP, STRIPS, THICK, lattice, layers, made, on_top)

LATERAL = {"dx_mm": 0.24, "dy_mm": 0.24}  # together within 5 % of the pitches here, which is more than half the clearance
EACH = {**LATERAL, "dz_mm": 0.25, "tilt_x_deg": 2.2, "tilt_y_deg": 2.2, "curvature": 0.035}
CAPS = {**LATERAL, "dz_mm": 0.12, "curvature": 0.035}  # a plate's
FLAT = {**LATERAL, "curvature": 0.035}                 # of glued lenses
NO_CURVATURE = {key: size for key, size in EACH.items() if key != "curvature"}
OF_ARRAY = {"shift_mm": [0.7, -1.1], "gap_mm": 0.4, "rotation_deg": -1.8, "pitch_ppm": 2500.0, "wedge_deg": [-0.8, 1.3], "bow_mm": 0.45}
LEVEL = {"shift_mm": [-0.9, 0.5], "rotation_deg": 2.3, "pitch_ppm": -2000.0}  # of a glued array
DRAWN = {"decenter_sd_mm": 0.08, "height_sd_mm": 0.06, "tilt_sd_deg": 0.5, "curvature_sd": 0.01, "seed": 11}


def wrong(description, array=(), each=None, seed=1, share=1.0):
    """A description with errors of the array and a table whose columns are even random numbers within +- the sizes `each`.

    share: of the lenses that the table names.
    """
    errors = dict(array)
    if each:
        nx, ny = resolve(description).array.count
        rng = np.random.default_rng(seed)
        size = {key: 0.0 if description["array"].get("lattice") == "strips" and key in ("dy_mm", "tilt_x_deg") else value for key, value in each.items()}
        numbers = {(i, j): {key: round(float(rng.uniform(-v, v)), 6) for key, v in size.items()} for j in range(ny) for i in range(nx)}
        errors["table"] = [{"i": i, "j": j, **row} for (i, j), row in numbers.items() if rng.random() < share]
    return {**description, "errors": errors}


def lens(i, j, **row):
    return {"i": i, "j": j, **row}


MIDDLE = [lens(6, 4, dz_mm=1.4), lens(5, 4, tilt_x_deg=6.5, tilt_y_deg=-5.0), lens(7, 4, dx_mm=0.27, dy_mm=-0.27, curvature=-0.3), lens(6, 3, dz_mm=-1.2), lens(6, 5, curvature=0.2)]
MILLION = {"type": "plano_convex", "sphere_radius_mm": 0.066, "aperture_radius_mm": 0.05, "cylinder_height_mm": 0.03, "index": 1.49}

# Asked even where time is short.
SHORT = {
    "errors, shift and rotation, opaque, rotated and offset, oblique": wrong(made(SPHERE, view=OBLIQUE, array=TILTED, render=EXACT),
        {"shift_mm": [0.8, -0.6], "rotation_deg": 2.2}),
    "errors, gap, hexagons, opaque cell, 30 degrees": wrong(made(ROUNDER, "opaque", "cell", (30,), HEXAGON, render=EXACT), {"gap_mm": 0.9}),
    "errors, pitch, bricks, opaque cell, 15 degrees": wrong(made(REACHING, "opaque", "cell", (15, 10), BRICK_WIDE), {"pitch_ppm": 3500.0}),
    "errors, wedge, ideal cell over layers, 30 degrees": wrong(made(IDEAL, "opaque", "cell", (30,), panel=layers(GLASS, ADHESIVE), render=EXACT), {"wedge_deg": [1.1, -1.7]}),
    "errors, bow, opaque circle, panel facing, oblique": wrong(made(TURNED, view=OBLIQUE, render=EXACT), {"bow_mm": -0.8}),
    "errors, heights, touching plate cells, 34 degrees": wrong(made(WIDE_ASPHERE, "plate", "cell", (5, 34)), each={"dz_mm": 0.1}),
    "errors, curvatures, hollow lenses in cells, 45 degrees": wrong(made(WIDE_HOLLOW, "opaque", "cell", (30, 32)), each={"curvature": 0.2}),
    "errors, decentres, opaque circle, 15 degrees": wrong(made(SPHERE, view=(15,)), each=LATERAL),
    "errors, heights and tilts, hexagons, opaque cell, oblique": wrong(made(ROUNDER, "opaque", "cell", OBLIQUE, HEXAGON, render=EXACT),
        each={"dz_mm": 0.3, "tilt_x_deg": 3.0, "tilt_y_deg": 3.0}),
    "errors, curvatures, aspheres, 15 degrees": wrong(made(ASPHERE, view=(15,), render=EXACT), each={"curvature": 0.05}),
    "errors of all kinds, cemented doublets, rotated, oblique": wrong(made(CEMENTED, view=OBLIQUE, array=TILTED, render=EXACT), OF_ARRAY, EACH),
    "errors of all kinds, slanted strips, opaque cell, 30 degrees": wrong(made(ROUNDER, "opaque", "cell", (30,), LEAN, render=EXACT), OF_ARRAY, EACH),
    "errors of all kinds, bricks, stop, 15 degrees": wrong(made({**SPHERE, "stop_radius_mm": 2.1}, view=(15, 8), array=BRICK, render=EXACT), OF_ARRAY, EACH),
    "errors of all kinds, pinholes, hexagons over a layer, oblique": wrong(made(PINHOLE, view=OBLIQUE, array=HEXAGON, panel=layers(GLASS), render=EXACT),
        OF_ARRAY, NO_CURVATURE),
    "errors of all kinds, ideal circle, rectangles, 30 degrees": wrong(made(IDEAL, view=(30,), array=lattice("rectangle", [8.3, 8.0])), OF_ARRAY, EACH),
    "errors of caps, plate circle, 15 degrees": wrong(made(SPHERE, "plate", view=(15,)), each=CAPS),
    "errors of caps, hexagons, plate cell, wedge, bow, oblique": wrong(made(ROUNDER, "plate", "cell", OBLIQUE, HEXAGON, render=EXACT),
        {"wedge_deg": [0.8, 0.6], "bow_mm": 0.3}, CAPS),
    "errors of lenses glued onto layers, opaque circle, 20 degrees": wrong(made(SPHERE_TALL, view=(20,), panel=layers(THICK, ADHESIVE), array=on_top(THICK, ADHESIVE), render=EXACT),
        LEVEL, FLAT),
    "errors of all kinds, large, hollow lenses in cells, 35 degrees": wrong(made(WIDE_HOLLOW, "opaque", "cell", (30, 20)), OF_ARRAY,
        {**LATERAL, "dz_mm": 0.4, "tilt_x_deg": 4.0, "tilt_y_deg": 4.0}, seed=38),
    "errors of a few lenses, large, opaque circle, on axis": wrong(made(SPHERE, render=EXACT), {"table": MIDDLE}),
    "errors drawn, opaque circle, oblique": wrong(made(SPHERE, view=OBLIQUE, render=EXACT), DRAWN),
    "errors drawn and by table, slanted strips, plate": wrong(made(SPHERE, "plate", view=(15,), array=LEAN),
        {**DRAWN, "tilt_sd_deg": 0.0, "decenter_sd_mm": 0.04}, {**CAPS, "dx_mm": 0.12}, share=0.5),
}

# Asked where there is time.
MORE = {
    "errors of all kinds, opaque circle, 60 degrees": wrong(made(SPHERE, view=(60,), render=EXACT), OF_ARRAY, EACH, seed=2),
    "errors of all kinds, opaque cell, 45 degrees, past the border": wrong(made(ROUNDER, "opaque", "cell", (30, 30), **PAST_BORDER), OF_ARRAY, EACH, seed=3),
    "errors of all kinds, opaque cell, panel facing, oblique": wrong(made(ROUNDER_TURNED, "opaque", "cell", OBLIQUE, TILTED, render=SCHLICK), OF_ARRAY, EACH, seed=4),
    "errors of all kinds, almost half balls, opaque circle, 15 degrees": wrong(made({**SPHERE, "sphere_radius_mm": 4.1, "cylinder_height_mm": 0.5}, view=(15,), array={"base_z_mm": 4.0}),
        OF_ARRAY, EACH, seed=5),
    "errors of all kinds, tall walls, tall bricks, opaque cell, oblique": wrong(made({**REACHING, "cylinder_height_mm": 4.0}, "opaque", "cell", OBLIQUE, BRICK_TALL, render=EXACT),
        OF_ARRAY, EACH, seed=6),
    "errors of all kinds, hexagons of 4 x 3, past the border": wrong(made(SPHERE, view=(30, 20), array=HEXAGONS_FEW, **PAST_BORDER), OF_ARRAY, EACH, seed=7),
    "errors of all kinds, camera close by": wrong(made(ROUNDER, "opaque", "cell", array=HEXAGON, render=EXACT, **NEAR), OF_ARRAY, EACH, seed=8),
    "errors of all kinds, conics, oblique": wrong(made(CONICS, view=OBLIQUE, render=EXACT), OF_ARRAY, EACH, seed=9),
    "errors of all kinds, menisci, strips, 30 degrees": wrong(made(MENISCUS, view=(30,), array=LEAN_LEFT), OF_ARRAY, EACH, seed=10),
    "errors of all kinds, hollow lenses, 30 degrees": wrong(made(HOLLOW, view=(30,), render=EXACT), OF_ARRAY, EACH, seed=11),
    "errors of all kinds, hollow lenses in cells, oblique": wrong(made(WIDE_HOLLOW, "opaque", "cell", OBLIQUE), OF_ARRAY, EACH, seed=12),
    "errors of all kinds, aspheres in cells, strips, 45 degrees": wrong(made(ASPHERE_CELL, "opaque", "cell", (30, 32), LEAN, render=EXACT), OF_ARRAY, EACH, seed=13),
    "errors of all kinds, aspheres in cells, bricks, oblique": wrong(made(ASPHERE_CELL, "opaque", "cell", OBLIQUE, BRICK), OF_ARRAY, EACH, seed=14),
    "errors of all kinds, two spaced elements, stop, oblique": wrong(made({**SPACED, "stop_radius_mm": 2.5}, view=OBLIQUE, render=EXACT), OF_ARRAY, EACH, seed=15),
    "errors of all kinds, ideal, stop, hexagon cell, 58 degrees": wrong(made({**IDEAL, "stop_radius_mm": 2.5}, "opaque", "cell", STEEP, HEXAGON), OF_ARRAY, EACH, seed=16),
    "errors of all kinds, ideal strips, slant 60 degrees, stop": wrong(made({**IDEAL, "stop_radius_mm": 1.5}, view=OBLIQUE, array=lattice("strips", slant=60.0)),
        OF_ARRAY, EACH, seed=17),
    "errors of all kinds, pinhole slits over layers, gap": wrong(made(PINHOLE, view=(40,), array={**LEAN, **AHEAD}, panel=layers(GLASS, DENSE), render=EXACT),
        OF_ARRAY, NO_CURVATURE, seed=18),
    "errors of all kinds, emission 2.5, sRGB panel, layers": wrong(made(SPHERE, view=(20, 10), panel={**layers(GLASS), "emission_exponent": 2.5, "encoding": "srgb"}, render=EXACT),
        OF_ARRAY, EACH, seed=19),
    "errors of caps, plate cell, panel facing, 30 degrees": wrong(made(ROUNDER_TURNED, "plate", "cell", (30,), render=EXACT), OF_ARRAY, CAPS, seed=20),
    "errors of caps, plate of conics, bricks, oblique": wrong(made(CONICS, "plate", view=OBLIQUE, array=lattice("brick", [8.3, 8.0])), OF_ARRAY, CAPS, seed=21),
    "errors of caps, biconvex plate cell, tall bricks": wrong(made(BICONVEX_CELL, "plate", "cell", (15,), BRICK_TALL), OF_ARRAY, CAPS, seed=22),
    "errors of caps, plate of aspheres, 30 degrees": wrong(made(WIDE_ASPHERE, "plate", "cell", (30,)), OF_ARRAY, CAPS, seed=23),
    "errors of caps, strips, plate cell, 45 degrees": wrong(made(ROUNDER, "plate", "cell", (30, 32), LEAN), OF_ARRAY, CAPS, seed=24),
    "errors of caps, plate circle, stop, 15 degrees": wrong(made({**SPHERE, "stop_radius_mm": 2.0}, "plate", view=(15,)), OF_ARRAY, CAPS, seed=25),
    "errors of caps, plate cell, panel facing, stop, 30 degrees": wrong(made({**ROUNDER_TURNED, "stop_radius_mm": 2.0}, "plate", "cell", (30,), render=EXACT),
        each=CAPS, seed=41),
    "errors of caps, plate circle, 58 degrees, wedge": wrong(made(SPHERE, "plate", view=STEEP, render=EXACT), {"wedge_deg": [1.5, -1.0]}, CAPS, seed=26),
    "errors of a glued plate, hexagon cell, oblique": wrong(made(ROUNDER, "plate", "cell", OBLIQUE, {**HEXAGON, **on_top(THICK)}, panel=layers(THICK), render=EXACT),
        LEVEL, FLAT, seed=27),
    "errors of lenses glued onto the bare panel, opaque cell": wrong(made({**ROUNDER, "cylinder_height_mm": 5.0}, "opaque", "cell", (15,), {"base_z_mm": 0.0}, render=EXACT),
        LEVEL, FLAT, seed=28),
    "errors of strips glued onto a layer, opaque cell, oblique": wrong(made({**ROUNDER, "cylinder_height_mm": 5.0}, "opaque", "cell", OBLIQUE, {**LEAN, **on_top(GLASS)},
        panel=layers(GLASS), render=EXACT), LEVEL, FLAT, seed=29),
    "errors of a few lenses, large, opaque cell, 45 degrees": wrong(made({**ROUNDER, "sphere_radius_mm": 7.7}, "opaque", "cell", (30, 32), render=EXACT), {"table": MIDDLE}),
    "errors of half of the lenses, bricks, opaque circle": wrong(made(SPHERE, view=(15,), array=BRICK), {}, EACH, seed=30, share=0.5),
    "errors of an array of a million lenses, oblique": wrong(made(MILLION, view=OBLIQUE, array={"count": [1000, 1000], "pitch_mm": 0.108, "base_z_mm": 0.1},
        panel={"pixels": [3840, 3600], "pixel_pitch_mm": 0.03}, camera={"frame_width_mm": 9.0}),
        {"shift_mm": [0.02, -0.03], "gap_mm": 0.01, "rotation_deg": 0.4, "pitch_ppm": 400.0, "wedge_deg": [0.02, -0.01], "bow_mm": 0.03}),
    "errors drawn, upright strips, opaque circle, 15 degrees": wrong(made(SPHERE, view=(15,), array=STRIPS, render=EXACT), {**DRAWN, **OF_ARRAY}),
    "errors drawn, hexagons, ideal cell, oblique": wrong(made(IDEAL, "opaque", "cell", OBLIQUE, HEXAGON), {**DRAWN, "seed": 12}),
    "errors drawn and by table, aspheres, opaque circle": wrong(made(ASPHERE, view=(15, 10)), {**DRAWN, "decenter_sd_mm": 0.06}, {"dx_mm": 0.1, "tilt_y_deg": 1.0}),
}

# In colour: each channel has its own picture.
COLOURED_SHORT = {
    "errors of all kinds, subpixels delta, glass, hexagons, oblique": wrong(shown(of(VIVID, ROUNDER), "delta", "opaque", "cell", OBLIQUE, HEXAGON), OF_ARRAY, EACH, seed=31),
}
COLOURED_MORE = {
    "errors of caps, subpixels rgb_stripe, slanted strips, plate": wrong(shown(of(BK7, SPHERE), "rgb_stripe", "plate", view=(15,), array=LEAN), OF_ARRAY, CAPS, seed=32),
    "errors drawn, subpixels pentile_rgbg, q 0.6, stop": wrong(shown({**SPHERE, "stop_radius_mm": 2.6}, "pentile_rgbg", view=(12,), q=0.6), DRAWN),
}

# Means over many samples.
BLURRED_SHORT = {
    "errors of all kinds, box diffuser": wrong(made(SPHERE, view=(8,), camera=SMALL, diffuser=DIFFUSER, render=EXACT), OF_ARRAY, EACH, seed=33),
}
BLURRED_MORE = {
    "errors of all kinds, hexagon cells, weak diffuser": wrong(made(ROUNDER, "opaque", "cell", (12,), HEXAGON, camera=SMALL, diffuser={**DIFFUSER, "angle_deg": [1.5, 1.0]}),
        OF_ARRAY, EACH, seed=34),
    "errors of all kinds, strips, pixel area, thin-lens camera": wrong(made(ROUNDER, "opaque", "cell", (12, 5), LEAN,
        camera={**SMALL, "pixel_filter": "box", "pupil_diameter_mm": 18.0, "focus_distance_mm": 600.0}), OF_ARRAY, EACH, seed=35),
    "errors of caps, plate, box diffuser": wrong(made(SPHERE, "plate", camera=SMALL, diffuser=DIFFUSER), OF_ARRAY, CAPS, seed=36),
    "errors of all kinds, ideal cells, subpixels rgb_stripe, diffuser": wrong(shown(IDEAL, "rgb_stripe", "opaque", "cell", (10,), camera=SMALL, diffuser=DIFFUSER),
        OF_ARRAY, EACH, seed=37),
    "errors drawn, tall walls, gaussian diffuser": wrong(made(SPHERE_TALL, view=(15,), camera=SMALL, diffuser={**DIFFUSER, "profile": "gaussian"}), DRAWN),
}
