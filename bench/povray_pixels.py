#!/usr/bin/python3
"""The tables of docs/peers.md: lfdsim against POV-Ray on displays of displays/, pixel by pixel. povray_pixels.py LFDSIM [--size WxH] [--meshes]

Needs povray. Panel: addresses, linear. Away from edges as tests/peers/povray.py judges them. --meshes: how often POV-Ray's rays through meshed lenses meet
the panel pixel that lfdsim's meet through the true ones.
"""
import argparse
import math
import pathlib
import sys
import tempfile
import tomllib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/peers"))
import povray  # noqa: E402
from povray import cases  # noqa: E402


def described(name, degrees, size, surround="opaque", fresnel="exact"):
    a = math.radians(degrees)
    camera = {"position_mm": [2000 * math.sin(a), 0.0, 2000 * math.cos(a)], "resolution": size}
    description = tomllib.loads((ROOT / f"displays/{name}.toml").read_text())
    description.pop("diffuser", None)
    for surface in description["lens"].get("surface", []):
        surface.setdefault("curvature_per_mm", 0.0)
    over = {"panel": {"encoding": "linear"}, "array": {"surround": surround}, "camera": camera, "render": {"fresnel": fresnel}}
    return cases.merge(description, over)


def surrounds(program, size):
    print(f"| display | surround | from | {size[0]} x {size[1]} pixels |\n|---|---|---|---|")
    for name in ("desktop-spherical", "desktop-asphere", "desktop-stopped"):
        for surround in ("opaque", "clear", "plate"):
            for degrees in (0, 15, 30):
                good, found = povray.check(program, name, described(name, degrees, size, surround), [])
                print(f"| {name} | {surround} | {degrees}° | {'' if good else 'FAILED: '}{found} |", flush=True)


def meshes(program, size):
    print("| display | from | triangles | normals | same panel pixel | within one |\n|---|---|---|---|---|---|")
    for name, degrees in (("desktop-spherical", 0), ("desktop-asphere", 15)):
        description = described(name, degrees, size, fresnel="none")
        image = povray.panel_images(*description["panel"]["pixels"])["address"]
        for normals in ("flat", "smooth"):
            for triangles in (860, 3386, 16380):
                with tempfile.TemporaryDirectory() as folder:
                    options = ["--triangles", str(triangles), "--normals", normals]
                    povs, ours = povray.pictures(program, description, image, pathlib.Path(folder), options)
                lit = (povs.max(axis=2) > 0) & (ours.max(axis=2) > 0)
                off = np.abs(povray.address(povs) - povray.address(ours)).max(axis=0)[lit]
                print(f"| {name} | {degrees}° | {triangles} | {normals} | {100 * (off == 0).mean():.1f} % | {100 * (off <= 1).mean():.1f} % |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--size", default="960x540")
    parser.add_argument("--meshes", action="store_true")
    options = parser.parse_args()
    (meshes if options.meshes else surrounds)(str(pathlib.Path(options.program).resolve()), [int(n) for n in options.size.split("x")])


main()
