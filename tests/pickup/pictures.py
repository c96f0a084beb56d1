#!/usr/bin/env python3
"""What a display shows of its content by each pick-up from several angles, and how it differs from the reference photograph.

Usage: pictures.py LFDSIM DISPLAY.toml -o SHEET.jpg [--angles 0,10,18] [--size 640x360] [--set KEY=VALUE ...]

The sheet has a row for each angle: the photograph, then for each pick-up the view and its difference from the photograph (grey: none).
Prints the SSIM of each view, of the whole frame and of the part where the photograph shows something."""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy as np
from PIL import Image

PICKUPS = ("nodal", "traced", "integrated")


def srgb(light):
    light = np.clip(light, 0, 1)
    return np.where(light < 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("display")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--angles", default="0,10,18")
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--distance-mm", type=float, default=2000)
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    settings = sum((["--set", s] for s in arguments.set), []) + ["--size", arguments.size]

    def run(*command):
        return subprocess.run([arguments.program, *command], check=True, capture_output=True, text=True).stdout

    rows = []
    with tempfile.TemporaryDirectory() as folder:
        panels = {}
        for pickup in PICKUPS:
            panels[pickup] = f"{folder}/{pickup}.exr"
            run("eia", arguments.display, *settings[:-2], "--pickup", pickup, "-o", panels[pickup])
        for angle in map(float, arguments.angles.split(",")):
            radians = np.radians(angle)
            camera = f"{arguments.distance_mm * np.sin(radians)},0,{arguments.distance_mm * np.cos(radians)}"
            photo = f"{folder}/photo.npy"
            run("photo", arguments.display, *settings, "--camera-mm", camera, "-o", photo)
            truth = np.load(photo)
            shown = truth.max(2) > 0
            lines, columns = np.flatnonzero(shown.any(1)), np.flatnonzero(shown.any(0))
            crop = f"{columns[0]},{lines[0]},{columns[-1] + 1},{lines[-1] + 1}"
            row = [srgb(truth)]
            for pickup in PICKUPS:
                view = f"{folder}/view.npy"
                run("render", arguments.display, *settings, "--panel-image", panels[pickup], "--camera-mm", camera, "-o", view)
                whole = json.loads(run("compare", view, photo, "--json"))["ssim"]
                part = json.loads(run("compare", view, photo, "--crop", crop, "--json"))["ssim"]
                print(f"{pathlib.Path(arguments.display).stem:20s} {angle:5g} deg  {pickup:10s}  SSIM {whole:.4f}, of the content {part:.4f}",
                      flush=True)
                light = srgb(np.load(view))
                row += [light, 0.5 + 0.5 * (light - row[0])]
            rows.append(np.concatenate(row, 1))
    Image.fromarray(np.round(255 * np.clip(np.concatenate(rows, 0), 0, 1)).astype(np.uint8)).save(arguments.output, quality=85)


if __name__ == "__main__":
    main()
