"""Grids of views and quilts: what is written reads back, by a second program's arithmetic where there is one; bad ones are refused."""
import json
import shutil
import signal
import subprocess
import time

import numpy as np
from PIL import Image

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
QUIET = "--progress none"
# A focus behind the pyramid, cameras around the viewer at 400 mm.
GRID = "--focus-width-mm 48 --focus-depth-mm 0 --camera-distance-mm 360 --baseline-mm 90,75"


def views(arguments):
    program.must(f"views tiny.toml --model pyramid.obj {arguments} {QUIET}")


def eia(arguments, description="tiny.toml"):
    """The panel's light, and what is said about it."""
    code, out, err = program.run(f"eia {description} {arguments} --json {QUIET} -o e.npy")
    assert code == 0, f"{arguments}: {err}"
    return np.load(folder / "e.npy"), json.loads(out), err


def same(a, b):
    return a.shape == b.shape and (a == b).all()


# A folder in three kinds of files; threads; nothing changes but the codes of a PNG.
views(f"--grid 3x3 --view-size 96x64 {GRID} --depth --views-as npy -o grid")
views(f"--grid 3x3 --view-size 96x64 {GRID} --views-as exr -o exr")
views(f"--grid 3x3 --view-size 96x64 {GRID} -o png --bits 16")
names = sorted(p.name for p in (folder / "grid").iterdir())
checks.that(names == [f"depth_000{k}.npy" for k in range(9)] + [f"view_000{k}.npy" for k in range(9)] + ["views.toml"], f"{names}")
direct, _, _ = eia("--model pyramid.obj")
deep, said, _ = eia("--views grid")
checks.that(said["views"]["by_depth"] and said["views"]["columns"] == 3 and said["views"]["rows"] == 3, f"{said}")
checks.that(said["views"]["form"] == "numbered pictures", f"{said}")
flat, said, _ = eia("--views exr")
checks.that(not said["views"]["by_depth"], f"{said}")
checks.that(same(flat, eia("--views exr --threads 1")[0]), "threads change elemental images of views")
checks.that(np.abs(eia("--views png")[0] - flat).max() < 2e-3, "16-bit PNG differs from EXR")
checks.that(same(eia("--views exr/views.toml")[0], flat), "the description by its own name")
# Only what leaves between the cameras has light in both.
between = (flat > 0).any(2) & (deep > 0).any(2) & (direct > 0).any(2)
errors = [float(np.abs(made - direct)[between].mean()) for made in (deep, flat)]
print(f"elemental images of 3 x 3 views against the model's: {between.sum()} pixels, mean difference {errors[0]:.4f} by depth, {errors[1]:.4f} without, "
      f"of {direct[between].mean():.4f}")
checks.that(between.sum() > 60 and errors[0] < 0.8 * errors[1], "depth maps do not help")

# A quilt has the same views, counted from the lower left; its elemental images are those of the row, bit for bit.
ROW = "--focus-width-mm 48 --focus-depth-mm 18 --camera-distance-mm 360 --view-cone-deg 20"
views(f"--grid 8x1 --view-size 60x40 {ROW} --views-as npy -o row")
views(f"--view-size 60x40 {ROW} --cone bins -o quilt_qs4x2a1.5.npy")
quilt = np.load(folder / "quilt_qs4x2a1.5.npy")
checks.that(quilt.shape == (80, 240, 3), f"{quilt.shape}")
for k in range(8):
    tile = quilt[80 - 40 * (k // 4 + 1):80 - 40 * (k // 4), 60 * (k % 4):60 * (k % 4 + 1)]
    checks.that(same(tile, np.load(folder / f"row/view_000{k}.npy")), f"view {k} is not in its place")
x = [float(v) for v in (folder / "row/views.toml").read_text().split("camera_x_mm = [")[1].split("]")[0].split(",")]
checks.that(np.allclose(x, [360 * np.tan(np.radians(20) * ((i + 0.5) / 8 - 0.5)) for i in range(8)], rtol=1e-12), f"cameras at {x}")
of_row, _, _ = eia("--views row")
of_quilt, said, _ = eia("--views quilt_qs4x2a1.5.npy")
checks.that(same(of_row, of_quilt) and of_row.max() > 0.1, "a quilt differs from the row of its views")
checks.that(said["views"]["form"] == "quilt" and said["views"]["columns"] == 8 and said["views"]["rows"] == 1, f"{said}")
# By default a quilt's cameras stand from one end of the cone to the other; the file beside it says so, and reads back.
views(f"--view-size 60x40 {ROW} -o ends_qs4x2a1.5.npy")
text = (folder / "ends_qs4x2a1.5.toml").read_text()
x = [float(v) for v in text.split("camera_x_mm = [")[1].split("]")[0].split(",")]
checks.that(np.allclose(x, [360 * np.tan(np.radians(20) * (i / 7 - 0.5)) for i in range(8)], rtol=1e-12), f"cameras at {x}")
checks.that('view_cone_deg = 20, cone = "ends"' in text, f"how the cameras stand is not said: {text}")
at_ends, said, _ = eia("--views ends_qs4x2a1.5.npy")
checks.that(abs(said["views"]["cameras_width_mm"] - 2 * 360 * np.tan(np.radians(10))) < 1e-9, f"{said}")
(folder / "ends_qs4x2a1.5.toml").write_text("schema = 1\nview_cone_deg = 20\n" + text[text.index("distance_mm"):])
checks.that(same(eia("--views ends_qs4x2a1.5.npy")[0], at_ends), "view_cone_deg of a quilt is not from end to end")
checks.that(not same(eia("--views ends_qs4x2a1.5.npy --cone bins")[0], at_ends), "--cone does nothing")
# Without the file beside it the name must do, and what is assumed is said.
shutil.copy(folder / "quilt_qs4x2a1.5.npy", folder / "bare_qs4x2a1.5.npy")
_, said, err = eia("--views bare_qs4x2a1.5.npy")
checks.that("40 degrees" in err and "viewing distance" in err, f"assumed silently: {err}")

# A display by its calibration takes the view of a quilt that the published formula gives it, floor(n (1 - frac(phase))): exactly in the
# middle of each view's part, by linear mixing of two between; none is black, with any gap, and none is warned of. Spare columns and rows
# of pixels (red) belong to no view, a full alpha channel is none.
UNIT = {"pitch": 79.4, "slope": -6.41, "center": -0.217, "DPI": 480, "screenW": 360, "screenH": 240, "viewCone": 54}
(folder / "cone54.json").write_text(json.dumps(UNIT))
COLUMNS, ROWS, w, h = 11, 6, 12, 8
n = COLUMNS * ROWS
codes = np.zeros((ROWS * h + 5, COLUMNS * w + 7, 4), np.uint8)
codes[..., 0] = codes[..., 3] = 255
for k in range(n):
    left, top = k % COLUMNS * w, codes.shape[0] - (k // COLUMNS + 1) * h
    codes[top:top + h, left:left + w, :3] = 3 * k + 20
Image.fromarray(codes).save(folder / "own_qs11x6a1.5.png")
column, row, channel = np.meshgrid(np.arange(UNIT["screenW"]), np.arange(UNIT["screenH"])[::-1], np.arange(3), indexing="xy")
cycles = UNIT["pitch"] * UNIT["screenW"] / UNIT["DPI"] * np.cos(np.arctan(1 / UNIT["slope"]))
phase = ((column + 0.5 + channel / 3) / UNIT["screenW"] + (row + 0.5) / UNIT["screenH"] * UNIT["screenH"] / (UNIT["screenW"] * UNIT["slope"])) * cycles - UNIT["center"]
place = n * (1 - (phase - np.floor(phase)))  # view k is from k to k + 1
decode = lambda code: np.where(code <= 0.04045 * 255, code / 255 / 12.92, ((code / 255 + 0.055) / 1.055) ** 2.4)
low = np.clip(np.floor(place - 0.5), 0, n - 1)
share = np.clip(place - 0.5 - low, 0, 1)
wanted = decode(3 * low + 20) * (1 - share) + decode(3 * np.minimum(low + 1, n - 1) + 20) * share
at_border = np.minimum(place, n - place) < 1e-3  # of two elemental images, which of them has the subpixel is a matter of rounding
for options in ("", "--gap-mm 0.4", "--index 1.7"):
    program.must(f"import cone54.json {options} -o cone54.toml --force")
    shown, said, err = eia("--views own_qs11x6a1.5.png", "cone54.toml")
    wrong = np.abs(shown - wanted)[~at_border].max()
    checks.that(wrong < 2e-4, f"{options}: a subpixel of a quilt is off by {wrong} of light")
    checks.that(said["views"]["beside_cameras"] == 0 and said["views"]["beside_focus"] == 0, f"{options}: {said['views']}")
    checks.that("rightmost 7 columns" in err and "uppermost 5 rows" in err and "cone" not in err and "distance" not in err, f"{options}: {err}")
program.must("import cone54.json -o cone54.toml --force")
for options, width in (("--view-cone-deg 40", 2 * np.tan(np.radians(20))), ("--cone bins", 2 * np.tan(np.radians(27) * 65 / 66)), ("--cone ends", 2 * np.tan(np.radians(27)))):
    said = eia(f"--views own_qs11x6a1.5.png {options}", "cone54.toml")[1]["views"]
    checks.that(abs(said["cameras_width_mm"] / said["camera_distance_mm"] / width - 1) < 1e-9, f"{options}: {said}")
codes[3, 4, 3] = 254
Image.fromarray(codes).save(folder / "clear_qs11x6a1.5.png")
checks.refused(program, "a clear pixel", "eia cone54.toml --views clear_qs11x6a1.5.png -o x.png", "transparency", "column 4, row 3")

# ROW_COLUMN names, and the doubt of light that is codes.
for k in range(9):
    shutil.copy(folder / f"png/view_000{k}.png", folder / f"{k // 3:03}_{k % 3:03}.png")
(folder / "rowcol").mkdir()
for k in range(9):
    (folder / f"{k // 3:03}_{k % 3:03}.png").rename(folder / f"rowcol/{k // 3:03}_{k % 3:03}.png")
by_names, said, err = eia(f"--views rowcol {GRID}")
checks.that(said["views"]["form"] == "ROW_COLUMN names" and "ROW_COLUMN" in err, f"{said} {err}")
checks.that(same(by_names, eia("--views png")[0]), "names by row and column are another grid")
np.save(folder / "codes.npy", np.full((48, 88, 3), 128, np.uint8))
np.save(folder / "codes_float.npy", np.full((48, 88, 3), 128, np.float32))
Image.fromarray(np.full((48, 88, 4), (128, 128, 128, 255), np.uint8)).save(folder / "codes.png")
seen = {}
for name in ("codes.npy", "codes.png", "codes_float.npy"):
    code, _, err = program.run(f"render tiny.toml --panel-image {name} -o seen.npy {QUIET}")
    checks.that(code == 0 and ("white is 1" in err) == (name == "codes_float.npy"), f"{name}: {code} {err}")
    seen[name] = np.load(folder / "seen.npy")
checks.that(same(seen["codes.npy"], seen["codes.png"]), "uint8 of an .npy are not the codes of a PNG")

# Reversed views are pseudoscopic; the flag and the key reverse them again.
shutil.copytree(folder / "row", folder / "reversed")
for k in range(8):
    shutil.copy(folder / f"row/view_000{k}.npy", folder / f"reversed/view_000{7 - k}.npy")
wrong, said, _ = eia("--views reversed")
checks.that((wrong != of_row).any() and not said["views"]["flipped"], "the order of views does nothing")
right, said, _ = eia("--views reversed --flip-views")
checks.that(same(right, of_row) and said["views"]["flipped"], "--flip-views does not reverse views")
text = (folder / "reversed/views.toml").read_text()
(folder / "reversed/views.toml").write_text(text + "pseudoscopic = true\n")
checks.that(same(eia("--views reversed")[0], of_row), "pseudoscopic = true does not reverse views")
checks.that(same(eia("--views reversed --flip-views")[0], wrong), "twice reversed is not as before")

# The same pictures as HCI 4D, 10 times as large and far away; the benchmark's disparity in pixels from view to view.
SPHERES = "--grid 3x3 --view-size 240x160 --focus-width-mm 48 --focus-depth-mm 4 --camera-distance-mm 360 --baseline-mm 90"
program.must(f"views tiny.toml {SPHERES} --depth --views-as npy -o spheres {QUIET}")
program.must(f"views tiny.toml {SPHERES} -o spheres_png {QUIET}")
hci = folder / "hci"
hci.mkdir()
for k in range(9):
    shutil.copy(folder / f"spheres_png/view_000{k}.png", hci / f"input_Cam00{k}.png")
(hci / "parameters.cfg").write_text("""[intrinsics]
focal_length_mm = 75.0
image_resolution_x_px = 240
image_resolution_y_px = 160
sensor_size_mm = 10.0
[extrinsics]
num_cams_x = 3
num_cams_y = 3
baseline_mm = 900.0
focus_distance_m = 3.6
""")
assert abs(10 / 75 * 3600 - 480) < 1e-9  # mm, the width at the focus
HCI = "--focus-width-mm 48 --focus-depth-mm 4"
of_hci, said, _ = eia(f"--views hci {HCI}")
checks.that(said["views"]["form"] == "HCI 4D" and abs(said["views"]["camera_distance_mm"] - 360) < 1e-9, f"{said}")
checks.that(same(of_hci, eia("--views spheres_png")[0]), "HCI 4D differs from the same views numbered")
done = subprocess.run([program.path, "eia", "../tiny.toml", "--views", "parameters.cfg", *HCI.split(), "--progress", "none", "-o", "../cfg.npy"], cwd=hci,
                      capture_output=True, text=True, check=False)
checks.that(done.returncode == 0 and same(np.load(folder / "cfg.npy"), of_hci), f"parameters.cfg by its name alone: {done.stderr}")
# A cone stays a cone at any distance of the cameras; the one that is asked for is that of a row, whatever the number of rows.
(folder / "coned").mkdir()
for k in range(9):
    shutil.copy(folder / f"spheres_png/view_000{k}.png", folder / f"coned/view_000{k}.png")
for distance in ("", "distance_mm = 2000\n"):
    (folder / "coned/views.toml").write_text(f"schema = 1\ncolumns = 3\nrows = 3\nview_cone_deg = 40\nwidth_mm = 48\n{distance}")
    _, of_cone, _ = eia("--views coned --camera-distance-mm 200")
    checks.that(abs(of_cone["views"]["cameras_width_mm"] - 400 * np.tan(np.radians(40 / 3))) < 1e-6, f"{distance!r}: {of_cone['views']}")
for name, rows in ("low", 1), ("high", 3):
    (folder / name).mkdir()
    for k in range(2 * rows):
        shutil.copy(folder / "spheres_png/view_0000.png", folder / f"{name}/out_{k // 2:02}_{k % 2:02}_{-k // 2 * 0.5}_{k % 2 * 0.5}_.png")
    _, of_row, _ = eia(f"--views {name} --view-cone-deg 30 --camera-distance-mm 1000 --focus-width-mm 48")
    checks.that(abs(of_row["views"]["cameras_width_mm"] - 1000 * np.tan(np.radians(15))) < 1e-6, f"{rows} rows: {of_row['views']}")
depth = np.load(folder / "spheres/depth_0004.npy")[..., 0]
disparity = np.where(depth > 0, 90 * (240 / 48) * (360 / np.maximum(depth, 1) - 1), np.inf)
disparity = np.where(np.isfinite(disparity), disparity, disparity.min()).astype("<f4")


def pfm(name, values):
    (hci / name).write_bytes(b"Pf\n240 160\n-1.0\n" + values[::-1].tobytes())


pfm("gt_disp_lowres.pfm", disparity)
by_disparity, said, err = eia(f"--views hci {HCI}")
checks.that(said["views"]["by_depth"] and "pseudoscopic" not in err, f"{said} {err}")
(hci / "gt_disp_lowres.pfm").rename(hci / "kept.pfm")
pfm("gt_depth_lowres.pfm", np.where(depth > 0, depth / 100, 0).astype("<f4"))  # metres of a scene 10 times as large
by_metres, said, _ = eia(f"--views hci {HCI}")
checks.that(said["views"]["by_depth"] and np.abs(by_metres - by_disparity).mean() < 0.004, "depth and disparity disagree")
truth, _, _ = eia("")
between = (by_metres > 0).any(2) & (of_hci > 0).any(2) & (truth > 0).any(2)
errors = [float(np.abs(made - truth)[between].mean()) for made in (by_metres, of_hci)]
print(f"HCI 4D of spheres: {between.sum()} pixels, mean difference from the model's {errors[0]:.4f} by depth, {errors[1]:.4f} without, of {truth[between].mean():.4f}")
checks.that(between.sum() > 60 and errors[0] < 0.75 * errors[1], "HCI's depth map does not help")
# With a depth map views in reversed order are noticed: their parts move the wrong way. Neighbours must be near enough to be alike.
program.must(f"views tiny.toml {SPHERES.replace('-mm 90', '-mm 14').replace('depth-mm 4', 'depth-mm 20')} --depth -o near {QUIET}")
shutil.copytree(folder / "near", folder / "mirrored")
for k in range(9):
    shutil.copy(folder / f"near/view_000{8 - k}.png", folder / f"mirrored/view_000{k}.png")
for arguments, doubted in (("near", False), ("mirrored", True)):
    _, _, err = eia(f"--views {arguments}")
    checks.that(("pseudoscopic" in err and "--flip-views" in err) == doubted, f"{arguments}: {err}")

# Of the display: the picture of a camera that looks straight at it, twice as fine, averaged over each pixel; aside by shares of pixels.
program.must(f"eia tiny.toml --model pyramid.obj -o shown.npy {QUIET}")
said = program.must(f"views tiny.toml --of display --panel-image shown.npy --grid 3x1 --view-size 60x40 --focus-width-mm 45 --focus-depth-mm 18 "
                    f"--camera-distance-mm 360 --baseline-mm 31.7 --views-as npy -o of_display --json {QUIET}")
checks.that({"estimator", "points_share", "kernel"} <= json.loads(said).keys(), f"views of the display: how they were made is not said: {said}")
vertex_plane = json.loads(program.must("check tiny.toml --json"))["geometry"]["vertex_plane_mm"]
focus, fine = vertex_plane + 18, 45 / 60 / 2  # heights and pixels in mm
for k, x in enumerate([-31.7, 0, 31.7]):
    half = int(np.ceil((abs(x) + 22.5) / fine)), int(np.ceil(15 / fine))
    program.must(f"render tiny.toml --panel-image shown.npy --set camera.position_mm=[{x},0,{focus + 360}] --set camera.target_mm=[{x},0,{focus}] "
                 f"--set camera.frame_width_mm={2 * half[0] * fine} --set camera.resolution=[{2 * half[0]},{2 * half[1]}] -o straight.npy {QUIET}")
    straight = np.load(folder / "straight.npy").astype(float)
    left = half[0] - (22.5 + x) / fine + 2 * np.arange(60)[:, None]  # of each pixel of the view, in those of the picture
    covers = np.clip(np.minimum(left + 2, np.arange(2 * half[0]) + 1) - np.maximum(left, np.arange(2 * half[0])), 0, 1) / 2
    wanted = np.einsum("ij,kjc->kic", covers, straight[0::2] / 2 + straight[1::2] / 2)
    got = np.load(folder / f"of_display/view_000{k}.npy")
    checks.that(got.mean() > 0.005 and np.abs(got - wanted).max() < 1e-4, f"camera at {x} mm: off by {np.abs(got - wanted).max()}")

# Wrong views, each with its place; nothing is written.
views(f"--grid 2x2 --view-size 24x16 {GRID} -o good")


def refused(name, change, *said, arguments=""):
    broken = folder / f"broken {name}"
    shutil.copytree(folder / "good", broken)
    change(broken)
    before = program.files()
    code, _, err = program.run(["eia", "tiny.toml", "--views", str(broken), *arguments.split(), "-o", "never.png"])
    checks.that(code == 2 and all(word in err for word in said), f"{name}: {code} {err!r} lacks one of {said}")
    checks.that(program.files() == before, f"{name}: files changed")


def text_of(change):
    return lambda broken: (broken / "views.toml").write_text(change((broken / "views.toml").read_text()))


program.must(f"views tiny.toml --model pyramid.obj --grid 1x1 --view-size 12x8 --views-as png -o small {QUIET}")
refused("missing picture", lambda f: (f / "view_0003.png").unlink(), "3 pictures", "4")
refused("odd size", lambda f: shutil.copy(folder / "small/view_0000.png", f / "view_0002.png"), "view_0002.png", "12 x 8")
refused("no picture", lambda f: (f / "view_0001.png").write_bytes(b"not a picture"), "view_0001.png")
refused("cut picture", lambda f: (f / "view_0001.png").write_bytes((f / "view_0001.png").read_bytes()[:80]), "view_0001.png")
refused("wrong count", text_of(lambda t: t.replace("columns = 2", "columns = 3")), "columns")
refused("no columns", text_of(lambda t: t.replace("columns = 2", "columns = 0")), "columns")
refused("huge count", text_of(lambda t: t.replace("columns = 2", "columns = 2000000000")), "columns")
refused("unknown key", text_of(lambda t: t + "colums = 2\n"), "colums")
refused("no toml", text_of(lambda t: "columns = [\n"), "views.toml")
refused("depth maps of codes", text_of(lambda t: t + 'depth_pictures = "view_*.png"\n'), "view_0000.png", "give a depth map of numbers")
refused("absurd baseline", lambda f: None, "baseline", arguments="--baseline-mm 1e12")
refused("no baseline", lambda f: None, "baseline", arguments="--baseline-mm 0")
refused("no number", lambda f: None, "--focus-depth-mm", arguments="--focus-depth-mm nan")
_, _, err = eia("--views good --focus-width-mm 2")
checks.that("more than half of the panel is black" in err, f"nothing is said of views that the display does not show: {err!r}")
shutil.copytree(hci, folder / "wide")
(folder / "wide/parameters.cfg").write_text((hci / "parameters.cfg").read_text().replace("x_px = 240", "x_px = 480"))
code, _, err = program.run("eia tiny.toml --views wide -o never.png")
checks.that(code == 2 and "input_Cam000.png: is 240 x 160 pixels" in err and "3 times as wide as high" in err, f"shape of HCI 4D: {code} {err!r}")
shutil.copy(folder / "quilt_qs4x2a1.5.npy", folder / "quilt_qs3x2a1.5.npy")
checks.that("80 x 40" in eia("--views quilt_qs3x2a1.5.npy")[2], "views are stretched silently")
shutil.copy(folder / "quilt_qs4x2a1.5.npy", folder / "quilt_qs7x2a1.5.npy")
checks.that("rightmost 2 columns" in eia("--views quilt_qs7x2a1.5.npy")[2], "spare columns are passed over silently")
for name, said in (("quilt_qs300x1a1.5.npy", "fewer than the 300 x 1"), ("quilt_qs0x2a1.5.npy", "0 x 2")):
    shutil.copy(folder / "quilt_qs4x2a1.5.npy", folder / name)
    code, _, err = program.run(f"eia tiny.toml --views {name} -o never.png")
    checks.that(code == 2 and name in err and said in err, f"{name}: {code} {err!r}")
code, _, err = program.run("eia tiny.toml --views absent -o never.png")
checks.that(code == 2 and "absent" in err, f"{err}")
for arguments, said in (("-o quilt.png", "qs8x6a0.75"), ("-o a_qs2x2a1.jpg", "ends in .png, .exr or .npy"), ("-o views.tif", "ends in .png, .exr or .npy"),
                        ("-o tiny.toml/views", "tiny.toml is not a folder"), ("--grid 3x3 -o a_qs2x2a1.png", "--grid"), ("--grid 0x3 -o f", "--grid"), ("--grid 200x200 -o f", "16384"),
                        ("-o good", "give another folder, or --replace"), ("--of display --depth -o f", "--depth"), ("--pattern white -o f", "--of display"),
                        ("--view-size 1000000x1000000 -o f", "--view-size"), ("--of mirror -o f", "--of")):
    before = program.files()
    code, _, err = program.run(f"views tiny.toml --model pyramid.obj {arguments}")
    checks.that(code == 2 and said in err, f"{arguments}: {code} {err!r}")
    checks.that(program.files() == before, f"{arguments}: files changed")

# A signal ends it; what is there is no grid, since views.toml is written last.
process = program.start("views tiny.toml --model pyramid.obj --grid 40x40 --view-size 640x480 --samples 64 -o stopped --threads 1")
deadline = time.monotonic() + 30
while not (folder / "stopped/view_0000.png").exists() and time.monotonic() < deadline:
    time.sleep(0.02)
process.send_signal(signal.SIGINT)
code = process.wait(timeout=30)
checks.that(code == 130 and not (folder / "stopped/views.toml").exists(), f"interrupted: exit code {code}")
checks.finish()
