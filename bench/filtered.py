#!/usr/bin/python3
"""The filtered estimator's error on displays of many kinds: RMSE and brightness against 4096 point samples of another seed.

bench/filtered.py [--estimator filtered|lens_by_lens] [--cases NAME ...] [--samples N ...] [--panel checker|white ...] PROGRAM ...
bench/filtered.py --default [--cases NAME ...] PROGRAM: default pictures and 36 points, with their time and samples; crops of 512 x 512 pixels.
bench/filtered.py --cost [--cases NAME ...] PROGRAM: cost in point samples a pixel, by time, and RMSE in units of 0.0001, of pictures with a given number of
samples, and of as many points in brackets; crops of 256 x 256 pixels.

Several programs are compared. Crops of 96 x 54 pixels about the middle of the frame; linear light. A case takes a few seconds."""
import argparse
import json
import pathlib
import subprocess
import tempfile
import tomllib

import numpy as np

DISPLAYS = pathlib.Path(__file__).parent.parent / "displays"
WHOLE = ["panel.subpixels=none", "panel.aperture_ratio=1"]
PINHOLE = WHOLE + ["camera.pixel_filter=center", "camera.pupil_diameter_mm=none"]
OBLIQUE = "camera.position_mm=[728,0,2000]"
WEAK = ["diffuser.distance_mm=26", "diffuser.angle_deg=[2.2,2.2]"]
CASES = {  # display, changes
    "wide": ("desktop-asphere", []),
    "wide, 20 degrees": ("desktop-asphere", [OBLIQUE]),
    "wide, 960 across": ("desktop-asphere", ["camera.resolution=[960,540]"]),
    "coarse": ("desktop-asphere", ["camera.resolution=[480,270]"]),
    "spheres": ("desktop-spherical", []),
    "doublet": ("desktop-doublet", []),
    "stop": ("desktop-stopped", []),
    "clear": ("desktop-clear", []),
    "plate": ("desktop-plate", []),
    "d45": ("desktop-asphere", WEAK),
    "d45, 20 degrees": ("desktop-asphere", WEAK + [OBLIQUE]),
    "weak": ("desktop-asphere-weak-diffuser", []),
    "hexagons": ("hexagon", PINHOLE + ["diffuser.angle_deg=[3,3]", "diffuser.distance_mm=1"]),
    "hexagons, wide": ("hexagon", PINHOLE + ["diffuser.angle_deg=[5,5]", "diffuser.distance_mm=10"]),
    "hexagons, eye": ("hexagon", WHOLE),
    "hexagons, eye, 20 degrees": ("hexagon", WHOLE + ["camera.position_mm=[255,0,700]"]),
    "hexagons, stripes": ("hexagon", []),
    "lenticular": ("tablet-lenticular", WHOLE),
    "lenticular, 20 degrees": ("tablet-lenticular", WHOLE + ["camera.position_mm=[164,0,450]"]),
    "lenticular, stripes": ("tablet-lenticular", []),
    "barrier": ("barrier", WHOLE),
    "barrier, rows": ("barrier", []),
}


def panel(kind, columns, rows):
    """Squares of 3 pixels in red, of 22 in green, their mixture in blue; or white."""
    light = np.ones((rows, columns, 3), np.float32)
    if kind == "checker":
        y, x = np.mgrid[:rows, :columns]
        fine, large = (x // 3 + y // 3) & 1, (x // 22 + y // 22) & 1
        light[...] = np.stack([fine, large, np.where(fine != large, 0.9, 0.1)], -1)
    return light


def picture(program, folder, case, shown, estimator, samples, seed, size=(96, 54)):
    """The middle of the frame, and what `render --json` says of it; samples 0: the default."""
    display, changes = CASES[case]
    frame = next((json.loads(c.split("=")[1]) for c in changes if c.startswith("camera.resolution=")),
                 tomllib.loads((DISPLAYS / f"{display}.toml").read_text())["camera"]["resolution"])
    (x, y), (width, height) = [(whole - min(whole, part)) // 2 for whole, part in zip(frame, size)], [min(*pair) for pair in zip(frame, size)]
    out = folder / "picture.npy"
    command = [program, "render", DISPLAYS / f"{display}.toml", "--panel-image", shown, "--crop", f"{x},{y},{x + width},{y + height}", "--estimator", estimator,
               *(["--samples", str(samples)] if samples else []), "--seed", str(seed), "--device", "cpu", "--threads", "1", "--progress", "none", "--json", "-o", out]
    done = subprocess.run(command + (["--set", *changes] if changes else []), check=True, stdout=subprocess.PIPE)
    return np.load(out).astype(np.float64), json.loads(done.stdout)


def rmse(a, b):
    return np.sqrt(np.mean((a - b)**2))


def defaults(program, folder, case, shown):
    """A row of the table of default pictures."""
    truth = picture(program, folder, case, shown, "point", 1024, 77, (512, 512))[0]
    row = []
    for estimator, samples in (("filtered", 0), ("point", 36)):
        light, made = picture(program, folder, case, shown, estimator, samples, 1, (512, 512))
        row += [f"{rmse(light, truth):.4f}", f"{1e9 * made['seconds'] / (light.size / 3):.0f}"]
        if not samples:
            row += [f"{made['samples'] / (light.size / 3):.1f}", f"{100 * made['points_share']:.0f} %", f"{made['measured_error']:.4f}"]
    return " | ".join([case, *row])


def costs(program, folder, case, shown, kind, numbers):
    """A row of the table of costs."""
    size = (256, 256)
    truth = picture(program, folder, case, shown, "point", 8192, 77, size)[0]
    a_point = picture(program, folder, case, shown, "point", 100, 5, size)[1]["seconds"] / 100
    row = []
    for samples in numbers:
        light, made = picture(program, folder, case, shown, "filtered", samples, 1, size)
        points = picture(program, folder, case, shown, "point", samples, 1, size)[0]
        row.append(f"{made['seconds'] / a_point:.0f}, {1e4 * rmse(light, truth):.0f} ({1e4 * rmse(points, truth):.0f})")
    return " | ".join([case, kind, *row])


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--estimator", choices=["filtered", "lens_by_lens"], default="filtered")
    options.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES), metavar="NAME")
    options.add_argument("--samples", nargs="+", type=int, help="default: 1 4 16; with --cost 1 4 9 16 36 100 1024")
    options.add_argument("--panel", nargs="+", choices=["checker", "white"], default=["checker"])
    options.add_argument("--default", action="store_true")
    options.add_argument("--cost", action="store_true")
    options.add_argument("program", nargs="+", metavar="PROGRAM")
    given = options.parse_args()
    given.samples = given.samples or ([1, 4, 9, 16, 36, 100, 1024] if given.cost else [1, 4, 16])
    if given.default:
        print("| display | RMSE | ns a pixel | samples a pixel | by points | measured error | RMSE of 36 points | ns a pixel |\n|---|---|---|---|---|---|---|---|")
    else:  # with --cost one program is measured
        print("| display | panel | " + " | ".join(f"{p}, {n}" for p in given.program for n in given.samples) + " |")
        print("|---" * (2 + len(given.program) * len(given.samples)) + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for case in given.cases:
            for kind in given.panel:
                columns, rows = tomllib.loads((DISPLAYS / f"{CASES[case][0]}.toml").read_text())["panel"]["pixels"]
                shown = folder / "panel.npy"
                np.save(shown, panel(kind, columns, rows))
                if given.cost:
                    print(f"| {costs(given.program[0], folder, case, shown, kind, given.samples)} |", flush=True)
                    continue
                if given.default:
                    print(f"| {defaults(given.program[0], folder, case, shown)} |", flush=True)
                    continue
                truth = picture(given.program[0], folder, case, shown, "point", 4096, 77)[0]
                errors = []
                for program in given.program:
                    for samples in given.samples:
                        error = picture(program, folder, case, shown, given.estimator, samples, 1)[0] - truth
                        errors.append(f"{rmse(error, 0):.4f}, {100 * error.mean() / truth.mean():+.2f} %")
                print(f"| {case} | {kind} | " + " | ".join(errors) + " |", flush=True)


if __name__ == "__main__":
    main()
