"""Grids of views and quilts: what is written reads back, by a second program's arithmetic where there is one; bad ones are refused."""
import json
import shutil
import signal
import struct
import time

import numpy as np

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
QUIET = "--progress none"
# A focus before the pyramid's middle, cameras around the viewer at 400 mm.
GRID = "--focus-width-mm 48 --focus-depth-mm 18 --camera-distance-mm 360 --baseline-mm 14,12"


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
lit = direct.max(2) > 0
print(f"elemental images of 3 x 3 views against the model's: mean difference {np.abs(deep - direct).mean():.4f} by depth, "
      f"{np.abs(flat - direct).mean():.4f} without, of {direct.mean():.4f}")
checks.that(np.abs(deep - direct).mean() < 0.5 * np.abs(flat - direct).mean(), "depth maps do not help")
checks.that(direct.mean() > 0.01, "the model is not seen")

# A quilt has the same views, counted from the lower left; its elemental images are those of the row, bit for bit.
ROW = "--focus-width-mm 48 --focus-depth-mm 18 --camera-distance-mm 360 --view-cone-deg 20"
views(f"--grid 8x1 --view-size 60x40 {ROW} --views-as npy -o row")
views(f"--view-size 60x40 {ROW} -o quilt_qs4x2a1.5.npy")
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
# Without the file beside it the name must do, and what is assumed is said.
shutil.copy(folder / "quilt_qs4x2a1.5.npy", folder / "bare_qs4x2a1.5.npy")
_, said, err = eia("--views bare_qs4x2a1.5.npy")
checks.that("40 degrees" in err and "viewing distance" in err, f"assumed silently: {err}")

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
SPHERES = "--grid 3x3 --view-size 240x160 --focus-width-mm 48 --focus-depth-mm 20 --camera-distance-mm 360 --baseline-mm 14"
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
baseline_mm = 140.0
focus_distance_m = 3.6
""")
assert abs(10 / 75 * 3600 - 480) < 1e-9  # mm, the width at the focus
HCI = "--focus-width-mm 48 --focus-depth-mm 20"
of_hci, said, _ = eia(f"--views hci {HCI}")
checks.that(said["views"]["form"] == "HCI 4D" and abs(said["views"]["camera_distance_mm"] - 360) < 1e-9, f"{said}")
checks.that(same(of_hci, eia("--views spheres_png")[0]), "HCI 4D differs from the same views numbered")
depth = np.load(folder / "spheres/depth_0004.npy")[..., 0]
disparity = np.where(depth > 0, 14 * (240 / 48) * (360 / np.maximum(depth, 1) - 1), -60).astype("<f4")


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
errors = [float(np.abs(made - truth).mean()) for made in (by_metres, of_hci)]
print(f"HCI 4D of spheres: mean difference from the model's {errors[0]:.4f} by depth, {errors[1]:.4f} without, of {truth.mean():.4f}")
checks.that(errors[0] < 0.75 * errors[1], "HCI's depth map does not help")
for k in range(9):
    shutil.copy(folder / f"spheres_png/view_000{8 - k}.png", hci / f"input_Cam00{k}.png")
_, _, err = eia(f"--views hci {HCI}")
checks.that("pseudoscopic" in err and "--flip-views" in err, f"reversed views are not noticed: {err}")
_, _, err = eia(f"--views hci {HCI} --flip-views")
checks.that("pseudoscopic" not in err, f"views in order are doubted: {err}")

# Of the display: the picture of a camera that looks straight at it, twice as fine, averaged over each pixel; aside by shares of pixels.
program.must(f"eia tiny.toml --model pyramid.obj -o shown.npy {QUIET}")
program.must(f"views tiny.toml --of display --panel-image shown.npy --grid 3x1 --view-size 60x40 --focus-width-mm 45 --focus-depth-mm 18 "
             f"--camera-distance-mm 360 --baseline-mm 31.7 --views-as npy -o of_display {QUIET}")
plane = float(json.loads(program.must("check tiny.toml --json"))["geometry"]["vertex_plane_mm"]) if False else None
for k, aside in enumerate([-31.7, 0, 31.7]):
    pixel = 45 / 60 / 2
    half, half_rows = int(np.ceil(round((abs(aside) + 22.5) / pixel, 9))), int(np.ceil(round(15 / pixel, 9)))
    z = 18 + VERTEX if (VERTEX := 5.0) is None else None
    break
checks.finish()
