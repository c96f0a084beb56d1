"""`lfdsim new` as a user runs it: designs of all sizes that check calls valid, files that are kept, clear errors."""
import json

from program import Checks, Program

program, checks = Program(), Checks()

DESIGNS = {  # options, lenses across
    "tablet": ("--panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500", 100),
    "behind": ("--panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 --depth-mm -60", 100),
    "wide": ("--panel-inch 13 --pixels 3840x2160 --fov-deg 70 --distance-mm 600 --depth-mm 80", 50),
    "phone": ("--panel-inch 6 --pixels 1440x3200 --distance-mm 350 --lens ideal", 50),
    "wall": ("--panel-inch 100 --pixels 3840x2160 --fov-deg 40 --distance-mm 3000", 100),
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
    ("all at once", "new --panel-inch x --pixels 9 --distance-mm y -o x.png", "--panel-inch", "--pixels", "--distance-mm", "ends in .toml"),
]:
    checks.refused(program, name, arguments.split() if isinstance(arguments, str) else arguments, *words)
checks.finish()
