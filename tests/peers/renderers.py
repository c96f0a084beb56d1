#!/usr/bin/python3
"""What `lfdsim export` writes for a renderer, rendered by it, against lfdsim's own picture: renderers.py LFDSIM cycles|mitsuba.

Meshed lenses are not the true ones, and both renderers count in single precision: pictures are alike, not equal. Each display is seen obliquely, so that
a picture that is turned, mirrored or shifted by a pixel fails. Skipped where the renderer is not installed.
"""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

PROGRAM, PEER = os.path.abspath(sys.argv[1]), sys.argv[2]
sys.argv[1:] = [PROGRAM]
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from program import TINY  # noqa: E402
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "bench/peers"))
import programs  # noqa: E402

SHARP = ["--set", "diffuser=none"]
# Name, options, least SSIM, greatest RMSE in linear light. 0.01 of RMSE is one pixel in 10 000 that is black for white.
CASES = [
    ("opaque", SHARP, 0.99, 0.03),
    ("clear", [*SHARP, "array.surround=\"clear\""], 0.99, 0.03),
    ("plate, turned", [*SHARP, "array.surround=\"plate\"", "array.rotation_deg=7.0", "array.offset_mm=[0.6,-0.4]"], 0.99, 0.03),
    ("opaque, filled cells", [*SHARP, "array.aperture=\"cell\"", "lens.sphere_radius_mm=3.2"], 0.99, 0.03),
    ("hexagons, filled, over a layer", [*SHARP, "array.lattice=\"hexagon\"", "array.count=[10,7]", "array.aperture=\"cell\"", "lens.sphere_radius_mm=3.2",
                                        "panel.layer=[{thickness_mm=1.1,index=1.52}]"], 0.99, 0.03),
    ("bricks, plate glued on, turned", [*SHARP, "array.lattice=\"brick\"", "array.surround=\"plate\"", "array.rotation_deg=7.0", "array.gap_mm=none",
                                        "array.base_z_mm=3.5", "panel.layer=[{thickness_mm=1.5,index=1.52},{thickness_mm=2.0,index=1.6}]"], 0.99, 0.03),
    ("slanted strips, clear", [*SHARP, "array.lattice=\"strips\"", "array.slant_deg=9.0", "array.count=none", "array.surround=\"clear\""], 0.99, 0.03),
    ("clear, glued on", [*SHARP, "array.surround=\"clear\"", "array.gap_mm=none", "array.base_z_mm=3.5", "panel.layer=[{thickness_mm=3.5,index=1.52}]"], 0.99, 0.03),
    ("wedge, over a layer, turned", [*SHARP, "array.surround=\"plate\"", "array.rotation_deg=7.0", "errors.wedge_deg=[1.5,-2.0]", "panel.layer=[{thickness_mm=1.1,index=1.52}]"], 0.99, 0.03),
    ("wedge, opaque", [*SHARP, "errors.wedge_deg=[-2.0,1.0]", "errors.gap_mm=0.3"], 0.99, 0.03),
    ("panel of exponent 3", [*SHARP, "panel.emission_exponent=3.0"], 0.99, 0.0005),
    ("pixels as squares", [*SHARP, "camera.pixel_filter=\"box\"", "render.samples=256"], 0.99, 0.02),
    ("diffuser", ["--set", "render.samples=256"], 0.97, 0.04),
]
if PEER == "mitsuba":
    CASES += [
        ("Schlick's weights", [*SHARP, "render.fresnel=\"schlick\""], 0.99, 0.0005),
        ("gaussian diffuser", ["--set", "diffuser.profile=\"gaussian\"", "render.samples=1024"], 0.98, 0.02),
    ]


def found():
    if PEER == "cycles":
        return shutil.which("blender"), "the program blender is not installed (Debian: blender)"
    python = programs.working_mitsuba()
    return python is not None and shutil.which("python3") in (shutil.which(python), python), \
        "python3 has no module mitsuba whose variant llvm_ad_rgb makes a picture (PyPI: mitsuba; LLVM's library)"


def run(command, folder):
    done = subprocess.run(command, cwd=folder, env={**os.environ, "PWD": str(folder)}, capture_output=True, text=True, timeout=600)  # Blender goes by PWD
    assert done.returncode == 0, f"{shlex.join(command)}: {done.stdout[-1500:]}{done.stderr[-1500:]}"
    return done.stdout


def main():
    there, why = found()
    if not there:
        print("SKIPPED:", why)
        sys.exit(77)
    wrong = 0
    for name, options, least, most in CASES:
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            (folder / "tiny.toml").write_text(TINY)
            told = json.loads(run([PROGRAM, "export", PEER, "tiny.toml", "--pattern", "checkerboard", "--cell-pixels", "3", "--camera-mm", "60,35,390",
                                   "--triangles", "8000", "--normals", "smooth", "--json", "-o", "scene", *options], folder))
            run(shlex.split(told["command"]), folder / "scene")
            run(shlex.split(told["lfdsim"].replace("lfdsim", PROGRAM, 1)), folder / "scene")
            run([PROGRAM, "render", "display.toml", "--panel-image", told["files"][0], "--camera-mm=-60,-35,390", "-o", "mirrored.exr"], folder / "scene")
            other = json.loads(run([PROGRAM, "compare", "mirrored.exr", told["picture"], "--json"], folder / "scene"))
            alike = json.loads(run([PROGRAM, "compare", "lfdsim.exr", told["picture"], "--json"], folder / "scene"))
        good = alike["ssim"] >= least and alike["rmse"] <= most and other["rmse"] > 2 * most
        wrong += not good
        print(f"{'pass' if good else 'FAIL'} {name}: SSIM {alike['ssim']:.4f}, RMSE {alike['rmse']:.4f}; seen from the other side RMSE {other['rmse']:.4f}", flush=True)
    sys.exit(1 if wrong else 0)


main()
