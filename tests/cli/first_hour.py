"""What a new user runs into: no model, a wrong file for the viewer, outputs that would replace inputs, pictures made for another display."""
import json
import os
import signal

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
QUIET = "--progress none"


def said(arguments, code=0):
    """Standard error of a run that ends with that exit code."""
    got, out, err = program.run(arguments)
    checks.that(got == code, f"{arguments}: exit code {got}, wanted {code}: {err}")
    return err


def errors(arguments):
    return [line for line in said(arguments, 2).splitlines() if line.startswith("lfdsim: error: ")]


# Without a model every command shows the spheres.
for command, name in [("eia tiny.toml", "eia.npy"), ("photo tiny.toml", "photo.npy"), ("render tiny.toml", "view.npy")]:
    program.must(f"{command} {QUIET} -o {name}")
    program.must(f"{command} {QUIET} --model built-in:spheres -o given-{name}")
    checks.that((folder / name).read_bytes() == (folder / f"given-{name}").read_bytes(), f"{command}: not the spheres")
for words in ["", "--model built-in:spheres"]:
    program.must(f"export pov tiny.toml --set diffuser=none {QUIET} -o scene{len(words)} {words}")
checks.that((folder / "scene0/panel.png").read_bytes() == (folder / "scene24/panel.png").read_bytes(), "export: not the spheres")
checks.that("default: built-in:spheres" in program.must("check tiny.toml --all"), "check does not say what is shown")

# The viewer refuses at its start what render refuses, in the same words.
(folder / "empty.obj").write_text("")
(folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n")
program.must("eia tiny.toml --pattern white --set panel.pixels=[8,6] -o small.png")
for shown in ["--panel-image none.png", "--panel-image small.png", "--panel-image tiny.toml", "--model none.obj", "--model empty.obj", "--model flat.obj",
              "--model tiny.toml", "--set content.model=none.obj", "--panel-image panel.png --pattern white"]:
    words = shown.split()
    told = errors(["render", "tiny.toml", *words, "-o", "none.png"])
    checks.that(told and told == errors(["view", "tiny.toml", *words]), f"view and render on {shown}: {told}")
process = program.start("view tiny.toml")
checks.that("http://" in process.stdout.readline(), "view without a model does not start")
process.send_signal(signal.SIGTERM)
process.communicate(timeout=60)

# Outputs replace no input, whatever it is called.
(folder / "eia.png").write_bytes((folder / "panel.png").read_bytes())
program.must(f"render tiny.toml --panel-image eia.png {QUIET} -o view.png")
os.symlink("eia.png", folder / "link.png")
os.link(folder / "eia.png", folder / "hard.png")
os.link(folder / "tiny.toml", folder / "display.toml")
(folder / "frames").mkdir()
os.link(folder / "eia.png", folder / "frames/0001.png")
(folder / "results").mkdir()
os.symlink("../tiny.toml", folder / "results/report.html")
(folder / "path.json").write_text(json.dumps({"schema": 1, "frames_per_second": 1, "poses": [
    {"time_s": 0, "position_mm": [0, 0, 400]}, {"time_s": 1, "position_mm": [9, 0, 400]}]}))
(folder / "skin.obj").write_text("mtllib skin.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl skin\nf 1/1 2/2 3/3\n")
(folder / "skin.mtl").write_text("newmtl skin\nmap_Kd skin.png\n")
(folder / "skin.png").write_bytes((folder / "small.png").read_bytes())
program.must("errors tiny.toml --set errors.height_sd_mm=0.01 -o lenses.csv")
CORNERS = "--corners 9,9 79,9 79,40 9,40 --view-corners 9,9 79,9 79,40 9,40"
for name, arguments, *words in [
    ("the panel image", "render tiny.toml --panel-image eia.png -o eia.png", "--panel-image, eia.png"),
    ("by another path", f"render tiny.toml --panel-image {folder}/eia.png -o ./eia.png", "./eia.png: is the same file as"),
    ("by a symbolic link", "render tiny.toml --panel-image eia.png -o link.png", "link.png: is the same file as --panel-image, eia.png"),
    ("by a hard link", "render tiny.toml --panel-image hard.png -o eia.png", "eia.png: is the same file as --panel-image, hard.png"),
    ("frames of a path", "render tiny.toml --panel-image eia.png --path path.json -o frames", "frames/0001.png: is the same file as"),
    ("the description", f"export pov tiny.toml --set diffuser=none {QUIET} -o .", "display.toml: is the same file as the description, tiny.toml"),
    ("another display's scene", f"export pov tiny.toml --set diffuser=none array.gap_mm=5.1 {QUIET} -o scene0", "scene0/display.toml: is of another display"),
    ("the report", f"analyze spot tiny.toml {QUIET} -o results", "results/report.html: is the same file as the description"),
    ("a model's texture", f"photo tiny.toml --model skin.obj {QUIET} -o skin.png", "skin.png: is the same file as a file of the model"),
    ("an overlay", f"compare view.png eia.png {CORNERS} -o view.png", "view.png: is the same file as A"),
    ("a difference", f"compare view.png eia.png {CORNERS} --difference link.png", "link.png: is the same file as B"),
    ("two pictures of one name", f"compare view.png eia.png {CORNERS} -o x.png --difference x.png", "--overlay, --difference"),
    ("a table of errors", "errors tiny.toml --set errors.table=lenses.csv -o lenses.csv", "lenses.csv: is the same file as errors.table"),
    ("a sheet", "sheet view.png eia.png -o view.png", "view.png: is the same file as IMAGE"),
]:
    checks.refused(program, name, arguments, *words)

# A panel image that was made for another display is shown, and a warning names what differs.
SHOW = f"render tiny.toml --panel-image eia.png {QUIET} -o shown.png"
program.must(f"eia tiny.toml {QUIET} -o eia.png")
checks.that("warning" not in said(f"{SHOW} --camera-mm 5,0,390 --samples 9 --set render.fresnel=none"), "a warning of what changes nothing")
err = said(f"{SHOW} --set array.gap_mm=5.1 array.offset_mm=[0.5,0] content.viewing_distance_mm=inf lens.index=1.6 panel.encoding=linear")
for words in ["eia.png: was made for another display", "array.gap_mm 5, not 5.1", "array.offset_mm 0,0, not 0.5,0", "content.viewing_distance_mm 2000, not inf",
              "principal planes", "panel.encoding srgb, not linear"]:
    checks.that(words in err, f"another display: no {words!r} in {err}")
checks.that(err.count("warning") == 1, f"more than one warning: {err}")
checks.that("warning" not in said(f"{SHOW.replace('eia', 'panel')} --set array.gap_mm=5.1"), "a checkerboard is made for no lenses")
# Content that is made for the described display is for each that is built by it; content that knows the errors is for that one.
checks.that("warning" not in said(f"{SHOW} --set errors.gap_mm=0.1 errors.shift_mm=[0.2,0]"), "a warning of errors that the content does not know")
BUILT = "content.made_for=built errors.gap_mm=0.1"
program.must(f"eia tiny.toml {QUIET} --set {BUILT} -o eia.png")
checks.that("warning" not in said(f"{SHOW} --set {BUILT}"), "a warning of the errors that the content was made for")
checks.that("another display: other errors of assembly" in said(f"{SHOW} --set errors.shift_mm=[0.2,0]"), "no warning of other errors than those that the content was made for")
program.must(f"eia tiny.toml {QUIET} -o eia.exr")
checks.that("array.gap_mm" in said(f"render tiny.toml --panel-image eia.exr {QUIET} -o shown.png --set array.gap_mm=5.1"), "an EXR's header is not read")

# Pictures of two cameras.
program.must(f"photo tiny.toml {QUIET} -o truth.png")
checks.that("warning" not in said("compare view.png truth.png"), "a warning of two pictures by one camera")
program.must(f"photo tiny.toml {QUIET} --camera-mm 5,0,400 --frame-width-mm 40 -o truth.png")
err = said("compare view.png truth.png")
for words in ["view.png and truth.png", "camera.position_mm 0,0,400, not 5,0,400", "camera.frame_width_mm 46, not 40"]:
    checks.that(words in err, f"another camera: no {words!r} in {err}")
checks.finish()
