"""`lfdsim import` as a user runs it: lenses that check calls valid, glasses, catalogues, calibrations, files that are kept, clear errors."""
import json
import math
import pathlib

import numpy
from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder


def zmx(surfaces, head="UNIT MM\nENPD 10\nFTYP 0\nYFLN 0 3\n"):
    """Surfaces as (curvature, distance, further lines...), between an object at infinity and an image."""
    text = head + "SURF 0\n  CURV 0\n  DISZ INFINITY\n"
    for i, (curvature, distance, *lines) in enumerate(surfaces, 1):
        text += f"SURF {i}\n  CURV {curvature}\n  DISZ {distance}\n" + "".join(f"  {line}\n" for line in lines)
    return text + f"SURF {len(surfaces) + 1}\n  CURV 0\n  DISZ 0\n"


# An achromat of Thorlabs's catalogue, AC254-100-A: focal length 100.1 mm.
DOUBLET = zmx([(1 / 62.8, 4, "STOP", "GLAS N-BK7 0 0 1.5 4.0E+1"), (-1 / 45.7, 2.5, "GLAS MYSF5 0 0 1.5 4.0E+1"), (-1 / 128.2, 97.1)])
CATALOGUE = "CC a test\nNM MYSF5 2 0 1.6727 32.21 0 0\nCD 1.52481889 0.011254756 0.187085527 0.0588995392 1.42729015 129.141675\nLD 0.37 2.5\n"
(folder / "doublet.zmx").write_text(DOUBLET)
(folder / "doublet16.zmx").write_text("VERS 1\n" + DOUBLET, encoding="utf-16")
(folder / "glass").mkdir()
(folder / "glass" / "my.agf").write_text(CATALOGUE)

RUNS = {  # options, focal length in green light, focal length / gap
    "named": ("doublet.zmx --glass MYSF5=SF5", 100.1),
    "model": ("doublet.zmx --glass MYSF5=1.6727,32.21", 100.1),
    "catalogue": ("doublet.zmx --catalogue glass/my.agf", 100.1),
    "utf16": ("doublet16.zmx --glass mysf5=SF5", 100.1),
    "small": ("doublet.zmx --glass MYSF5=SF5 --scale 0.05", 5.005),
    "flipped": ("doublet.zmx --glass MYSF5=SF5 --scale 0.05 --flip", 5.005),
    "near-eye": ("doublet.zmx --glass MYSF5=SF5 --scale 0.05 --panel-inch 0.7 --pixels 1920x1080 --distance-mm 30", 5.005),
}
for name, (options, focal_length) in RUNS.items():
    said = program.must(f"import {options} -o {name}.toml")
    checks.that(f"lfdsim check {name}.toml" in said and "absorbs" in said, f"{name}: said {said!r}")
    text = (folder / f"{name}.toml").read_text()
    checks.that(f"lfdsim import {options}" in text.replace("\n# ", " "), f"{name}: does not say how it was made")
    checks.that("surface 2" in text, f"{name}: does not say which surface is which")
    checked = json.loads(program.must(f"check {name}.toml --json"))
    theory, display = checked["theory"], checked["display"]
    checks.that(abs(theory["focal_length_mm"] / focal_length - 1) < 2e-3, f"{name}: focal length {theory['focal_length_mm']}")
    checks.that(abs(theory["gap_mm"] / focal_length - 1) < 4e-3, f"{name}: gap {theory['gap_mm']}")
    checks.that(display["name"] == name, f"{name}: is called {display['name']}")
checks.that('glass_catalogues = ["glass/my.agf"]' in (folder / "catalogue.toml").read_text(), "the catalogue is not named")
program.must("import doublet.zmx --catalogue glass/my.agf -o glass/elsewhere.toml")
checks.that('glass_catalogues = ["my.agf"]' in (folder / "glass" / "elsewhere.toml").read_text(), "the catalogue is not named from there")
program.must("check glass/elsewhere.toml")
(folder / "glass" / "other.agf").write_text(CATALOGUE.replace("MYSF5", "OTHER"))
program.must("import doublet.zmx --catalogue glass/other.agf glass/my.agf --glass N-BK7=OTHER MYSF5=OTHER -o both.toml")
program.must("import --catalogue glass/other.agf glass/my.agf doublet.zmx -o first.toml")

# A glass of the user's catalogue that cannot be used is not replaced by the one of that name that ships; the reason is told.
BROKEN = CATALOGUE.replace("LD 0.37 2.5\n", "") + CATALOGUE.replace("MYSF5", "OTHER")
for own, named in (("MYSF5", "MYSF5"), ("n-bk7", "N-BK7")):
    (folder / "glass" / "broken.agf").write_text(BROKEN.replace("MYSF5", own))
    checks.refused(program, f"a broken {own}", "import doublet.zmx --catalogue glass/broken.agf -o x.toml", f"broken.agf:2: {own} is left out: it has no line LD")
    checks.refused(program, f"a display with a broken {own}", f"check named.toml --set glass_catalogues=[\"glass/broken.agf\"] --set lens.surface.1.glass={named}",
                   f"broken.agf:2: {own} is left out: it has no line LD")

# ray-optics: of several apertures the smallest counts, as a ray must pass all; polynomials without coefficients are refused.
roa = json.loads((pathlib.Path(__file__).resolve().parents[2] / "fuzz/corpus/rayoptics/doublet.roa").read_text())


def of_class(json_value, name):
    """All objects of a class within a value, in their order."""
    if isinstance(json_value, dict):
        if name in json_value.get("__instance_type__", []):
            yield json_value["attributes"]
        json_value = list(json_value.values())
    if isinstance(json_value, list):
        for inner in json_value:
            yield from of_class(inner, name)


surface = list(of_class(roa, "Surface"))[1]
surface["clear_apertures"] = [{"__instance_type__": ["rayoptics.elem.surface", "Circular"], "attributes": {"radius": radius, "is_obscuration": False}} for radius in (9, 5, 11)]
(folder / "apertures.roa").write_text(json.dumps(roa))
program.must("import apertures.roa -o apertures.toml")
semi = [surface["semi_aperture_mm"] for surface in json.loads(program.must("check apertures.toml --json"))["display"]["lens"]["surface"]]
checks.that(5 in semi and 9 not in semi and 11 not in semi, f"apertures of 9, 5 and 11 mm: {semi}")
polynomial = next(of_class(roa, "EvenPolynomial"))
for coefs in (None, "none", [0] * 101):
    polynomial["coefs"] = coefs
    (folder / "bare.roa").write_text(json.dumps(roa))
    checks.refused(program, f"a polynomial of {coefs!r:.20}", "import bare.roa -o x.toml", "coefs: are no list of up to 100 coefficients")

# A picture through a lens whose stop stands between its glasses.
TRIPLET = zmx([(1 / 22.01359, 3.25896, "GLAS N-SK16"), (-1 / 435.76044, 6.00755), (-1 / 22.21328, 0.99997, "GLAS F2"), (1 / 20.29192, 4.75041),
               (0, 0, "STOP"), (1 / 79.6836, 2.95208, "GLAS N-SK16"), (-1 / 18.39533, 42.20778)])
(folder / "triplet.zmx").write_text(TRIPLET)
said = program.must("import triplet.zmx --scale 0.05 -o triplet.toml")
checks.that("7 surfaces" in said, f"triplet: said {said!r}")
checks.that("Assumed: a panel of 24 inches with 3840 x 2160 pixels, an eye at 600 mm, a pitch as wide as the lens" in said, f"said {said!r}")
program.must("render triplet.toml --model built-in:spheres --size 96x54 --samples 4 -o triplet.png")

# A calibrated display. Its panel shows light only where the published formula puts some of the views, and only an eye there sees it.
UNIT = {"serial": "INVENTED-4", "pitch": 47.1, "slope": -6.2, "center": 0.37, "DPI": 300, "screenW": 480, "screenH": 360, "viewCone": 40}
(folder / "visual.json").write_text(json.dumps({key: value if key == "serial" else {"value": value} for key, value in UNIT.items()}))
said = program.must("import visual.json --distance-mm 400 -o unit.toml")
checks.that("slant 9.162 degrees" in said and "lfdsim eia unit.toml" in said and "Assumed: cylindrical" in said, f"unit: said {said!r}")
checks.that(json.loads(program.must("check unit.toml --json"))["display"]["name"] == "INVENTED-4", "the serial is lost")
program.must("eia unit.toml -o unit-eia.png")
W, H, slope = UNIT["screenW"], UNIT["screenH"], UNIT["slope"]
column, row, channel = numpy.meshgrid(numpy.arange(W), numpy.arange(H)[::-1], numpy.arange(3), indexing="xy")
cycles = UNIT["pitch"] * W / UNIT["DPI"] * math.cos(math.atan(1 / slope))
phase = ((column + 0.5) / W + channel / (3 * W) + (row + 0.5) / H * H / (W * slope)) * cycles - UNIT["center"]
views = 1 - (phase - numpy.floor(phase))  # 0 to 1 from the viewer's left to the right
for name, glass in [("unit", ""), ("sheet", " --index 1.9")]:
    program.must(f"import visual.json --distance-mm 400{glass} -o {name}.toml --force")
    for shown in (0.2, 0.5, 0.8):
        numpy.save(folder / "shown.npy", (abs(views - shown) < 0.12).astype(numpy.float32))
        for seen in (0.2, 0.5, 0.8):
            x = 2 * math.tan(math.radians(UNIT["viewCone"] / 2)) * (seen - 0.5) * 400
            program.must(f"render {name}.toml --panel-image shown.npy --camera-mm {x},0,400 --size 96x72 -o seen.npy")
            light = numpy.load(folder / "seen.npy")[8:-8, 8:-8].mean()
            checks.that(0.9 < light < 1.1 if shown == seen else light < 0.02, f"{name}: of view {shown} an eye at {seen} sees {light:.3f}")

# Two calibrations that differ in any value are not taken for one.
unit = json.loads((folder / "visual.json").read_text())
for change in ({"flipImageX": {"value": 1}}, {"flipSubp": {"value": 1}}, {"serial": "OTHER"}, {"center": {"value": 0.123}}):
    (folder / "two.json").write_text(json.dumps([unit, {**unit, **change}]))
    checks.refused(program, f"two calibrations, {change}", "import two.json --distance-mm 400 -o x.toml", "two.json: contains 2 calibrations")

# ... and a flag that is missing is one that is not set.
(folder / "two.json").write_text(json.dumps([unit, {**unit, "flipImageX": 0, "flipSubp": {"value": False}}]))
program.must("import two.json --distance-mm 400 -o alike.toml")

# A calibration is found where services put it, and nothing is blamed on the display that it is of: it is focused on its panel.
(folder / "service.json").write_text(json.dumps({"error": 0, "devices": [{"hwid": "X", "calibration": json.loads((folder / "visual.json").read_text())}]}))
for options in ("", "--index 1.9", "--index 1.6"):
    said = program.must(f"import service.json --distance-mm 400 {options} -o service.toml --force")
    checks.that("is under devices[0].calibration" in said, f"service: said {said!r}")
    checked = json.loads(program.must("check service.toml --json"))
    checks.that(checked["warnings"] == [], f"check of an imported display warns: {checked['warnings']}")
    checks.that(checked["display"]["content"]["view_cone_deg"] == 40, "the view cone is lost")
    if options == "--index 1.9":
        same = [(folder / f"{name}.toml").read_text().split("[panel]")[1] for name in ("service", "sheet")]
        checks.that(same[0] == same[1], "the wrapped calibration makes another display")

# Nothing of this machine is in a description: the program's folder, the file's, the description's.
for arguments in (f"import {folder}/visual.json --distance-mm 400 -o {folder}/moved.toml", f"import {folder}/doublet.zmx --glass MYSF5=SF5 -o {folder}/moved2.toml",
                  f"new --panel-inch 8 --pixels 2560x1600 --distance-mm 500 -o {folder}/moved3.toml"):
    program.must(arguments)
    text = (folder / arguments.split()[-1]).read_text()
    checks.that(str(folder) not in text and program.path not in text.replace("\n# ", " "), f"{arguments}: an absolute path in {text[:300]!r}")

# A lens that diverges is said to, whether it can stand there or not.
DIVERGING = zmx([(-1 / 50, 2, "STOP", "GLAS N-BK7"), (1 / 50, 40)])
(folder / "diverging.zmx").write_text(DIVERGING)
(folder / "virtual.zmx").write_text(DIVERGING.replace("DISZ 40", "DISZ -48"))
for arguments in ("diverging.zmx", "virtual.zmx --gap-mm 20", "diverging.zmx --flip --gap-mm 20"):
    said = program.must(f"import {arguments} -o diverging.toml --force")
    checks.that("The lens diverges (focal length -4" in said, f"{arguments}: said {said!r}")
checks.refused(program, "a virtual image", "import virtual.zmx -o x.toml", "the lens diverges", "is virtual")
checks.refused(program, "no focus", "import diverging.zmx --flip -o x.toml", "which diverges, has no focus there")

# What is refused, and nothing is written.
(folder / "kept.toml").write_text("mine")
FILES = {
    "tilted": DOUBLET.replace("SURF 2\n", "SURF 2\n  TYPE COORDBRK\n"),
    "mirror": DOUBLET.replace("GLAS N-BK7", "GLAS MIRROR"),
    "cut": "VERS 1\n" + DOUBLET[:DOUBLET.index("SURF 3")],
    "torus": DOUBLET.replace("SURF 2\n", "SURF 2\n  TYPE TOROIDAL\n"),
    "nan": DOUBLET.replace("DISZ 2.5", "DISZ NaN"),
    "huge": DOUBLET.replace("DISZ 2.5", "DISZ 1e200"),
    "rubbish": "SURF \x01\xff" * 90000,
    "large": "NOTE x\n" * 200000 + DOUBLET,
    "empty": "",
}
for name, text in FILES.items():
    (folder / f"{name}.zmx").write_text(text, encoding="latin-1")
(folder / "cut.json").write_text('{"surface_group": {"surfaces": [')
(folder / "other.json").write_text('{"schema": 1}')
for name, change in {"nopitch": {"pitch": None}, "nancenter": {"center": float("nan")}, "hugepanel": {"screenW": 1e300}, "wordy": {"DPI": "300"},
                     "cells": {"subpixelCells": [{}], "CellPatternMode": 4}, "nocone": {"viewCone": None}}.items():
    (folder / f"{name}.json").write_text(json.dumps(UNIT | change))
for name, arguments, *words in [
    ("unknown glass", "import doublet.zmx -o x.toml", "doublet.zmx:13: surface 2: no catalogue has a glass \"MYSF5\"", "--glass MYSF5=OTHER"),
    ("other glass unknown", "import doublet.zmx --glass MYSF5=N-SFX -o x.toml", "--glass: no catalogue has a glass \"N-SFX\"", "did you mean"),
    ("no such catalogue", "import doublet.zmx --catalogue no.agf -o x.toml", "no.agf: there is no such file"),
    ("glass without a value", "import doublet.zmx --glass MYSF5 -o x.toml", "--glass: \"MYSF5\" is not of the form"),
    ("coordinate break", "import tilted.zmx -o x.toml", "tilted.zmx:13: surface 2 is of type COORDBRK"),
    ("mirror", "import mirror.zmx -o x.toml", "mirror.zmx:12: surface 1: is a mirror"),
    ("cut", "import cut.zmx -o x.toml", "cut.zmx:14: ends with surface 2, which is not the image", "the file is cut"),
    ("toroid", "import torus.zmx -o x.toml", "surface 2 is of type TOROIDAL"),
    ("no number", "import nan.zmx -o x.toml", "nan.zmx:15: surface 2: DISZ \"NaN\" is not a finite number"),
    ("absurd number", "import huge.zmx --glass MYSF5=SF5 -o x.toml", "surface 2: the next surface is 1e+200 mm behind it"),
    ("rubbish", "import rubbish.zmx -o x.toml", "rubbish.zmx:1: SURF"),
    ("large", "import large.zmx -o x.toml", "large.zmx: has 1400", "is this a lens in Zemax's format?"),
    ("empty", "import empty.zmx -o x.toml", "empty.zmx:1: is not a lens in Zemax's format"),
    ("missing", "import no.zmx -o x.toml", "no.zmx: there is no such file"),
    ("cut JSON", "import cut.json -o x.toml", "cut.json: is not JSON: parse error at line 1"),
    ("other JSON", "import other.json -o x.toml", "is this a saved lens?"),
    ("other kind", "import tiny.toml -o x.toml", "tiny.toml: is of kind \".toml\"; .zmx (Zemax), .json (Optiland, or a Looking Glass calibration)"),
    ("calibration without a key", "import nopitch.json -o x.toml", "nopitch.json: pitch: is missing"),
    ("no number in it", "import nancenter.json -o x.toml", "nancenter.json: center: is NaN; give a finite number"),
    ("too large a panel", "import hugepanel.json -o x.toml", "hugepanel.json: screenW: is 1e+300; allowed is 1 to 100000"),
    ("a word in it", "import wordy.json -o x.toml", "wordy.json: DPI: is a text; give a number"),
    ("too few cells", "import cells.json -o x.toml", "subpixelCells: has 1, but CellPatternMode 4 repeats 2"),
    ("no cone", "import nocone.json -o x.toml", "viewCone: is missing, which determines the gap; give --gap-mm"),
    ("options of a lens", "import visual.json --flip --scale 2 -o x.toml", "--flip: is for a lens of a design program", "--scale"),
    ("an option of a calibration", "import doublet.zmx --glass MYSF5=SF5 --index 1.5 -o x.toml", "--index: is for a calibration"),
    ("an absurd index", "import visual.json --index 9 -o x.toml", "--index: is 9; allowed is more than 1 to 4"),
    ("too flat a cylinder", "import visual.json --index 1.2 -o x.toml", "--index: is 1.2: cylinders", "at least 1.3"),
    ("an existing file", "import doublet.zmx --glass MYSF5=SF5 -o kept.toml", "kept.toml already exists"),
    ("no description", "import doublet.zmx --glass MYSF5=SF5 -o x.png", "ends in .toml"),
    ("too large a scale", "import doublet.zmx --glass MYSF5=SF5 --scale 1e7 -o x.toml", "--scale: is 1e7; allowed is 1e-6 to 1e6"),
    ("taller than the eye", "import doublet.zmx --glass MYSF5=SF5 --scale 30 -o x.toml", "--distance-mm and --scale change that"),
    ("all at once", "import cut.zmx --scale x --pixels 9 -o x.png", "--scale", "--pixels", "ends in .toml", "cut.zmx:14"),
]:
    checks.refused(program, name, arguments, *words)
checks.finish()
