"""`lfdsim new` as a user runs it: designs of all sizes that check calls valid, files that are kept, clear errors."""
import json
import math
import re

import numpy
from program import Checks, Program

program, checks = Program(), Checks()

DESIGNS = {  # options, lenses across
    "tablet": ("--panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500", 100),
    "behind": ("--panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 --depth-mm -60", 100),
    "wide": ("--panel-inch 13 --pixels 3840x2160 --fov-deg 70 --distance-mm 600 --depth-mm 80", 50),
    "phone": ("--panel-inch 6 --pixels 1440x3200 --distance-mm 350 --lens ideal", 50),
    "wall": ("--panel-inch 100 --pixels 3840x2160 --fov-deg 40 --distance-mm 3000", 100),
    "hexagons": ("--panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 --lattice hexagon --views 20", 100),
    "pitch": ("--panel-inch 8 --pixels 2560x1600 --fov-deg 25 --distance-mm 500 --pitch-mm 1.3462", 100),
    "near-eye": ("--panel-inch 0.7 --pixels 1920x1080 --fov-deg 30 --distance-mm 20 --depth-mm -1000", 10),
}
for name, (options, lenses) in DESIGNS.items():
    said = program.must(f"new {options} -o {name}.toml")
    checks.that(f"lfdsim view {name}.toml" in said, f"{name}: said {said!r}")
    text = (program.folder / f"{name}.toml").read_text()
    checks.that(f"lfdsim new {options}" in text.replace("\n# ", " "), f"{name}: does not say how it was made")
    checked = json.loads(program.must(f"check {name}.toml --json"))
    display, theory = checked["display"], checked["theory"]
    words = options.split()
    if "--depth-mm" in words:
        wanted = float(words[words.index("--depth-mm") + 1])
        checks.that(abs(theory["central_depth_mm"] / wanted - 1) < 1e-3, f"{name}: central depth {theory['central_depth_mm']}")
    checks.that(display["array"]["count"][0] > lenses and display["name"] == name, f"{name}: {display['array']}")
    # The spherical lenses of a wall mix what eyes see from far away, and check says so.
    told = [w for w in checked["warnings"] if not (name == "wall" and "aberration mixes" in w)]
    checks.that(not told, f"{name}: check warns {told}")
    checks.that(all(w in said for w in checked["warnings"]), f"{name}: new does not say {checked['warnings']}, but {said!r}")
# The widest lenses are a tenth of the shorter side, where 9 elemental images of a near eye's fit.
text = (program.folder / "near-eye.toml").read_text().replace("\n# ", " ")
checks.that("count = [16, 9]" in text and "none is wider than 1/10 of the panel's shorter side" in text, f"near-eye: {text}")

# Whatever check says of a design new has said at once; and a field of view that it names is one of which check says nothing.
DOUBTFUL = [  # options, what is told
    ("--panel-inch 100 --pixels 7680x4320 --distance-mm 3000", "the lenses' aberration mixes"),
    ("--panel-inch 30.5 --pixels 2560x1440 --distance-mm 5387 --lattice hexagon --fov-deg 40 --views 32 --depth-mm 100", "see nearly the same"),
    ("--panel-inch 150 --pixels 1920x1080 --distance-mm 464 --lattice strips", "views do not separate"),
    ("--panel-inch 23.7 --pixels 3840x2160 --distance-mm 5316 --lattice strips --fov-deg 40 --slant-deg 0", "the central depth plane, at infinity"),
    ("--panel-inch 23.5 --pixels 1280x720 --distance-mm 605 --lattice strips --slant-deg -9.46", "red, green and blue apart"),
    ("--panel-inch 96.5 --pixels 2560x1600 --distance-mm 554 --lattice strips --views 2", "the lenses' aberration mixes"),
    ("--panel-inch 1.5 --pixels 2560x1440 --distance-mm 25", "dark bands"),
    ("--panel-inch 115 --pixels 7680x4320 --distance-mm 984 --lens ideal", "the scene is small"),
    ("--panel-inch 8.4 --pixels 1920x1080 --distance-mm 1070 --lattice hexagon", None),  # whose rows are nearer than lenses
    ("--panel-inch 32.8 --pixels 2560x1600 --distance-mm 618 --lattice strips --lens ideal", None),  # three views: no subpixel on a border
    ("--panel-inch 32.8 --pixels 2561x1601 --distance-mm 618 --lattice strips --lens ideal", None),
]
for options, doubt in DOUBTFUL:
    said = program.must(f"new {options} -o doubtful.toml --force")
    warnings = json.loads(program.must("check doubtful.toml --json"))["warnings"]
    checks.that(all(w in said for w in warnings), f"{options}: new does not say {warnings}, but {said!r}")
    checks.that(doubt in said if doubt else not warnings, f"{options}: {said!r}")
    if field := re.search(r"--fov-deg ([0-9.]+), would give no advice", said):
        kept = re.sub(r" --fov-deg \S+", "", options)
        program.must(f"new {kept} --fov-deg {field[1]} -o narrower.toml --force")
        warnings = json.loads(program.must("check narrower.toml --json"))["warnings"]
        checks.that(not warnings, f"{options} --fov-deg {field[1]}: {warnings}")

# A pitch, views and lattice are those that were asked for.
for name, key, wanted in (("hexagons", "views", 20), ("pitch", "views", 20), ("hexagons", "fov_elemental_deg", 30), ("pitch", "fov_elemental_deg", 25)):
    theory = json.loads(program.must(f"check {name}.toml --json"))["theory"]
    checks.that(abs(theory[key] / wanted - 1) < 2e-3, f"{name}: {key} is {theory[key]}")

# Lenticulars: views, pitch, slant, sheet and field of view as asked for; the eye at the distance sees a view at a time.
STRIPS = {  # options, views, degrees along the rows, slant
    "lenticular": ("--panel-inch 10 --pixels 2560x1600 --distance-mm 450", None, 30, 18.4349),
    "eight": ("--panel-inch 10 --pixels 2560x1600 --distance-mm 450 --views 8 --fov-deg 27", 8, 27, 18.4349),
    "lean": ("--panel-inch 15.6 --pixels 3840x2160 --distance-mm 600 --views 5.333 --fov-deg 35 --slant-deg -9.46", 5.333, 35, -9.46),
    "lpi": ("--panel-inch 15.6 --pixels 3840x2160 --distance-mm 600 --pitch-mm 0.635 --slant-deg 12", 0.635 / 0.0899344 / math.cos(math.radians(12)), 30, 12),
    "sheet": ("--panel-inch 24 --pixels 3840x2160 --distance-mm 700 --sheet-mm 4 --views 9", 9, None, 18.4349),
    "upright": ("--panel-inch 65 --pixels 7680x4320 --distance-mm 3000 --views 12 --slant-deg 0 --lens ideal", 12, 30, 0),
    "two-view": ("--panel-inch 6 --pixels 640x360 --distance-mm 350 --views 2", 2, None, 0),
    "two-odd": ("--panel-inch 6 --pixels 641x360 --distance-mm 400 --views 2 --eye-distance-mm 62", 2, None, 0),
}
for name, (options, views, fov, slant) in STRIPS.items():
    said = program.must(f"new --lattice strips {options} -o {name}.toml")
    checked = json.loads(program.must(f"check {name}.toml --json"))
    display, theory, geometry = checked["display"], checked["theory"], checked["geometry"]
    checks.that(not checked["warnings"], f"{name}: check warns {checked['warnings']}")
    checks.that(views is None or abs(theory["views"] / views - 1) < 8e-3, f"{name}: {theory['views']} views")
    checks.that(fov is None or abs(theory["fov_horizontal_deg"] - fov) < 0.15, f"{name}: field of view {theory['fov_horizontal_deg']}")
    checks.that(abs((display["array"].get("slant_deg") or 0) - slant) < 1e-3, f"{name}: slant {display['array']}")
    # Focused on the panel, to what lengths are rounded to.
    checks.that(abs(theory["focal_length_mm"] / theory["gap_mm"] - 1) < 1e-5, f"{name}: f {theory['focal_length_mm']}, g {theory['gap_mm']}")
    sheet = geometry["vertex_plane_mm"]
    if "--sheet-mm" in options:
        checks.that(abs(sheet - 4) < 1e-5, f"{name}: the sheet is {sheet} mm thick")
    distance = float(options.split()[options.split().index("--distance-mm") + 1])
    elemental = theory["elemental_pitch_mm"] / math.cos(math.radians(slant)) / display["panel"]["pixel_pitch_mm"]
    checks.that(views is None or abs(elemental / views - 1) < (1e-4 if "--views" in options else 8e-3), f"{name}: {elemental} pixels behind a lens")
    if name.startswith("two"):
        step = display["panel"]["pixel_pitch_mm"] * (distance - sheet) / theory["gap_mm"]
        checks.that(abs(step - (62 if name == "two-odd" else 65)) < 0.01, f"{name}: views are {step} mm apart")
        # A picture of alternate columns: an eye sees one of both all over the screen, the other eye the other one.
        width, height = display["panel"]["pixels"]
        columns = numpy.zeros((height, width, 3), numpy.float32)
        columns[:, 1::2] = 1
        numpy.save(program.folder / "columns.npy", columns)
        light = []
        for x in (-step / 2, step / 2):
            program.must(f"render {name}.toml --panel-image columns.npy --camera-mm {x},0,{distance} --size 90x50 -o seen.npy --progress none")
            light.append(numpy.load(program.folder / "seen.npy")[15:-15, 15:-15].mean((0, 2)))
        dark, bright = sorted(light, key=lambda each: each.mean())
        checks.that(dark.max() < 0.06 and bright.min() > 0.8, f"{name}: one eye sees {dark.max()}, the other {bright.min()}")

# What real lenses make of it: half of the light is the right lens's up to the edges of the field of view that was asked for.
low, high = json.loads(program.must("analyze zone tablet.toml --json --progress none -o zone"))["horizontal"]["wrong_50_percent_deg"]
checks.that(abs(low + 15) < 0.3 and abs(high - 15) < 0.3, f"field of view: {low} to {high}")

# A file that is there stays, but with --force; nothing is left behind by an error.
TABLET = DESIGNS["tablet"][0]
(program.folder / "kept.toml").write_text("mine")
(program.folder / "dangling.toml").symlink_to("nowhere.toml")
checks.refused(program, "an existing file", f"new {TABLET} -o kept.toml", "--output: kept.toml already exists", "--force")
checks.refused(program, "a dangling link", f"new {TABLET} -o dangling.toml", "already exists")
program.must(f"new {TABLET} -o kept.toml --force")
checks.that((program.folder / "kept.toml").read_text() != "mine", "--force does not replace")
for name, arguments, *words in [
    ("no panel", "new --pixels 10x10 --distance-mm 500 -o x.toml", "--panel-inch is required"),
    ("no picture", f"new {TABLET} -o x.png", "ends in .toml"),
    ("empty output", ["new", *TABLET.split(), "-o", ""], "--output", "empty"),
    ("no such folder", f"new {TABLET} -o none/x.toml", "none/x.toml"),
    ("out of range", f"new {TABLET.replace('30', '200')} -o x.toml", "--fov-deg: is 200; allowed is 1 to 120"),
    ("no number", f"new {TABLET.replace('500', '0.5m')} -o x.toml", "--distance-mm"),
    ("no size", f"new {TABLET.replace('2560x1600', '2560')} -o x.toml", "--pixels"),
    ("too few pixels", f"new {TABLET.replace('2560x1600', '20x1600')} -o x.toml", "--pixels: is 20"),
    ("beyond the eye", f"new {TABLET} --depth-mm 600 -o x.toml", "--depth-mm: is 600, more than half of the way", "--depth-mm 2"),
    ("within the lenses", f"new {TABLET} --depth-mm 0.1 -o x.toml", "--depth-mm: is 0.1, less than twice the gap", "nearest possible: --depth-mm 1.0"),
    ("too narrow", f"new {DESIGNS['near-eye'][0].replace('30', '10')} -o x.toml", "--fov-deg: is 10", "--fov-deg 13"),
    ("unknown lens", f"new {TABLET} --lens fresnel -o x.toml", "--lens", "plano_convex, ideal"),
    ("both pitches", f"new {TABLET} --views 20 --pitch-mm 1 -o x.toml", "--views, --pitch-mm: both determine"),
    ("a pitch of a pixel", f"new {TABLET} --pitch-mm 0.1 -o x.toml", "--pitch-mm: is 0.1, less than two pixels"),
    ("too few lenses", f"new {TABLET} --views 400 -o x.toml", "--views: makes lenses of", "wider than 1/10 of the panel's shorter side, 107.7 mm"),
    ("a slant of squares", f"new {TABLET} --slant-deg 9 -o x.toml", "--slant-deg: is for --lattice strips"),
    ("an unknown lattice", f"new {TABLET} --lattice triangle -o x.toml", "--lattice", "square, hexagon, strips"),
    ("two gaps", f"new {TABLET} --lattice strips --sheet-mm 2 -o x.toml", "--fov-deg, --sheet-mm: both determine the gap"),
    ("a depth of strips", f"new {TABLET} --lattice strips --depth-mm 20 -o x.toml", "--depth-mm: is not for strips"),
    ("too wide for cylinders", f"new {TABLET.replace('30', '80')} --lattice strips --views 8 -o x.toml", "--fov-deg", "less than half the pitch", "--fov-deg of at most 5"),
    ("too thin a sheet", "new --panel-inch 8 --pixels 2560x1600 --distance-mm 500 --lattice strips --views 8 --sheet-mm 0.5 -o x.toml", "--sheet-mm of at least"),
    ("eyes of many views", f"new {TABLET} --lattice strips --views 8 --eye-distance-mm 60 -o x.toml", "--eye-distance-mm: directs the two views"),
    ("ideal glass", "new --panel-inch 8 --pixels 2560x1600 --distance-mm 500 --lattice strips --lens ideal --sheet-mm 2 -o x.toml", "--sheet-mm: is the thickness of glass"),
    ("all at once", "new --panel-inch x --pixels 9 --distance-mm y -o x.png", "--panel-inch", "--pixels", "--distance-mm", "ends in .toml"),
]:
    checks.refused(program, name, arguments.split() if isinstance(arguments, str) else arguments, *words)
checks.finish()
