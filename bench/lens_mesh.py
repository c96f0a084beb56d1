#!/usr/bin/python3
"""The error that lenses of triangles cause in a picture: the table, the plot and the picture of docs/meshed.md, measured now on this machine.

Usage: bench/lens_mesh.py [--program build/release/lfdsim] [--display displays/desktop-asphere.toml] [--quick] [--write] [-o FOLDER]
--quick: small pictures, few triangles. --write: puts the table in place of the section "Measured" of docs/meshed.md, and plot and
picture in docs/images/. Without it they are left in the folder -o.

Which panel pixel a ray meets is read from a panel each of whose pixels shows its own column and row as light (.npy): without diffuser
and without Fresnel's losses each pixel of the view is then the address of one panel pixel. Errors of pictures are those of linear light
against the same samples through the true surfaces.
"""
import argparse
import json
import pathlib
import resource
import struct
import subprocess
import sys
import tempfile
import time
import tomllib
import zlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
MONKEY = pathlib.Path("/usr/share/assimp/models/BLEND/Suzanne_248.blend")
MESHES = [(860, "flat"), (3386, "flat"), (16380, "flat"), (65536, "flat"), (262144, "flat"),
          (860, "smooth"), (3386, "smooth"), (16380, "smooth"), (65536, "smooth")]
SAMPLES = 100


def lfdsim(*words):
    """Runs the program; its JSON, with the processors' seconds for the whole process, which other work on the machine changes little."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([options.program, *map(str, words), "--json", "--progress", "none"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return dict(json.loads(done.stdout), processor_seconds=after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def view(name, *words):
    """A picture by point samples, in linear light, and the program's report."""
    path = folder / f"{name}.npy"
    made = lfdsim("render", options.display, "--estimator", "point", "-o", path, *words)
    return np.load(path).astype(np.float64), made


def meshed(triangles, normals):
    return () if triangles is None else ("--lens-mesh", triangles, "--lens-normals", normals)


def camera(angle):
    distance = 2000.0
    return f"{distance * np.sin(np.radians(angle)):.6f},0,{distance * np.cos(np.radians(angle)):.6f}"


def near_share(truth, found):
    """Of the rays that reach the panel in either picture, the share that end on the same panel pixel in both, or on adjacent ones."""
    lit = (truth[:, :, 2] > 0) | (found[:, :, 2] > 0)
    same = (np.abs(truth - found)[lit] <= 1).all(axis=1) & (truth[lit][:, 2] == found[lit][:, 2])
    return same.mean()


def measure():
    columns, rows = tomllib.loads(pathlib.Path(options.display).read_text())["panel"]["pixels"]
    address = np.ones((rows, columns, 3), np.float32)
    address[:, :, 0], address[:, :, 1] = np.arange(columns), np.arange(rows)[:, None]
    np.save(folder / "address.npy", address)
    model = MONKEY if MONKEY.exists() else "built-in:spheres"
    lfdsim("eia", options.display, "--model", model, "--tilt-deg", -35, "-o", folder / "eia.png")
    rays = ("--panel-image", folder / "address.npy", "--set", "diffuser=none", 'render.fresnel="none"',
            "--size", "480x270" if options.quick else "1920x1080")
    shown = ("--panel-image", folder / "eia.png", "--samples", SAMPLES, "--size", "240x135" if options.quick else "640x360")
    truths = {angle: view("truth", *rays, "--camera-mm", camera(angle))[0] for angle in (0, 15)}
    picture, made = view("picture", *shown)
    result = [{"triangles": None, "normals": "true surfaces", "seconds": made["processor_seconds"]}]
    # The error of 100 other points, for scale
    other = view("other", *shown, "--seed", 1)[0]
    noise = np.sqrt(np.mean((picture - other) ** 2) / 2)
    for triangles, normals in MESHES[:2] + MESHES[5:7] if options.quick else MESHES:
        got, made = view("meshed", *shown, *meshed(triangles, normals))
        row = {"triangles": made["lens_mesh"]["triangles"], "normals": normals, "seconds": made["processor_seconds"],
               "rmse": np.sqrt(np.mean((got - picture) ** 2))}
        for angle, truth in truths.items():
            found = view("rays", *rays, "--camera-mm", camera(angle), *meshed(triangles, normals))[0]
            row[f"near at {angle}"] = near_share(truth, found)
        result.append(row)
        print(row, flush=True)
    return result, noise


def table(result, noise):
    build = lfdsim("bench", "pictures", "--quick")
    lines = [f"`bench/lens_mesh.py` with {pathlib.Path(options.display).stem}: {build['machine']['processor']}, "
             f"{build['machine']['processors']} processors, {build['build']['compiler']}; {time.strftime('%-d %B %Y')}.",
             "", "| triangles a lens | normals | right panel pixel within one, on axis | at 15° | RMSE of the picture | processor seconds |",
             "|---|---|---|---|---|---|"]
    for row in result:
        if row["triangles"] is None:
            lines.append(f"| none: {row['normals']} | | 100 % | 100 % | 0 | {row['seconds']:.2f} |")
        else:
            lines.append(f"| {row['triangles']} | {row['normals']} | {100 * row['near at 0']:.3f} % | {100 * row['near at 15']:.3f} % | "
                         f"{row['rmse']:.5f} | {row['seconds']:.2f} |")
    lines += ["", f"The RMSE falls as N^-q between the least and the most triangles: {orders(result)}. The noise of {SAMPLES} points, which",
              f"all these pictures share, is {noise:.5f}: the RMSE of one against the mean of very many."]
    return "\n".join(lines)


def orders(result):
    text = []
    for normals in ("flat", "smooth"):
        rows = [row for row in result if row["normals"] == normals]
        q = np.log(rows[0]["rmse"] / rows[-1]["rmse"]) / np.log(rows[-1]["triangles"] / rows[0]["triangles"])
        text.append(f"q = {q:.2f} {normals}")
    return ", ".join(text)


def plot(result):
    """Two plots, both axes logarithmic: RMSE, and seconds, against triangles."""
    wide, high, left, top = 300, 220, 64, 30
    rows = [row for row in result if row["triangles"]]
    ends = [np.floor(np.log10(min(row["triangles"] for row in rows))), np.ceil(np.log10(max(row["triangles"] for row in rows)))]
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * (wide + left) + 62}" height="{high + top + 50}" font-family="sans-serif" '
           'font-size="12" fill="#444" stroke-width="1.5">', '<rect width="100%" height="100%" fill="white"/>']
    for frame, (key, title) in enumerate([("rmse", "RMSE of the picture"), ("seconds", "processor seconds")]):
        values = [row[key] for row in result if key in row]
        low, far = np.floor(np.log10(min(values))), np.ceil(np.log10(max(values)))
        x0, y0 = left + frame * (wide + left + 10), top
        x = lambda n: x0 + wide * (np.log10(n) - ends[0]) / (ends[1] - ends[0])
        y = lambda v: y0 + high * (far - np.log10(v)) / (far - low)
        out.append(f'<text x="{x0}" y="{y0 - 10}">{title}</text>')
        for decade in range(int(low), int(far) + 1):
            out.append(f'<path d="M{x0} {y(10.0 ** decade):.1f}h{wide}" stroke="#ddd"/>'
                       f'<text x="{x0 - 6}" y="{y(10.0 ** decade) + 4:.1f}" text-anchor="end">{10.0 ** decade:g}</text>')
        for decade in range(int(ends[0]), int(ends[1]) + 1):
            out.append(f'<path d="M{x(10.0 ** decade):.1f} {y0}v{high}" stroke="#ddd"/>'
                       f'<text x="{x(10.0 ** decade):.1f}" y="{y0 + high + 16}" text-anchor="middle">{10 ** decade}</text>')
        out.append(f'<text x="{x0 + wide / 2}" y="{y0 + high + 36}" text-anchor="middle">triangles a lens</text>')
        for normals, colour in (("flat", "#c44"), ("smooth", "#36c")):
            points = [(x(row["triangles"]), y(row[key])) for row in rows if row["normals"] == normals]
            out.append(f'<polyline fill="none" stroke="{colour}" points="{" ".join(f"{a:.1f},{b:.1f}" for a, b in points)}"/>')
            out += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>' for a, b in points]
            out.append(f'<text x="{points[-1][0] + 6:.1f}" y="{points[-1][1] - 6:.1f}" fill="{colour}" text-anchor="end">{normals}</text>')
        if key == "seconds":
            level = y(result[0]["seconds"])
            out.append(f'<path d="M{x0} {level:.1f}h{wide}" stroke="#484" stroke-dasharray="5 4"/>'
                       f'<text x="{x0 + wide}" y="{level - 5:.1f}" fill="#484" text-anchor="end">true surfaces</text>')
    return "\n".join(out + ["</svg>", ""])


def png(path, light):
    """Linear light in an 8-bit sRGB file."""
    light = np.clip(light, 0, 1)
    code = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    code = np.rint(255 * code).astype(np.uint8)
    rows = np.concatenate([np.zeros((code.shape[0], 1), np.uint8), code.reshape(code.shape[0], -1)], axis=1)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", code.shape[1], code.shape[0], 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def crops():
    """The same part of the picture, side by side: true surfaces, then flat triangles."""
    width, high = 360, 440
    part = f"{960 - width // 2},{540 - high // 2},{960 + width // 2},{540 + high // 2}"
    shown = ("--panel-image", folder / "eia.png", "--samples", SAMPLES, "--size", "1920x1080", "--crop", part)
    gap = np.ones((high, 6, 3))
    parts = []
    for triangles in (None, 860, 3386, 16380):
        parts += [view("crop", *shown, *meshed(triangles, "flat"))[0], gap]
    return np.concatenate(parts[:-1], axis=1)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default=str(ROOT / "build/release/lfdsim"))
parser.add_argument("--display", default=str(ROOT / "displays/desktop-asphere.toml"))
parser.add_argument("--quick", action="store_true")
parser.add_argument("--write", action="store_true")
parser.add_argument("-o", default=".", help="folder for plot and picture")
options = parser.parse_args()
if options.write and options.quick:
    parser.error("--write takes all figures, in full")
target = ROOT / "docs/images" if options.write else pathlib.Path(options.o)
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    result, noise = measure()
    text = table(result, noise)
    print(text)
    (target / "lens_mesh.svg").write_text(plot(result))
    png(target / "lens_mesh.png", crops())
if options.write:
    page = ROOT / "docs/meshed.md"
    before, _, rest = page.read_text().partition("## Measured\n")
    after = rest[rest.index("\n## "):] if "\n## " in rest else ""
    page.write_text(f"{before}## Measured\n\n{text}\n{after}")
