"""The displays and cameras of subpixels and colour: pictures of one ray per pixel and means, each title with `subpixels`, `glass` or both."""
from cases import ASPHERE, CEMENTED, CONICS, DIFFUSER, EXACT, IDEAL, MENISCUS, OBLIQUE, PUPIL, ROUNDER, SCHLICK, SMALL, SPACED, SPHERE, TILTED, TURNED
from lattice_cases import (ADHESIVE, AHEAD, ASPHERE_CELL, BEHIND, BRICK, BRICK_TALL, BRICK_WIDE, FACING, FLAT_BACK, GLASS, HEXAGON, LEAN, LEAN_LEFT, PAST_BORDER,
                           PINHOLE, REACHING, SPHERE_TALL, STEEP, STRIPS, THICK, lattice, layers, made, on_top)
from subpixels import rectangle

# Fewer and larger pixels and a closer look than in the other cases, so that most of a picture is off the borders of subpixels.
COARSE = {"pixels": [400, 266], "pixel_pitch_mm": 0.27}
CLOSER = {"frame_width_mm": 44.0}


def shown(lens, subpixels="none", surround="opaque", aperture="circle", view=None, array=None, panel=(), camera=(), q=None, render=EXACT, **over):
    """As made(), of a coarse panel with these subpixels (the name of a preset, or (cell, rectangles)) and the aperture ratio q."""
    kind = {"subpixels": subpixels} if isinstance(subpixels, str) else {"subpixels": "custom", "subpixel_cell": subpixels[0], "subpixel": subpixels[1]}
    ratio = {"aperture_ratio": q} if q else {}
    return made(lens, surround, aperture, view, array, panel={**COARSE, **kind, **ratio, **dict(panel)}, camera={**CLOSER, **dict(camera)}, render=render, **over)


def of(glass, lens):
    """The lens made of a glass, or of one for each medium."""
    if lens["type"] == "plano_convex":
        return {**{key: value for key, value in lens.items() if key != "index"}, "glass": glass}
    glasses = [*glass, None] if isinstance(glass, list) else [glass] * (len(lens["surface"]) - 1) + [None]
    rows = [{**{key: value for key, value in row.items() if key != "index"}, **({"glass": g} if g else {})} for row, g in zip(lens["surface"], glasses)]
    return {**lens, "surface": rows}


def plate(thickness, glass):
    return {"thickness_mm": thickness, "glass": glass}


BK7 = {"sellmeier": [1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653]}
SULTANOVA = {"sellmeier": [1.1819, 0.011313, 0.0, 0.0, 0.0, 0.0]}  # PMMA as a fit of one term has it
CAUCHY = {"cauchy": [1.47, 0.0098, 0.00042]}
CROWN, FLINT = {"nd": 1.4918, "vd": 57.4}, {"nd": 1.755, "vd": 27.5}
VIVID = {"nd": 1.62, "vd": 9.0}  # no glass, but colours far apart
EVEN = {"cauchy": [1.5, 0.0, 0.0]}
BROAD = {"primary_widths_nm": [22.0, 35.0, 18.0]}
NODES = {**EXACT, "wavelength_samples": 3}

# Of a cell of 3 x 2: rectangles of many sizes that hang over its borders, two of one channel and pixel, some beside the pixel they show, some pixels not in all colours.
ODD = ([3, 2], [
    rectangle("r", (0, 0), -0.2, 0.1, 0.5, 0.7), rectangle("r", (0, 0), 0.1, 0.75, 0.4, 1.0), rectangle("g", (0, 0), 0.5, 0.0, 1.1, 0.5),
    rectangle("b", (0, 0), 0.55, 0.5, 0.9, 1.3), rectangle("r", (1, 0), 1.2, 0.0, 1.5, 1.0), rectangle("g", (1, 0), 1.5, 0.2, 2.0, 0.9),
    rectangle("b", (2, 0), 2.1, -0.3, 2.7, 0.45), rectangle("g", (0, 1), 0.0, 1.1, 0.5, 1.6), rectangle("b", (2, 1), 0.1, 1.65, 0.8, 1.95),
    rectangle("r", (1, 1), 1.0, 1.35, 1.9, 1.95), rectangle("g", (2, 1), 2.0, 1.0, 2.6, 1.55), rectangle("g", (2, 1), 2.72, 1.3, 2.98, 2.08)])
RGBG = ([1, 1], [rectangle(channel, (0, 0), k / 4, 0, k / 4 + 0.25, 1) for k, channel in enumerate("rgbg")])
SWAPPED = ([2, 1], [rectangle(channel, (1 - i, 0), i + k / 3, 0, i + (k + 1) / 3, 1) for i in range(2) for k, channel in enumerate("bgr")])  # each shows the other
CORNERS = ([1, 1], [rectangle("r", (0, 0), -0.3, -0.3, 0.2, 0.2), rectangle("g", (0, 0), 0.25, 0.25, 0.6, 0.6), rectangle("b", (0, 0), 0.65, 0.3, 0.95, 0.65)])
QUAD = ([1, 1], [rectangle("r", (0, 0), 0.0, 0.0, 0.5, 0.5), rectangle("g", (0, 0), 0.5, 0.0, 1.0, 0.5), rectangle("g", (0, 0), 0.0, 0.5, 0.5, 1.0),
                 rectangle("b", (0, 0), 0.5, 0.5, 1.0, 1.0)])
SPARSE = ([2, 3], [rectangle("r", (0, 0), 0.1, 0.2, 1.4, 0.9), rectangle("g", (1, 1), 0.6, 1.1, 2.3, 1.7), rectangle("b", (0, 2), -0.4, 2.0, 0.9, 2.8)])

# Asked even where time is short.
SHORT = {
    "subpixels rgb_stripe, on axis": shown(SPHERE, "rgb_stripe"),
    "subpixels pentile_rgbg, q 0.6, hexagons, opaque cell, 30 degrees": shown(ROUNDER, "pentile_rgbg", "opaque", "cell", (30,), HEXAGON, q=0.6),
    "subpixels delta, clear, rotated and offset, oblique": shown(SPHERE, "delta", "clear", view=OBLIQUE, array=TILTED),
    "subpixels bgr_stripe, slanted strips, plate, 15 degrees": shown(SPHERE, "bgr_stripe", "plate", view=(15,), array=LEAN),
    "subpixels rgb_rows, q 0.35, bricks, plate cell, oblique": shown(REACHING, "rgb_rows", "plate", "cell", OBLIQUE, BRICK_WIDE, q=0.35),
    "subpixels, odd cell, q 0.8, glued onto layers, clear, oblique": shown(SPHERE_TALL, ODD, "clear", view=OBLIQUE, array=on_top(THICK, ADHESIVE), panel=layers(THICK, ADHESIVE), q=0.8),
    "glass of Sellmeier, opaque, oblique": shown(of(BK7, SPHERE), view=OBLIQUE),
    "glass of n_d and V_d, subpixels rgb_stripe, slanted strips glued onto glass, opaque cell": shown(of(FLINT, {**ROUNDER, "cylinder_height_mm": 5.0}), "rgb_stripe", "opaque",
        "cell", (12, 20), {**LEAN, "base_z_mm": 1.9}, panel=layers(plate(1.9, BK7))),
    "glass of Cauchy, clear, 30 degrees, black matrix": shown(of(CAUCHY, SPHERE), "none", "clear", view=(30,), q=0.5),
    "glass by name, asphere, gap, subpixels delta, hexagons": shown(of("PMMA", ASPHERE), "delta", view=(15,), array={**HEXAGON, "gap_mm": 9.3}),
    "glass at three wavelengths a channel, subpixels pentile_rgbg, oblique": shown(of(VIVID, SPHERE), "pentile_rgbg", view=OBLIQUE, panel=BROAD, render=NODES),
    "glass layers under pinholes, subpixels bgr_stripe, 50 degrees": shown({**PINHOLE, "aperture_radius_mm": 3.0}, "bgr_stripe", view=(50,),
        panel=layers(plate(2.2, VIVID), plate(0.7, CAUCHY))),
}

# Asked where there is time.
MORE = {
    "subpixels rgb_stripe, q 0.5, 45 degrees, past the border": shown(ROUNDER, "rgb_stripe", "opaque", "cell", (30, 32), camera=PAST_BORDER["camera"], q=0.5),
    "subpixels delta at the panel's corner": shown(SPHERE, "delta", "plate", camera={"target_mm": [-51.0, 33.0, 0.0], "frame_width_mm": 20.0}),
    "subpixels, odd cell at the panel's corner": shown(SPHERE, ODD, "clear", camera={"target_mm": [51.0, -33.0, 0.0], "frame_width_mm": 20.0}),
    "subpixels, swapped pixels, odd number of columns": shown(SPHERE, SWAPPED, view=(10,), panel={"pixels": [401, 265]}, camera={"target_mm": [51.0, 3.0, 0.0], "frame_width_mm": 22.0}),
    "subpixels pentile_rgbg, odd numbers of pixels, corner": shown(IDEAL, "pentile_rgbg", "opaque", "cell", panel={"pixels": [399, 265]},
        camera={"target_mm": [50.0, -32.0, 0.0], "frame_width_mm": 22.0}),
    "subpixels rgb_rows, rectangles, clear cell, oblique": shown(REACHING, "rgb_rows", "clear", "cell", OBLIQUE, lattice("rectangle", [10.4, 7.2])),
    "subpixels delta, q 0.7, tall rectangles, opaque cell, rotated": shown(REACHING, "delta", "opaque", "cell", (20,), {**lattice("rectangle", [6.9, 9.3]), **TILTED}, q=0.7),
    "subpixels bgr_stripe, hexagons, clear cell, 30 degrees": shown(ROUNDER, "bgr_stripe", "clear", "cell", (30,), HEXAGON),
    "subpixels rgb_stripe, hexagons upright, plate, oblique": shown(SPHERE, "rgb_stripe", "plate", view=OBLIQUE, array={**HEXAGON, "rotation_deg": 90.0}, render=SCHLICK),
    "subpixels pentile_rgbg, q 0.4, bricks, opaque, 30 degrees": shown(SPHERE, "pentile_rgbg", view=(30,), array=BRICK, q=0.4),
    "subpixels, corners, tall bricks, plate cell, rotated": shown(REACHING, CORNERS, "plate", "cell", (12, 8), {**BRICK_TALL, **TILTED}),
    "subpixels rgb_stripe, slanted strips, opaque, 58 degrees": shown(SPHERE, "rgb_stripe", view=STEEP, array=LEAN),
    "subpixels delta, strips slanted to the left, clear cell, oblique": shown(ROUNDER, "delta", "clear", "cell", OBLIQUE, LEAN_LEFT, q=0.65),
    "subpixels pentile_rgbg, upright strips, plate, 30 degrees": shown(SPHERE, "pentile_rgbg", "plate", view=(30,), array=STRIPS),
    "subpixels, sparse cell, slanted strips of conics": shown(CONICS, SPARSE, view=OBLIQUE, array=LEAN),
    "subpixels rgbg, ideal cell, gap ahead, emission 2": shown(IDEAL, RGBG, "opaque", "cell", (15,), AHEAD, panel={"emission_exponent": 2.0}),
    "subpixels, quads, q 0.3, pinholes, bricks, gap": shown({**PINHOLE, "aperture_radius_mm": 3.2}, QUAD, view=OBLIQUE, array={**BRICK_WIDE, **BEHIND}, panel=layers(GLASS), q=0.3),
    "subpixels rgb_stripe, sRGB panel, stop, panel facing": shown({**TURNED, "stop_radius_mm": 2.4}, "rgb_stripe", view=(15,), panel={"encoding": "srgb"}, q=0.75),
    "subpixels, odd cell, cemented doublet, hexagons, rotated": shown(CEMENTED, ODD, view=OBLIQUE, array={**HEXAGON, **TILTED}),
    "subpixels, sparse cell, glued onto a layer, plate cell": shown(ROUNDER, SPARSE, "plate", "cell", (15, 10), on_top(THICK), panel=layers(THICK), q=0.6),
    "subpixels delta, meniscus, emission 1.5": shown(MENISCUS, "delta", view=(20,), panel={"emission_exponent": 1.5}),
    "glass of Sellmeier, plate cell, rotated, 30 degrees": shown(of(BK7, ROUNDER), "none", "plate", "cell", (30,), TILTED),
    "glass of one Sellmeier term, hexagons, clear cell, panel facing": shown(of(SULTANOVA, {**ROUNDER, **FACING}), "none", "clear", "cell", OBLIQUE, HEXAGON),
    "glass of n_d and V_d, bricks, opaque cell, past the border": shown(of(FLINT, REACHING), "none", "opaque", "cell", (30, 20), BRICK_TALL, camera=PAST_BORDER["camera"]),
    "glass of Cauchy, slanted strips, plate, 45 degrees": shown(of(CAUCHY, SPHERE), "none", "plate", view=(30, 32), array=LEAN),
    "glass of constant index, subpixels rgb_stripe": shown(of(EVEN, SPHERE), "rgb_stripe", view=OBLIQUE),
    "glass by name, PC, gap, clear, subpixels rgb_rows": shown(of("PC", SPHERE), "rgb_rows", "clear", view=(15,), array={"gap_mm": 8.0}),
    "glasses of a cemented doublet, subpixels bgr_stripe, 30 degrees": shown(of([CROWN, FLINT], CEMENTED), "bgr_stripe", view=(30,)),
    "glasses of two spaced elements, stop, oblique": shown({**of([FLINT, None, "N-BK7"], SPACED), "stop_radius_mm": 2.5}, "delta", view=OBLIQUE),
    "glass asphere, plate cell, subpixels pentile_rgbg, bricks": shown(of(VIVID, ASPHERE_CELL), "pentile_rgbg", "plate", "cell", (12, 9), BRICK, q=0.8),
    "glass flat back glued onto glass of its own, subpixels, odd cell": shown(of(CROWN, FLAT_BACK), ODD, "clear", view=(20,), array={"base_z_mm": 3.0}, panel=layers(plate(3.0, CROWN))),
    "glass glued onto a constant layer, plate, subpixels delta, hexagons": shown(of(FLINT, SPHERE), "delta", "plate", view=OBLIQUE, array={**HEXAGON, **on_top(THICK)},
        panel=layers(THICK)),
    "glass glued onto the bare panel, emission 2, subpixels rgb_stripe": shown(of(VIVID, {**SPHERE, "cylinder_height_mm": 6.0}), "rgb_stripe", view=(25,), array={"base_z_mm": 0.0},
        panel={"emission_exponent": 2.0}),
    "glass layers under ideal lenses, gap, subpixels rgb_stripe, 40 degrees": shown(IDEAL, "rgb_stripe", "opaque", "cell", (40,), AHEAD, panel=layers(plate(3.1, VIVID), ADHESIVE)),
    "glass layers under slanted ideal strips, subpixels rgbg": shown(IDEAL, RGBG, view=OBLIQUE, array={**LEAN_LEFT, **BEHIND}, panel=layers(plate(4.0, FLINT), plate(0.3, BK7))),
    "glass layers, the lens of a constant index, subpixels bgr_stripe": shown(SPHERE, "bgr_stripe", "clear", view=(30, 15), panel=layers(plate(2.5, FLINT))),
    "glass at other wavelengths, subpixels rgb_stripe": shown(of(FLINT, SPHERE), "rgb_stripe", view=(20,), panel={"wavelengths_nm": [660.0, 505.0, 440.0]}),
    "glass at three wavelengths a channel, no subpixels, clear, 30 degrees": shown(of(FLINT, SPHERE), "none", "clear", view=(30,), panel=BROAD, render=NODES,
        camera={"frame_width_mm": 22.0}),
    "glass at four wavelengths a channel, slanted strips, subpixels, odd cell": shown(of(VIVID, ROUNDER), ODD, "opaque", "cell", OBLIQUE, LEAN, panel=BROAD,
        render={**EXACT, "wavelength_samples": 4}),
    "glass, total reflection, opaque, 60 degrees, subpixels rgb_stripe": shown(of(VIVID, {**SPHERE, "cylinder_height_mm": 3.0}), "rgb_stripe", view=(60,)),
}

# Means over many samples, of panels whose subpixels differ much.
BLURRED_SHORT = {
    "subpixels rgb_stripe, box diffuser": shown(SPHERE, "rgb_stripe", view=(8,), camera=SMALL, diffuser=DIFFUSER),
    "subpixels, odd cell, glass, all at once": shown(of(VIVID, ASPHERE), ODD, view=OBLIQUE, camera={**SMALL, **PUPIL, "pixel_filter": "box"},
        diffuser={**DIFFUSER, "profile": "gaussian"}, array=TILTED, q=0.7),
}
BLURRED_MORE = {
    "subpixels pentile_rgbg, q 0.4, pixel area, hexagons": shown(ROUNDER, "pentile_rgbg", "opaque", "cell", (12,), HEXAGON, camera={**SMALL, "pixel_filter": "box"}, q=0.4),
    "subpixels delta, slanted strips, diffuser": shown(SPHERE, "delta", view=(15,), camera=SMALL, array=LEAN, diffuser={**DIFFUSER, "angle_deg": [1.0, 20.0]}),
    "subpixels rgb_rows, thin-lens camera, plate": shown(SPHERE, "rgb_rows", "plate", view=(12, 5), camera={**SMALL, **PUPIL, "pixel_filter": "box"}),
    "glass, box diffuser, clear": shown(of(VIVID, SPHERE), "none", "clear", view=(15,), camera=SMALL, diffuser=DIFFUSER),
    "glass at three wavelengths a channel, subpixels bgr_stripe, box diffuser": shown(of(FLINT, SPHERE), "bgr_stripe", camera=SMALL, diffuser=DIFFUSER, panel=BROAD, render=NODES),
    "glass layers under ideal strips, subpixels rgb_stripe, pixel area": shown(IDEAL, "rgb_stripe", "opaque", "cell", (20,), LEAN, panel=layers(plate(3.0, VIVID)),
        camera={**SMALL, "pixel_filter": "box"}),
}

# Means over little: a picture pixel sees a few subpixels, or a part of one, of a panel full of noise.
TINY = {**SMALL, "frame_width_mm": 2.4}
AREA = {**TINY, "pixel_filter": "box"}
WEAK = {"distance_mm": 20.0, "angle_deg": [0.8, 0.5], "profile": "box"}
FINE_SHORT = {
    "subpixels delta, q 0.8, hexagons, a small pixel area": shown(SPHERE, "delta", view=(3,), array=HEXAGON, camera=AREA, q=0.8),
    "glass, subpixels rgb_stripe, a weak diffuser": shown(of(VIVID, SPHERE), "rgb_stripe", view=(3, 2), camera=TINY, diffuser=WEAK),
}
FINE_MORE = {
    "subpixels, odd cell, a small pixel area": shown(SPHERE, ODD, view=(4, 3), camera=AREA),
    "subpixels, odd cell, turned, a weak diffuser": shown(SPHERE, ODD, "opaque", "circle", (2, 2), TILTED, camera=TINY, diffuser=WEAK, q=0.6),
    "subpixels pentile_rgbg, clear, a weak diffuser": shown(SPHERE, "pentile_rgbg", "clear", view=(3, 1), camera=TINY, diffuser=WEAK, q=0.5),
    "subpixels bgr_stripe, slanted strips, a small pixel area": shown(SPHERE, "bgr_stripe", view=(3, 4), array=LEAN, camera=AREA),
    "subpixels rgb_rows, strips, a weak diffuser, wide along them": shown(SPHERE, "rgb_rows", view=(3, 4), array=STRIPS, camera=TINY,
        diffuser={**WEAK, "angle_deg": [0.5, 6.0]}),
    "subpixels rgbg, layers, bricks, a small pupil": shown(SPHERE, RGBG, view=(3, 2), array=BRICK, panel=layers(GLASS),
        camera={**AREA, "pupil_diameter_mm": 2.0, "focus_distance_mm": 650.0}),
    "glass, no subpixels, a black matrix, a small pixel area": shown(of(VIVID, SPHERE), "none", view=(5,), camera=AREA, q=0.5),
    "glass at three wavelengths a channel, subpixels delta, a weak diffuser": shown(of(VIVID, SPHERE), "delta", view=(3,), camera=TINY, diffuser=WEAK, panel=BROAD, render=NODES),
    "glass layers, subpixels rgb_stripe, a small pixel area": shown(IDEAL, "rgb_stripe", "opaque", "cell", (12,), camera=AREA, panel=layers(plate(3.0, VIVID))),
}
