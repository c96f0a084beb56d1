#!/usr/bin/env python3
"""What the traced pick-up must gain, through the program as users run it. Usage: check.py LFDSIM

- before desktop-asphere the SSIM of views from 10, 15 and 18 degrees, the mean of both sides, rises over the nodal pick-up's by 0.015 at least;
- under a thick dispersing glass dots come twice as close to where they should be, and their colours three times as close together;
- content made for an array that is shifted and turned shows as well as before one that is not, within 0.01 of SSIM."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = sys.argv[1]
SIZE = "960x540"
POINTS = ("--estimator", "point", "--samples", "256")  # so that differences of SSIM are the displays', within 0.001
failed = []


def run(*command):
    return subprocess.run([PROGRAM, *map(str, command)], check=True, capture_output=True, text=True).stdout


def expect(true, what):
    print(("ok      " if true else "FAILED  ") + what, flush=True)
    if not true:
        failed.append(what)


def ssim(folder, display, panel, angle, *settings):
    camera = f"{2000 * np.sin(np.radians(angle))},0,{2000 * np.cos(np.radians(angle))}"
    view, photo = folder / "view.npy", folder / "photo.npy"
    run("render", display, *settings, *POINTS, "--panel-image", panel, "--camera-mm", camera, "--size", SIZE, "-o", view)
    run("photo", display, *settings, "--camera-mm", camera, "--size", SIZE, "-o", photo)
    return json.loads(run("compare", view, photo, "--json"))["ssim"]


def sharper(folder):
    display = SOURCE / "displays/desktop-asphere.toml"
    panels = {pickup: folder / f"{pickup}.exr" for pickup in ("nodal", "traced")}
    for pickup, panel in panels.items():
        run("eia", display, "--pickup", pickup, "-o", panel)
    goal = 0.015
    for angle in (10, 15, 18):
        nodal, traced = (np.array([ssim(folder, display, panels[p], a) for a in (-angle, angle)]) for p in ("nodal", "traced"))
        gains = traced - nodal
        expect(gains.mean() > goal and gains.min() > 0,
               f"desktop-asphere, {angle} deg left, right: SSIM {nodal.round(4)} nodal, {traced.round(4)} traced: +{gains.mean():.4f}; goal +{goal}")


def under_glass():
    out = subprocess.run([sys.executable, str(pathlib.Path(__file__).with_name("dots.py")), PROGRAM,
                          str(SOURCE / "displays/desktop-stopped.toml"), "--angles", "15", "--set",
                          "panel.layer=[{thickness_mm=15, glass={nd=1.6,vd=20}}]", "--set", "lens.stop_radius_mm=0.6"],
                         check=True, capture_output=True, text=True).stdout
    print(out, end="")
    (off, colours), (off_traced, colours_traced) = (
        [float(x) for x in re.search(r"off by ([\d.]+).*apart by ([\d.]+)", line).groups()] for line in out.splitlines())
    expect(2 * off_traced < off, f"dots under glass: {off} mm off nodal, {off_traced} mm traced")
    expect(3 * colours_traced < colours, f"their colours: {colours} mm apart nodal, {colours_traced} mm traced")


def askew(folder):
    moved = ("--set", "array.offset_mm=[1.7, -2.9]", "--set", "array.rotation_deg=1.5")
    for pickup, name in (("nodal", "desktop-ideal"), ("traced", "desktop-asphere")):
        display = SOURCE / f"displays/{name}.toml"
        straight, made_for_it = folder / "straight.exr", folder / "askew.exr"
        run("eia", display, "--pickup", pickup, "-o", straight)
        run("eia", display, "--pickup", pickup, *moved, "-o", made_for_it)
        for angle in (0, 10):
            before = ssim(folder, display, straight, angle)
            uncorrected, corrected = (ssim(folder, display, panel, angle, *moved) for panel in (straight, made_for_it))
            expect(abs(before - corrected) < 0.01 and uncorrected < before - 0.02,
                   f"{name} askew, {pickup}, {angle} deg: SSIM {before:.4f} straight, {uncorrected:.4f} uncorrected, {corrected:.4f} corrected")


with tempfile.TemporaryDirectory() as name:
    sharper(pathlib.Path(name))
    under_glass()
    askew(pathlib.Path(name))
sys.exit(bool(failed))
