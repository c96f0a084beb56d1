#!/usr/bin/python3
"""`lfdsim export` as a user runs it: what lies in the folder, scripts that are Python, displays that are the same, clear errors."""
import ast
import json
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from program import TINY, Checks, Program  # noqa: E402

program, checks = Program(), Checks()
BARE = "--set diffuser=none"


def read_ply(path):
    """Counts of the head and the data behind it, which must fit."""
    head, data = path.read_bytes().split(b"end_header\n", 1)
    vertices, faces = (int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element"))
    checks.that(len(data) == 24 * vertices + 13 * faces, f"{path}: {len(data)} bytes")
    numbers = np.frombuffer(data, "<f4", 6 * vertices)
    corners = np.frombuffer(data, np.dtype([("three", "u1"), ("v", "<i4", 3)]), faces, 24 * vertices)
    checks.that(np.isfinite(numbers).all() and (corners["three"] == 3).all() and corners["v"].max() < vertices, f"{path}: numbers")


for peer, panel, scene in (("pov", "panel.png", "scene.pov"), ("cycles", "panel.exr", "scene.py"), ("mitsuba", "panel.exr", "scene.py")):
    folder = program.folder / "a scene's \"folder\""
    command = ["export", peer, "tiny.toml", "--panel-image", "panel.png", *BARE.split(), "--triangles", "500", "--normals", "smooth", "-o", folder.name, "--json"]
    told = json.loads(program.must(command))
    checks.that({panel, scene, "display.toml", "README.txt"} <= set(told["files"]), f"{peer}: {told['files']}")
    checks.that({p.name for p in folder.iterdir()} == set(told["files"]), f"{peer}: the folder holds {sorted(p.name for p in folder.iterdir())}")
    text, readme = (folder / scene).read_text(), (folder / "README.txt").read_text()
    for deviation in told["deviations"]:
        checks.that(deviation in readme and deviation in text, f"{peer}: {deviation!r} is not told")
    checks.that(told["command"] in readme and told["lfdsim"] in readme, f"{peer}: README.txt does not name the commands")
    if scene.endswith(".py"):
        ast.parse(text)
        for path in folder.glob("*.ply"):
            read_ply(path)
            checks.that(f'"{path.name}"' in text, f"{path.name} is not used")

    # The display that the scene shows, of the same panel image: lfdsim's picture, but for the panel image's sixteen bits.
    program.must(["render", f"{folder.name}/display.toml", "--panel-image", f"{folder.name}/{panel}", "-o", "shown.npy"])
    fresnel = ["--set", "render.fresnel=\"exact\""]
    program.must(["render", "tiny.toml", "--panel-image", "panel.png", *BARE.split(), *fresnel, "--estimator", "point", "-o", "given.npy"])
    worst = np.abs(np.load(program.folder / "shown.npy") - np.load(program.folder / "given.npy")).max()
    checks.that(worst <= (1e-5 if panel.endswith("png") else 0), f"{peer}: the display in the folder differs by {worst}")
    for path in folder.iterdir():
        path.unlink()
    folder.rmdir()

# Errors of single lenses go along as a table, drawn ones in it.
DRAWN = "errors.decenter_sd_mm=0.02 errors.curvature_sd=0.01 errors.seed=7"
program.must("errors tiny.toml --set errors.tilt_sd_deg=0.1 -o tilts.csv")
wrong = f"{BARE} {DRAWN} errors.table=\"{program.folder / 'tilts.csv'}\" render.fresnel=\"exact\""
told = json.loads(program.must(f"export pov tiny.toml --panel-image panel.png {wrong} -o wrong --json"))
checks.that("lenses.csv" in told["files"] and (program.folder / "wrong/lenses.csv").exists(), f"errors: {told['files']}")
program.must("render wrong/display.toml --panel-image wrong/panel.png -o shown.npy")
program.must(f"render tiny.toml --panel-image panel.png {wrong} --estimator point -o given.npy")
worst = np.abs(np.load(program.folder / "shown.npy") - np.load(program.folder / "given.npy")).max()
checks.that(worst <= 1e-5, f"errors: the display in the folder differs by {worst}")

# A name that would be code, if it could.
(program.folder / "evil.toml").write_text(TINY.replace('"tiny"', '"a\\n*/ import os; #declare\\u2028 \\"\\"\\" \\u001b"'))
for peer in ("pov", "cycles", "mitsuba"):
    program.must(f"export {peer} evil.toml --pattern white {BARE} -o evil-{peer}")
    scene = next(p for p in (program.folder / f"evil-{peer}").iterdir() if p.name.startswith("scene")).read_text()
    checks.that(scene.count("#declare?") == 1 and scene.splitlines()[0].startswith(("//", "#")), f"{peer}: the name gets out")

for name, arguments, *words in [
    ("unknown renderer", "export lux tiny.toml --pattern white -o out", "PEER", "pov, cycles, mitsuba"),
    ("diffuser for POV-Ray", "export pov tiny.toml --pattern white -o out", "diffuser: ", "--set diffuser=none"),
    ("few triangles", f"export pov tiny.toml --pattern white {BARE} --triangles 12 -o out", "--triangles"),
    ("many triangles", f"export cycles tiny.toml --pattern white {BARE} --triangles 1e9 -o out", "--triangles"),
    ("no number", f"export cycles tiny.toml --pattern white {BARE} --triangles many -o out", "--triangles"),
    ("normals of nothing", f"export pov tiny.toml --pattern white {BARE} --normals smooth -o out", "--normals", "--triangles N"),
    ("unknown normals", f"export cycles tiny.toml --pattern white {BARE} --normals bumpy -o out", "--normals"),
    ("ideal lenses", f"export mitsuba tiny.toml --pattern white {BARE} --set lens.type=\"ideal\" lens.focal_length_mm=5 lens.sphere_radius_mm=none "
                     "lens.cylinder_height_mm=none lens.index=none -o out", "lens.type", "a real lens"),
    ("dispersing glass", f"export pov tiny.toml --pattern white {BARE} --set lens.index=none lens.glass=PMMA -o out", "panel.wavelengths_nm", "--channel r, g or b"),
    ("errors of single lenses for Cycles", f"export cycles tiny.toml --pattern white {BARE} errors.decenter_sd_mm=0.01 -o out", "errors", "wedge_deg", "export pov"),
    ("errors of single lenses as triangles", f"export pov tiny.toml --pattern white {BARE} errors.bow_mm=0.01 --triangles 500 -o out", "--triangles", "leave it out"),
    ("unknown channel", f"export pov tiny.toml --pattern white {BARE} --channel x -o out", "--channel", "r, g, b"),
    ("pupil", f"export cycles tiny.toml --pattern white {BARE} --set camera.pupil_diameter_mm=3 -o out", "camera.pupil_diameter_mm=none"),
    ("two contents", f"export pov tiny.toml --pattern white --panel-image panel.png {BARE} -o out", "give one of them"),
    ("wrong panel image", f"export pov tiny.toml --panel-image tiny.toml {BARE} -o out", "tiny.toml"),
    ("a file for a folder", f"export pov tiny.toml --pattern white {BARE} -o panel.png", "is not a folder"),
    ("empty folder", ["export", "pov", "tiny.toml", "--pattern", "white", "--set", "diffuser=none", "-o", ""], "--output", "empty"),
    ("all at once", "export lux tiny.toml --pattern whit --triangles x -o panel.png", "PEER", "--pattern", "--triangles", "is not a folder"),
]:
    checks.refused(program, name, arguments, *words)
checks.refused(program, "a folder that cannot be made", ["export", "pov", "tiny.toml", "--pattern", "white", "--set", "diffuser=none", "-o", "/proc/none/scene"], "/proc/none/scene")
checks.finish()
