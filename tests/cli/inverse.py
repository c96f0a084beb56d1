"""`lfdsim eia --pickup inverse` as a user runs it: a panel that is better where eyes are, what is said of it, and clear errors."""
import json

import numpy
from PIL import Image, PngImagePlugin
from program import Checks, Program

program, checks = Program(), Checks()
DISPLAY = """schema = 1
panel = {pixels = [180, 120], pixel_pitch_mm = 0.5}
lens = {type = "plano_convex", sphere_radius_mm = 5, aperture_radius_mm = 2.9, cylinder_height_mm = 1, index = 1.49}
array = {count = [15, 10], pitch_mm = 6, gap_mm = 11}
diffuser = {distance_mm = 60, angle_deg = [3, 3]}
camera = {position_mm = [0, 0, 600]}
content = {viewing_distance_mm = 600}
"""
(program.folder / "small.toml").write_text(DISPLAY)

said = program.must("eia small.toml --pickup inverse -o eia.png --set content.inverse.rays=16 content.inverse.iterations=6")
checks.that("at eyes that were not fitted:" in said and "traced content:" in said, f"does not say what it gains: {said!r}")
told = json.loads(program.must("eia small.toml --pickup inverse --eyes-mm=-60,0,600,60,0,600 -o eia.npy --json --set content.inverse.rays=16"))["inverse"]
checks.that(told["held_out"]["psnr_db"] > told["held_out_traced"]["psnr_db"] + 1, f"gains nothing: {told}")
for key in ("places", "rays", "rows_per_unknown", "rays_per_unknown", "iterations", "seconds", "black", "white", "fitted", "at_black_percent", "unseen_percent"):
    checks.that(key in told, f"JSON has no inverse.{key}")
light = numpy.load(program.folder / "eia.npy")
checks.that(light.min() >= 0 and light.max() <= 1, f"light from {light.min()} to {light.max()}")
program.must("eia small.toml --pickup inverse --levels 0.2,0.7 -o levels.npy --set content.inverse.rays=16 content.inverse.iterations=4")
checks.that(numpy.load(program.folder / "levels.npy").mean() > light.mean(), "levels lift no black")
program.must("eia small.toml --pickup inverse -o again.npy --set content.inverse.rays=16 content.inverse.start=eia.png content.inverse.iterations=2")
marked = PngImagePlugin.PngInfo()
marked.add_text("incomplete", "true")
Image.open(program.folder / "eia.png").save(program.folder / "cut.png", pnginfo=marked)
code, _, words = program.run("eia small.toml --pickup inverse -o again.npy --set content.inverse.rays=16 content.inverse.start=cut.png content.inverse.iterations=1")
checks.that(code == 0 and "cut.png: is marked incomplete" in words, f"an incomplete start: {code} {words}")
said = program.must("render small.toml --pickup inverse --set content.inverse.rays=16 content.inverse.iterations=2 camera.resolution=[64,48] -o view.png")
checks.that("content at eyes that were not fitted:" in said, f"render does not say how good its content is: {said!r}")

program.must("views small.toml --grid 5x1 --baseline-mm 20 --view-size 60x40 -o grid")
code, _, words = program.run("eia small.toml --views grid --pickup inverse --eyes-mm=-40,0,600,40,0,600 -o views.png --set content.inverse.rays=16 content.inverse.iterations=3")
checks.that(code == 0, f"views as targets: {words}")
code, _, words = program.run("eia small.toml --views grid --pickup inverse --eyes-mm=-300,0,600,-200,0,600 -o beside.png --set content.inverse.rays=16 content.inverse.iterations=1")
checks.that(code == 2 and "pass beside the views' cameras" in words and not (program.folder / "beside.png").exists(), f"eyes beside all views: {code} {words}")

for picture in (program.folder / "grid").glob("view_*.png"):
    Image.new("RGB", (60, 40)).save(picture)
code, _, words = program.run("eia small.toml --views grid --pickup inverse --eyes-mm=-40,0,600,40,0,600 -o black.png --set content.inverse.rays=16 content.inverse.iterations=1")
checks.that(code == 0 and "the content is black from these eyes" in words, f"black views as targets: {words}")

# Two boxes of eyes, of which each sees some of the other's light.
boxes = "content.inverse.eyes_mm=[[-34,0,600],[-30,0,600],[30,0,600],[34,0,600]]"
two = json.loads(program.must(f"eia small.toml --pickup inverse -o two.npy --json --set {boxes} content.inverse.rays=16 content.inverse.iterations=2"))["inverse"]
checks.that(0 < two["crosstalk"] < 1 and told["crosstalk"] is None, f"crosstalk: {two['crosstalk']}, {told['crosstalk']}")

# A box that is a point has no other eyes; eyes far aside see too little to be compared.
said = program.must("eia small.toml --pickup inverse --eyes-mm=0,0,600,0,0,600 -o point.png --set content.inverse.rays=16 content.inverse.iterations=1")
checks.that("at the fitted eyes, by other rays:" in said, f"calls the fitted eye one that was not fitted: {said!r}")

BAD = {  # options -> what the message names
    "--eyes-mm=-60,0,5,60,0,5": "content.inverse.eyes_mm: an eye at",
    "--eyes-mm=-60,0,-600,60,0,-600": "content.inverse.eyes_mm: an eye at",
    "--eyes-mm=-60,0,600,60,0": "--eyes-mm",
    "--eyes-mm=-1e6,0,30,1e6,0,30": "content.inverse.eyes_mm",
    "--levels 0.9,0.1": "--levels",
    "--levels 0.5,0.5": "--levels",
    "--levels 0,2": "--levels",
    "--mapping map.npy": "--mapping",
    "--set content.sampling=\"pixel\"": "content.sampling",
    "--set content.inverse.start=eia-small.png": "content.inverse.start",
    "--set content.inverse.start=none-such.png": "none-such.png",
    "--set content.inverse.memory_mb=1 content.inverse.rays=1000": "content.inverse.memory_mb",
    "--set content.inverse.memory_mb=100000000": "content.inverse.memory_mb",
    "--set content.inverse.eyes_mm=[[0,0,600]]": "content.inverse.eyes_mm",
    "--set content.inverse.places=1": "content.inverse.places",
    "--set content.inverse.eyes_mm=5": "content.inverse.eyes_mm",
    "--set content.inverse.pixel_mm=0.000002": "content.inverse.pixel_mm",
    "--set content.inverse.pixel_mm=1000": "content.inverse.pixel_mm",
    "--pattern white": "--pattern",
}
program.must("eia small.toml --set panel.pixels=[90,60] -o eia-small.png")
for options, names in BAD.items():
    code, _, words = program.run(f"eia small.toml --pickup inverse {options} -o bad.png")
    checks.that(code == 2 and names in words, f"{options}: exit code {code}, said {words!r}")
    checks.that(not (program.folder / "bad.png").exists(), f"{options}: wrote a picture")
code, _, words = program.run("eia small.toml --pickup inverse --set content.inverse.start=eia.png -o eia.png")
checks.that(code == 2 and "eia.png: is the same file as content.inverse.start, eia.png" in words, f"its own start: {words!r}")
program.must("eia small.toml --set content.inverse.start=again.png -o again.png")  # not read without the inverse pick-up
code, _, words = program.run("eia small.toml --levels 0.1,0.9 -o bad.png")
checks.that(code == 2 and "--levels: is only for --pickup inverse" in words, f"levels of another pick-up: {words!r}")
code, _, words = program.run("eia small.toml --pickup inverse -o few.png --set content.inverse.places=2 content.inverse.rays=4")
checks.that(code == 0 and "the fit follows noise" in words, f"few rays: {words!r}")

checks.finish()
