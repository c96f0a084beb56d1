"""The same picture, bit for bit: on every kernel and number of threads, in every crop, by every way to the panel's light."""
import json

import numpy as np

from program import Checks, Program

program, checks = Program(), Checks()


def picture(name, arguments, **options):
    program.must(f"render tiny.toml -o {name}.npy {arguments}", **options)
    return np.load(program.folder / f"{name}.npy")


def same(a, b, what):
    checks.that(a.shape == b.shape and a.tobytes() == b.tobytes(), f"{what}: {np.count_nonzero(a != b) if a.shape == b.shape else 'shapes'} differ")


shown = "--panel-image panel.png --camera-mm 60,-30,390"
wanted = picture("wanted", f"{shown} --threads 1 --kernel scalar")
checks.that(wanted.dtype == np.float32 and wanted.shape == (54, 96, 3) and wanted.std() > 0.01, "the picture shows something")
kernels = [k.split()[0] for k in json.loads(program.must("doctor --json"))["kernels"]]
checks.that({"scalar", "baseline"} <= set(kernels), f"kernels: {kernels}")
for kernel in kernels:
    for threads in [1, 2, 5]:
        same(picture("got", f"{shown} --threads {threads} --kernel {kernel}"), wanted, f"{kernel}, {threads} threads")
    same(picture("got", shown, env={"LFDSIM_KERNEL": kernel}), wanted, f"LFDSIM_KERNEL={kernel}")
for x0, y0, x1, y1 in [(0, 0, 96, 54), (0, 0, 1, 1), (95, 53, 96, 54), (13, 7, 62, 40), (64, 16, 65, 17)]:
    same(picture("got", f"{shown} --crop {x0},{y0},{x1},{y1}"), wanted[y0:y1, x0:x1], f"crop {x0},{y0},{x1},{y1}")
same(picture("got", f"{shown} --seed 0"), wanted, "seed 0, the default")
# An exposure is that of the whole picture, in its parts too; a target error is that of the picture with its exposure.
exposed = picture("exposed", f"{shown} --exposure auto")
checks.that((exposed != wanted).any(), "--exposure auto changes nothing")
same(picture("got", f"{shown} --exposure auto --crop 0,0,30,9"), exposed[:9, :30], "exposure of a crop")
SPREAD = "--set diffuser.angle_deg=[3,3] --estimator point --target-error"
made = [json.loads(program.must(f"render tiny.toml -o got.npy {shown} {SPREAD} {options} --json"))
        for options in ("0.01", "0.02 --exposure 2", "0.02")]
checks.that(made[0]["samples"] == made[1]["samples"] > made[2]["samples"], f"samples for a target error: {[m['samples'] for m in made]}")
checks.that(abs(made[1]["error_rms"] / (2 * made[0]["error_rms"]) - 1) < 1e-5, "the error of an exposed picture")
# Lenses of triangles: points, near those of the true surfaces, and the same on all threads.
fine = picture("fine", f"{shown} --lens-mesh 100000 --lens-normals smooth --threads 1")
same(picture("got", f"{shown} --lens-mesh 100000 --lens-normals smooth --threads 2"), fine, "triangles, 2 threads")
points = picture("points", f"{shown} --estimator point")
checks.that(np.sqrt(np.mean((fine - points) ** 2)) < 0.02, "100000 triangles are not near the true lens")
said = json.loads(program.must(f"render tiny.toml -o said.png {shown} --lens-mesh 860 --json"))
checks.that(said["estimator"] == "point" and abs(said["lens_mesh"]["triangles"] - 860) < 86, f"lens mesh: {said}")
# The filtered estimator may do without random numbers.
by_points = [picture("got", f"{shown} --estimator point --seed {seed}") for seed in (0, 1)]
checks.that((by_points[0] != by_points[1]).any(), "another seed gives the same picture")

# Straight from the model or the pattern, and by way of a file: the panel shows 8-bit codes either way.
for way in ["--model pyramid.obj --yaw-deg 20", "--pattern edge"]:
    program.must(f"eia tiny.toml {way} -o eia.png")
    straight = picture("straight", way)
    checks.that(straight.max() > 0.05, f"{way}: the picture is dark")
    same(straight, picture("by_file", "--panel-image eia.png"), way)

# The model of the description is as good as the option's.
program.must("eia tiny.toml --set content.model=pyramid.obj -o described.npy")
program.must("eia tiny.toml --model pyramid.obj -o given.npy")
same(np.load(program.folder / "described.npy"), np.load(program.folder / "given.npy"), "content.model")
checks.finish()
