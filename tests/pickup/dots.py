#!/usr/bin/env python3
"""Dots on a plane in front of a display: where an eye sees them, against the reference photograph, by pick-up and colour.

Usage: dots.py LFDSIM [DISPLAY.toml] [--angles 0,10,15,18] [--set KEY=VALUE ...]

Prints for each angle and pick-up: how far the dots' images lie from where they should be, by where their light is densest, as the root
of the mean square and at most, and by the centroid of all light in a dot's square; and the residual between colours: red's and blue's
densest places less green's. Lengths in mm at the dots."""
import argparse
import pathlib
import subprocess
import tempfile
import tomllib

import numpy as np
from PIL import Image

SOURCE = pathlib.Path(__file__).resolve().parents[2]
WIDTH_MM, SPACING_MM, SIGMA_MM = 180.0, 30.0, 4.0  # of the plane, of the dots, of a dot
TEXEL_MM = 0.25


def dots():
    """A plane of soft white dots on black, their places in mm from its middle."""
    n = int(WIDTH_MM / TEXEL_MM)
    axis = (np.arange(n) + 0.5) * TEXEL_MM - WIDTH_MM / 2
    places = np.arange(-2, 3) * SPACING_MM
    line = np.exp(-0.5 * ((axis[:, None] - places) / SIGMA_MM) ** 2).sum(1)
    light = np.outer(line, line)
    srgb = np.where(light < 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return Image.fromarray(np.round(255 * np.repeat(srgb[..., None], 3, 2)).astype(np.uint8)), places


def centre(light, x, y, window):
    """Where a dot's light is densest, pixels: mean shifts from (x, y) with a window about as wide as the dot."""
    rows, columns = np.mgrid[: light.shape[0], : light.shape[1]]
    for _ in range(100):
        off = 1 - ((columns - x) ** 2 + (rows - y) ** 2) / window**2
        weight = np.where(off > 0, off, 0) ** 2 * light
        if weight.sum() <= 0:
            return np.nan, np.nan
        nx, ny = (weight * columns).sum() / weight.sum(), (weight * rows).sum() / weight.sum()
        if abs(nx - x) + abs(ny - y) < 1e-4:
            break
        x, y = nx, ny
    return x, y


def centroid(light, x, y, half):
    """Of the light within half of a dot's square of (x, y), pixels."""
    rows, columns = np.mgrid[: light.shape[0], : light.shape[1]]
    weight = light * (np.abs(columns - x) <= half) * (np.abs(rows - y) <= half)
    return np.array([(weight * columns).sum(), (weight * rows).sum()]) / weight.sum() if weight.sum() > 0 else np.full(2, np.nan)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("display", nargs="?", default=str(SOURCE / "displays/desktop-asphere.toml"))
    parser.add_argument("--angles", default="0,10,15,18")
    parser.add_argument("--pickups", default="nodal,traced")
    parser.add_argument("--distance-mm", type=float, default=2000)
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    with open(arguments.display, "rb") as file:
        depth_mm = tomllib.load(file)["content"]["depth_mm"]
    image, places = dots()
    with tempfile.TemporaryDirectory() as folder:
        image.save(f"{folder}/dots.png")
        plane = f'content.object=[{{image="{folder}/dots.png", width_mm={WIDTH_MM}}}]'
        settings = sum((["--set", s] for s in [plane, "content.height_mm=none", *arguments.set]), [])
        size, frame = (960, 540), 270.0  # mm wide, in the plane through the target
        pixel_mm = frame / size[0]

        def run(command, out, angle, *more):
            sine, cosine = np.sin(np.radians(angle)), np.cos(np.radians(angle))
            camera = f"{arguments.distance_mm * sine},0,{arguments.distance_mm * cosine}"
            subprocess.run([arguments.program, command, arguments.display, *settings, "--camera-mm", camera, "--target-mm",
                            f"0,0,{depth_mm}", "--frame-width-mm", str(frame), "--size", "x".join(map(str, size)), "-o", out, *more],
                           check=True, capture_output=True)
            return np.load(out).astype(float)

        for angle in map(float, arguments.angles.split(",")):
            truth = run("photo", f"{folder}/p.npy", angle)
            pixel = pixel_mm
            # A dot is found in the photograph from its neighbourhood, then in the views from there.
            peaks = []
            light = truth[..., 1]
            for py in places:
                for px in places:
                    x = size[0] / 2 - 0.5 + px * np.cos(np.radians(angle)) / pixel
                    y = size[1] / 2 - 0.5 - py / pixel
                    x, y = centre(light, x, y, 3 * SIGMA_MM / pixel)
                    if np.isfinite(x) and 20 < x < size[0] - 20 and 20 < y < size[1] - 20:
                        peaks.append((x, y))
            for pickup in arguments.pickups.split(","):
                view = run("render", f"{folder}/r.npy", angle, "--pickup", pickup)
                off = np.array([[np.subtract(centre(view[..., c], *p, 3 * SIGMA_MM / pixel), p) for c in range(3)] for p in peaks])
                off *= pixel
                green = off[:, 1]
                half = SPACING_MM * np.cos(np.radians(angle)) / pixel / 2
                whole = np.array([centroid(view[..., 1], *p, half) - centroid(light, *p, half) for p in peaks]) * pixel
                colour = np.concatenate([off[:, 0] - green, off[:, 2] - green])
                rms = lambda v: float(np.sqrt((v**2).sum(1).mean()))
                print(f"{angle:5g} deg  {pickup:10s}  {len(peaks)} dots off by {rms(green):.2f} mm rms, {np.hypot(*green.T).max():.2f} mm at most, "
                      f"{rms(whole):.2f} mm by the centroid; colours apart by {rms(colour):.3f} mm rms", flush=True)


if __name__ == "__main__":
    main()
