"""The displays and cameras of lattices, cylindrical lenses, layers and pinholes: pictures of one ray per pixel, each title with one of these words."""
from cases import ASPHERE, CEMENTED, CONICS, EXACT, HOLLOW, IDEAL, MENISCUS, OBLIQUE, ROUNDER, SCHLICK, SPACED, SPHERE, TILTED, TURNED, case, surface, surfaces

P = 7.92  # the pitch where nothing else is given
STEEP = (52, 24)  # a camera almost 60 degrees off the axis
SPHERE_LOW, SPHERE_TALL = ({**SPHERE, "cylinder_height_mm": h} for h in (0.4, 3.0))
PINHOLE = {"type": "pinhole", "aperture_radius_mm": 1.6}
FULL_PINHOLE = {**PINHOLE, "aperture_radius_mm": P / 2}
FACING = {"facing": "panel"}
BICONVEX_CELL = surfaces(surface(0.03, 5.9, 4.6, 1.5, conic=-1.2), surface(-0.1, 5.9, conic=-0.4))  # covers every cell's corners
ASPHERE_CELL = surfaces(surface(0.0, 5.9, 3.4, 1.4918), surface(-1 / 6.6, 5.9, conic=-0.5, even=[2e-5]))
SMALL_CIRCLE = surfaces(surface(0.0, 4.2, 2.6, 1.52), surface(-0.14, 4.2, conic=-0.4))  # fills a cell but for its corners
FLAT_BACK = surfaces(surface(0.0, 3.9, 2.4, 1.5), surface(-0.17, 3.9, conic=-0.8))


def lattice(name, pitch=P, slant=None, count=None, **array):
    """The array's part of a description; without count lfdsim finds it."""
    given = {"pitch_mm": pitch, "lattice": name, **array}
    return {**given, **({"slant_deg": slant} if slant is not None else {}), **({"count": count} if count else {})}


HEXAGON, HEXAGONS_FEW = lattice("hexagon"), lattice("hexagon", count=[4, 3])
BRICK, BRICK_WIDE, BRICK_TALL = lattice("brick"), lattice("brick", [10.4, 7.2]), lattice("brick", [6.9, 9.3])
STRIPS, LEAN, LEAN_LEFT = lattice("strips"), lattice("strips", slant=9.46), lattice("strips", slant=-23.0)
REACHING = {**ROUNDER, "sphere_radius_mm": 6.6}       # to the corners of 10.4 x 7.2 and 6.9 x 9.3
FLATTER = {**ROUNDER, "sphere_radius_mm": 9.0}

GLASS = {"thickness_mm": 1.9, "index": 1.52}
ADHESIVE, FILM = {"thickness_mm": 0.25, "index": 1.41}, {"thickness_mm": 0.6, "index": 1.49}
DENSE, RARE = {"thickness_mm": 0.8, "index": 1.74}, {"thickness_mm": 0.4, "index": 1.3}
THICK = {"thickness_mm": 11.6, "index": 1.52}  # what is glued onto it is nearly in focus


def layers(*plates):
    """The panel's part of a description: plates from the panel upwards."""
    return {"layer": list(plates)}


def on_top(*plates):
    """The height of what is glued onto the plates."""
    return {"base_z_mm": sum(plate["thickness_mm"] for plate in plates)}


def made(lens, surround="opaque", aperture="circle", view=None, array=None, **over):
    """As case(), but an array of its own lattice has a count only where one is given, and a gap stands in place of the height of the base."""
    array = array or {}
    display = case(lens, surround, aperture, view, array=array, **over)
    for key, replaced in (("count", "lattice" in array and "count" not in array), ("base_z_mm", "gap_mm" in array)):
        if replaced:
            del display["array"][key]
    return display


PAST_BORDER = {"camera": {"frame_width_mm": 150.0}}
NEAR = {"camera": {"position_mm": [-20.0, 10.0, 60.0], "target_mm": [5.0, 3.0, 0.0], "frame_width_mm": 90.0, "up": [0.2, 1.0, 0.1]}}
BEHIND, AHEAD = {"gap_mm": 8.0}, {"gap_mm": 13.0}  # central depth planes behind the lenses and in front of them, f about 10.2

# Asked even where time is short.
SHORT = {
    "hexagon lattice, opaque circle, on axis": made(SPHERE, array=HEXAGON, render=EXACT),
    "hexagon lattice, opaque cell, 30 degrees": made(ROUNDER, "opaque", "cell", (30,), HEXAGON, render=EXACT),
    "hexagon lattice, clear cell, rotated and offset, oblique": made(ROUNDER, "clear", "cell", OBLIQUE, {**HEXAGON, **TILTED}, render=EXACT),
    "hexagon lattice, plate cell, 58 degrees": made(FLATTER, "plate", "cell", STEEP, HEXAGON),
    "hexagon lattice, ideal cell, 15 degrees, gap": made(IDEAL, "opaque", "cell", (15,), {**HEXAGON, **AHEAD}),
    "hexagon lattice of 4 x 3, clear circle, past the border": made(SPHERE, "clear", "circle", (30, 20), HEXAGONS_FEW, **PAST_BORDER),
    "brick lattice, opaque circle, oblique, stop": made({**SPHERE, "stop_radius_mm": 2.1}, view=OBLIQUE, array=BRICK, render=EXACT),
    "brick lattice, wide, opaque cell, 45 degrees": made(REACHING, "opaque", "cell", (30, 32), BRICK_WIDE, render=EXACT),
    "brick lattice, tall, clear cell, rotated, oblique": made(REACHING, "clear", "cell", OBLIQUE, {**BRICK_TALL, **TILTED}),
    "brick lattice, wide, plate cell, 30 degrees": made(REACHING, "plate", "cell", (0, 30), BRICK_WIDE, render=EXACT),
    "brick lattice, tall, plate cell, panel facing, oblique": made({**REACHING, **FACING}, "plate", "cell", OBLIQUE, BRICK_TALL, render=SCHLICK),
    "brick lattice, plate circle, 15 degrees": made(SPHERE, "plate", "circle", (15,), BRICK),
    "brick lattice, ideal cell, wide, rotated, oblique": made(IDEAL, "opaque", "cell", OBLIQUE, {**BRICK_WIDE, **TILTED}),
    "square lattice counted, rotated and offset": made(SPHERE, view=(15,), array=lattice("square", **TILTED), render=EXACT),
    "upright strips, opaque, 15 degrees": made(SPHERE, view=(15,), array=STRIPS, render=EXACT),
    "slanted strips, opaque cell, on axis": made(ROUNDER, "opaque", "cell", array=LEAN, render=EXACT),
    "slanted strips, opaque, 58 degrees": made(SPHERE, view=STEEP, array=LEAN, render=EXACT),
    "strips slanted to the left, clear, oblique": made(SPHERE, "clear", "circle", OBLIQUE, LEAN_LEFT, render=EXACT),
    "slanted strips, clear cell, 30 degrees up": made(ROUNDER, "clear", "cell", (5, 30), LEAN),
    "strips slanted to the left, plate cell, offset, oblique": made(ROUNDER, "plate", "cell", OBLIQUE, {**LEAN_LEFT, "offset_mm": [1.3, -2.1]}, render=EXACT),
    "strips by rotation, plate, 45 degrees": made(SPHERE, "plate", "circle", (30, 32), lattice("strips", rotation_deg=31.0), render=SCHLICK),
    "slanted strips, panel facing, stop, oblique": made({**TURNED, "stop_radius_mm": 1.6}, view=OBLIQUE, array=LEAN),
    "slanted strips, asphere, 30 degrees": made(ASPHERE, view=(30,), array=LEAN, render=EXACT),
    "strips of conics, clear, oblique": made(CONICS, "clear", view=OBLIQUE, array=LEAN),
    "slanted ideal strips, cell, oblique, gap": made(IDEAL, "opaque", "cell", OBLIQUE, {**LEAN, **BEHIND}),
    "ideal strips, slanted to the left, 30 degrees": made(IDEAL, view=(30,), array=LEAN_LEFT),
    "layer under lenses in air, 15 degrees": made(SPHERE, view=(15,), panel=layers(GLASS), render=EXACT),
    "three layers, clear, oblique": made(SPHERE, "clear", view=OBLIQUE, panel=layers(GLASS, ADHESIVE, DENSE), render=EXACT),
    "glued onto a layer, opaque, 30 degrees": made(SPHERE_TALL, view=(30,), panel=layers(THICK), array=on_top(THICK), render=EXACT),
    "glued onto two layers, clear, 45 degrees": made(SPHERE_TALL, "clear", view=(30, 32), panel=layers(THICK, ADHESIVE), array=on_top(THICK, ADHESIVE), render=EXACT),
    "glued onto a layer of its own index, plate, oblique": made(SPHERE, "plate", view=OBLIQUE, panel=layers(THICK, FILM), array=on_top(THICK, FILM), render=EXACT),
    "glued onto the bare panel, no layer, opaque, 30 degrees": made({**SPHERE, "cylinder_height_mm": 6.0}, view=(30,), array={"base_z_mm": 0.0}, render=EXACT),
    "glued onto the bare panel, no layer, clear, oblique": made(SPHERE_TALL, "clear", view=OBLIQUE, array={"base_z_mm": 0.0}, render=EXACT),
    "glued onto the bare panel, no layer, plate cell, 20 degrees": made(ROUNDER, "plate", "cell", (20,), {"base_z_mm": 0.0}, render=SCHLICK),
    "layer under a touching curved lens, plate": made(TURNED, "plate", view=(15,), panel=layers(GLASS), array=on_top(GLASS), render=EXACT),
    "layers under an ideal lens, emission 2, gap": made(IDEAL, view=OBLIQUE, panel={**layers(GLASS, ADHESIVE), "emission_exponent": 2.0}, array=AHEAD, render=EXACT),
    "pinhole, square lattice, 15 degrees": made(PINHOLE, view=(15,)),
    "pinhole, hexagon lattice, layer, oblique": made(PINHOLE, view=OBLIQUE, array=HEXAGON, panel=layers(GLASS), render=EXACT),
    "pinhole slits, slanted strips, layers, 58 degrees": made(PINHOLE, view=STEEP, array={**LEAN, **BEHIND}, panel=layers(GLASS, DENSE), render=EXACT),
    "hexagon lattice, glued onto layers, clear cell, oblique": made({**ROUNDER, "cylinder_height_mm": 2.0}, "clear", "cell", OBLIQUE,
        {**HEXAGON, **on_top(DENSE, THICK)}, panel=layers(DENSE, THICK), render=EXACT),
    "brick lattice, glued onto a layer, plate cell, rotated": made(REACHING, "plate", "cell", (20, 15), {**BRICK_WIDE, **TILTED, **on_top(THICK)},
        panel=layers(THICK), render=EXACT),
    "slanted strips glued onto layers, plate, 45 degrees": made(SPHERE_TALL, "plate", "circle", (30, 32), {**LEAN, **on_top(THICK, ADHESIVE)},
        panel=layers(THICK, ADHESIVE), render=EXACT),
    "slanted strips glued onto a layer, opaque cell, oblique": made({**ROUNDER, "cylinder_height_mm": 5.0}, "opaque", "cell", OBLIQUE, {**LEAN, **on_top(GLASS)},
        panel=layers(GLASS), render=EXACT),
    "strips over a layer, camera close by": made(SPHERE, "clear", array=LEAN, panel=layers(GLASS), render=EXACT, **NEAR),
    "hexagon lattice of two spaced elements, stop, oblique": made({**SPACED, "stop_radius_mm": 2.5}, view=OBLIQUE, array=HEXAGON, render=EXACT),
}

# Asked where there is time.
MORE = {
    "hexagon lattice, opaque circle, 58 degrees": made(SPHERE, view=STEEP, array=HEXAGON, render=EXACT),
    "hexagon lattice, opaque cell, panel facing, oblique": made({**ROUNDER, **FACING}, "opaque", "cell", OBLIQUE, HEXAGON),
    "hexagon lattice, opaque cell, 45 degrees, past the border": made(ROUNDER, "opaque", "cell", (30, 32), HEXAGONS_FEW, **PAST_BORDER),
    "hexagon lattice, opaque cell, stop, 30 degrees": made({**ROUNDER, "stop_radius_mm": 2.8}, "opaque", "cell", (30,), HEXAGON, render=EXACT),
    "hexagon lattice upright, clear circle, oblique": made(SPHERE, "clear", "circle", OBLIQUE, {**HEXAGON, "rotation_deg": 90.0}, render=EXACT),
    "hexagon lattice, clear cell, panel facing, 45 degrees": made({**ROUNDER, **FACING}, "clear", "cell", (30, 32), HEXAGON),
    "hexagon lattice, clear cell, stop, 15 degrees": made({**ROUNDER, "stop_radius_mm": 2.4}, "clear", "cell", (15,), HEXAGON),
    "hexagon lattice, clear cell of 4 x 3, past the border": made(ROUNDER, "clear", "cell", (30, 20), HEXAGONS_FEW, render=EXACT, **PAST_BORDER),
    "hexagon lattice, plate circle, oblique": made(SPHERE, "plate", "circle", OBLIQUE, HEXAGON, render=EXACT),
    "hexagon lattice, plate cell, panel facing, past the border": made({**ROUNDER, **FACING}, "plate", "cell", (45,), HEXAGONS_FEW, **PAST_BORDER),
    "hexagon lattice, asphere, plate cell, oblique": made(ASPHERE_CELL, "plate", "cell", OBLIQUE, HEXAGON, render=EXACT),
    "hexagon lattice, hollow lens, clear, oblique": made(HOLLOW, "clear", view=OBLIQUE, array=HEXAGON),
    "hexagon lattice, meniscus, 30 degrees": made(MENISCUS, view=(30,), array=HEXAGON, render=EXACT),
    "hexagon lattice, cemented doublet, rotated": made(CEMENTED, view=(15,), array={**HEXAGON, **TILTED}, render=EXACT),
    "hexagon lattice, a circle that leaves corners out, 30 degrees": made(SMALL_CIRCLE, "opaque", "cell", (30,), HEXAGON, render=EXACT),
    "hexagon lattice, one lens": made(SPHERE, "clear", "circle", (15,), {**HEXAGON, "count": [1, 1]}, camera={"frame_width_mm": 14.0}),
    "hexagon lattice, ideal circle, rotated, oblique": made(IDEAL, view=OBLIQUE, array={**HEXAGON, **TILTED}),
    "hexagon lattice, ideal cell, 58 degrees": made(IDEAL, "opaque", "cell", STEEP, HEXAGON),
    "hexagon lattice, tall walls, opaque, 45 degrees": made({**SPHERE, "cylinder_height_mm": 4.0}, view=(30, 32), array={**HEXAGON, "base_z_mm": 6.0}),
    "a million lenses, hexagon lattice, oblique": case({"type": "plano_convex", "sphere_radius_mm": 0.066, "aperture_radius_mm": 0.05, "cylinder_height_mm": 0.03, "index": 1.49},
        view=OBLIQUE, array={**HEXAGON, "count": [1000, 1155], "pitch_mm": 0.108, "base_z_mm": 0.1}, panel={"pixels": [3840, 3600], "pixel_pitch_mm": 0.03}, camera={"frame_width_mm": 9.0}),
    "brick lattice, opaque circle, rotated and offset, 30 degrees": made(SPHERE, view=(30,), array={**BRICK, **TILTED}, render=EXACT),
    "brick lattice, opaque cell, panel facing, oblique": made({**ROUNDER, **FACING}, "opaque", "cell", OBLIQUE, BRICK),
    "brick lattice, opaque cell, 58 degrees": made(ROUNDER, "opaque", "cell", STEEP, BRICK, render=EXACT),
    "brick lattice, wide cells, opaque, stop over the borders": made({**REACHING, "stop_radius_mm": 3.5}, "opaque", "cell", (0, 25), BRICK_WIDE),
    "brick lattice, odd rows of 3 x 3, clear cell, past the border": made(ROUNDER, "clear", "cell", (30, 20), lattice("brick", count=[3, 3]), render=EXACT,
        **PAST_BORDER),
    "brick lattice, clear circle, tall, 45 degrees": made({**SPHERE, "aperture_radius_mm": 3.45}, "clear", "circle", (30, 32), BRICK_TALL),
    "brick lattice, clear cell, panel facing, 15 degrees": made({**ROUNDER, **FACING}, "clear", "cell", (15,), BRICK, render=SCHLICK),
    "brick lattice, plate cell of 3 x 2, 45 degrees, past the border": made(ROUNDER, "plate", "cell", (45,), lattice("brick", count=[3, 2]), **PAST_BORDER),
    "brick lattice, plate cell, 58 degrees up": made(FLATTER, "plate", "cell", (10, 57), BRICK, render=EXACT),
    "brick lattice, biconvex plate cell, oblique": made(BICONVEX_CELL, "plate", "cell", OBLIQUE, BRICK, render=EXACT),
    "brick lattice, asphere, plate cell, stop": made({**ASPHERE_CELL, "stop_radius_mm": 3.0}, "plate", "cell", (15,), BRICK),
    "brick lattice, ideal circle, gap behind": made(IDEAL, view=OBLIQUE, array={**BRICK, **BEHIND}),
    "brick lattice, conics, 30 degrees": made(CONICS, view=(30,), array=BRICK, render=EXACT),
    "rectangle lattice counted, clear cell, oblique": made(REACHING, "clear", "cell", OBLIQUE, lattice("rectangle", [10.4, 7.2])),
    "upright strips, opaque cell, 45 degrees, past the border": made(ROUNDER, "opaque", "cell", (45,), lattice("strips", count=[5, 1]), **PAST_BORDER),
    "upright strips, clear, 30 degrees": made(SPHERE, "clear", view=(30,), array=STRIPS, render=EXACT),
    "strips across the panel, clear, oblique": made(SPHERE, "clear", view=OBLIQUE, array=lattice("strips", rotation_deg=90.0)),
    "slanted strips, clear, stop, 15 degrees": made({**SPHERE, "stop_radius_mm": 2.2}, "clear", view=(15,), array=LEAN),
    "slanted strips, clear cell, panel facing, oblique": made({**ROUNDER, **FACING}, "clear", "cell", OBLIQUE, LEAN, render=EXACT),
    "strips slanted to the left, clear cell, 45 degrees": made(ROUNDER, "clear", "cell", (30, 32), LEAN_LEFT, render=SCHLICK),
    "slanted strips of five, clear, past the border": made(SPHERE, "clear", "circle", (30, 20), lattice("strips", slant=9.46, count=[5, 1]), **PAST_BORDER),
    "slanted strips, clear, 75 degrees": made(SPHERE, "clear", "circle", (75,), LEAN, camera={"frame_width_mm": 60.0}),
    "slanted strips, plate, oblique": made(SPHERE, "plate", view=OBLIQUE, array=LEAN, render=EXACT),
    "slanted strips, plate cell of four, past the border": made(ROUNDER, "plate", "cell", (45,), lattice("strips", slant=9.46, count=[4, 1]), **PAST_BORDER),
    "slanted strips, plate, panel facing, 15 degrees": made(TURNED, "plate", view=(15,), array=LEAN, render=EXACT),
    "strips of aspheres, plate, 30 degrees": made(ASPHERE, "plate", view=(30,), array=LEAN_LEFT),
    "strips of hollow lenses, clear, 15 degrees": made(HOLLOW, "clear", view=(15,), array=LEAN, render=EXACT),
    "strips of menisci, oblique": made(MENISCUS, view=OBLIQUE, array=LEAN),
    "strips of cemented doublets, 30 degrees": made(CEMENTED, view=(30,), array=LEAN_LEFT, render=EXACT),
    "strips of two spaced elements, stop, oblique": made({**SPACED, "stop_radius_mm": 2.5}, view=OBLIQUE, array=LEAN, render=EXACT),
    "half round strips, clear, oblique": made({**SPHERE, "sphere_radius_mm": 3.9, "cylinder_height_mm": 0.0}, "clear", view=OBLIQUE, array={**LEAN, "base_z_mm": 2.0}),
    "strips with tall walls, opaque, 58 degrees": made({**SPHERE, "cylinder_height_mm": 4.0}, view=STEEP, array={**LEAN, "base_z_mm": 6.0}),
    "ideal strips, slant 60 degrees, stop": made({**IDEAL, "stop_radius_mm": 1.5}, view=OBLIQUE, array=lattice("strips", slant=60.0)),
    "ideal strips, 58 degrees, gap ahead": made(IDEAL, "opaque", "cell", STEEP, {**LEAN, **AHEAD}),
    "layer under lenses in air, panel facing, 45 degrees": made(TURNED, view=(30, 32), panel=layers(GLASS), render=EXACT),
    "layer under lenses in air, gap, oblique": made(SPHERE, view=OBLIQUE, panel=layers(GLASS, DENSE), array=AHEAD, render=EXACT),
    "three layers under a plate, 58 degrees": made(SPHERE, "plate", view=STEEP, panel=layers(DENSE, ADHESIVE, GLASS), render=EXACT),
    "layer as thick as the gap allows, clear, 15 degrees": made(SPHERE, "clear", view=(15,), panel=layers({"thickness_mm": 8.9, "index": 1.6}), render=EXACT),
    "glued onto a rarer layer, clear, 58 degrees": made({**SPHERE_TALL, "index": 1.8}, "clear", view=STEEP,
        panel=layers(GLASS, RARE), array=on_top(GLASS, RARE), render=EXACT),
    "glued onto a rarer layer, plate, 58 degrees": made({**SPHERE, "index": 1.8}, "plate", view=STEEP, panel=layers(RARE), array=on_top(RARE), render=EXACT),
    "glued onto a rarer layer, opaque, 58 degrees": made({**SPHERE_LOW, "index": 1.8}, view=STEEP, panel=layers(RARE), array=on_top(RARE), render=EXACT),
    "glued over a rarer layer of the panel, opaque cell, 58 degrees": made({**ROUNDER, "index": 1.74}, "opaque", "cell", STEEP, on_top(RARE, DENSE),
        panel=layers(RARE, DENSE), render=EXACT),
    "glued onto a layer, clear cell, 15 degrees": made({**ROUNDER, "cylinder_height_mm": 2.0}, "clear", "cell", (15,), {"base_z_mm": 1.9},
        panel=layers(GLASS), render=SCHLICK),
    "glued onto three layers, plate cell, past the border": made(ROUNDER, "plate", "cell", (30, 30), {"count": [4, 3], **on_top(THICK, FILM, ADHESIVE)},
        panel=layers(THICK, FILM, ADHESIVE), render=EXACT, **PAST_BORDER),
    "glued asphere on a layer, 30 degrees": made(ASPHERE, view=(30,), panel=layers(THICK), array=on_top(THICK), render=EXACT),
    "glued cemented lens with a flat back on a layer, oblique": made(surfaces(surface(0.0, 3.8, 1.5, 1.62), surface(0.12, 3.8, 3.2, 1.49), surface(-0.12, 3.8)), view=OBLIQUE,
        panel=layers(GLASS), array=on_top(GLASS), render=EXACT),
    "glued onto a layer, stop, clear, oblique": made({**SPHERE_TALL, "stop_radius_mm": 2.2}, "clear", view=OBLIQUE,
        panel=layers(THICK), array=on_top(THICK), render=EXACT),
    "glued flat back of conics on a layer, clear, 45 degrees": made(FLAT_BACK, "clear", view=(30, 32), panel=layers(GLASS), array=on_top(GLASS), render=EXACT),
    "layer just under a flat face that is not glued, 30 degrees": made(SPHERE, "clear", view=(30,), panel=layers(GLASS), array={"base_z_mm": 1.905}, render=EXACT),
    "layers and emission 3, sRGB panel": made(SPHERE, view=(30,), panel={**layers(GLASS, DENSE), "emission_exponent": 3.0, "encoding": "srgb"}, render=EXACT),
    "glued onto the bare panel, no layer, emission 2": made({**SPHERE, "cylinder_height_mm": 6.0}, view=(15,), panel={"emission_exponent": 2.0},
        array={"base_z_mm": 0.0}, render=EXACT),
    "layers under an ideal cell, 58 degrees": made(IDEAL, "opaque", "cell", STEEP, panel=layers(DENSE, GLASS), render=SCHLICK),
    "pinhole array of 3 x 2, past the border": made(PINHOLE, view=(30, 20), array={"count": [3, 2]}, camera={"frame_width_mm": 40.0}),
    "pinhole, wide rectangle lattice, 30 degrees": made(PINHOLE, view=(30,), array=lattice("rectangle", [10.4, 7.2])),
    "pinhole, brick lattice, three layers, gap": made(PINHOLE, view=OBLIQUE, array={**BRICK_WIDE, **AHEAD}, panel=layers(GLASS, ADHESIVE, DENSE), render=EXACT),
    "pinhole as wide as its cell, hexagon lattice, 58 degrees": made(FULL_PINHOLE, view=STEEP, array={**HEXAGON, **TILTED}),
    "pinhole on a layer, emission 1": made(PINHOLE, view=(45,), array=on_top(THICK), panel={**layers(THICK), "emission_exponent": 1.0}, render=EXACT),
    "pinhole slits, upright strips, 45 degrees": made(PINHOLE, view=(45,), array=STRIPS),
    "pinhole slits, strips slanted to the left, gap": made(PINHOLE, view=OBLIQUE, array={**LEAN_LEFT, **AHEAD}),
    "hexagon lattice over layers, opaque cell, 45 degrees": made(ROUNDER, "opaque", "cell", (30, 32), HEXAGON, panel=layers(GLASS, ADHESIVE), render=EXACT),
    "hexagon lattice, glued onto a layer, plate cell, oblique": made(ROUNDER, "plate", "cell", OBLIQUE, {**HEXAGON, **on_top(THICK)}, panel=layers(THICK), render=EXACT),
    "brick lattice, glued onto layers, clear cell, 30 degrees": made({**ROUNDER, "cylinder_height_mm": 2.0}, "clear", "cell", (30,),
        {**BRICK, **on_top(GLASS, DENSE)}, panel=layers(GLASS, DENSE), render=EXACT),
    "slanted strips glued onto a rarer layer, clear, 58 degrees": made({**SPHERE_TALL, "index": 1.8}, "clear", view=STEEP, array={**LEAN, **on_top(RARE)},
        panel=layers(RARE), render=EXACT),
    "slanted strips glued onto the bare panel, no layer, plate cell": made(ROUNDER, "plate", "cell", (20, 15), {**LEAN, "base_z_mm": 0.0}, render=EXACT),
    "slanted strips over two layers, ideal, oblique": made(IDEAL, view=OBLIQUE, array=LEAN_LEFT, panel=layers(GLASS, ADHESIVE), render=EXACT),
    "strips glued onto a layer, slant 60 degrees, plate": made(SPHERE, "plate", view=(15, 15), array={**lattice("strips", slant=60.0), **on_top(THICK)},
        panel=layers(THICK), render=SCHLICK),
}
