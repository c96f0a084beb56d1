#!/usr/bin/python3
"""What content by inversion gains at eyes that the program neither fitted nor held out: inverse.py LFDSIM_PROGRAM [--only NAME] [--beside] [--model FILE] [--json].

For each display below the panel is made by the nodal, traced, integrated and inverse pick-up, and seen by eyes between the fitted ones: PSNR of sRGB
codes and SSIM of luma against photographs of the scene, inside the border of the screen, as docs/inverse.md has them. The last column is the inverse
pick-up over the best of the others. --beside: at eyes two view steps beside the box instead, at its sides and corners. Needs numpy.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time
import tomllib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
MODEL = "/usr/share/assimp/models/BLEND/Suzanne_248.blend"


def at(degrees, distance):
    return [distance * math.tan(math.radians(degrees)), 0, distance]


# Wall: z and width; model: z and height; frame: width, the plane it is in, columns x rows; eyes of the table; the box that is fitted.
DISPLAYS = {
    "desktop-asphere": {"wall": (230, 420), "model": (330, 110), "frame": (280, 330, 240, 150), "samples": 512,
                        "eyes": [at(a, 2000) for a in (1.37, 5.61, 10.23, 14.77, 18.11)], "box": [-689, 0, 2000, 689, 0, 2000]},
    "tablet-lenticular": {"set": ["panel.pixels=[340,190]"], "wall": (-6, 60), "model": (4, 13), "frame": (29, 0, 76, 44), "samples": 1024,
                          "eyes": [[x, 0, 450] for x in (-61, -32.5, 3, 32.5, 75)], "box": [-100, 0, 450, 100, 0, 450]},
    "hexagon": {"set": ["panel.pixels=[1000,560]"], "wall": (15, 160), "model": (60, 36), "frame": (92, 0, 112, 64), "samples": 1024,
                "eyes": [[-70.3, 4, None], [-31, -7, None], [2.2, 1, None], [34, 8, None], [71, -3, None]], "box": [-80, -10, None, 80, 10, None]},
    "desktop-ideal": {"set": ["errors={decenter_sd_mm=0.12, height_sd_mm=0.05, seed=5}", 'content.made_for="built"'], "wall": (230, 420),
                      "model": (330, 110), "frame": (280, 330, 240, 44), "samples": 512, "eyes": [at(a, 2000) for a in (0.8, 5.3, 11.1)],
                      "box": [*at(-13, 2000), *at(13, 2000)]},
}


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, folder

    def run(self, *words):
        done = subprocess.run([self.path, *map(str, words), "--progress", "none"], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"lfdsim {' '.join(map(str, words))}: {done.stderr}")
        return done.stdout

    def picture(self, *words):
        out = self.folder / "picture.npy"
        self.run(*words, "-o", out)
        return np.load(out).astype(float)


def codes(light):
    light = np.clip(light, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def inside(white, gain, border=3):
    """Elements that see white with more than 0.6 of the gain, without so many at the border of those."""
    mask = white.mean(axis=2) > 0.6 * gain
    for _ in range(border):
        padded = np.pad(mask, 1)
        mask = np.min([np.roll(np.roll(padded, i, 0), j, 1)[1:-1, 1:-1] for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)
    return mask


def ssim(a, b, mask):
    """Mean over windows that lie in the mask: Gaussian, 11 x 11, sigma 1.5, of luma of codes."""
    weights = np.exp(-np.arange(-5, 6) ** 2 / (2 * 1.5**2))
    weights /= weights.sum()

    def smooth(x):
        x = np.apply_along_axis(np.convolve, 0, x, weights, "valid")
        return np.apply_along_axis(np.convolve, 1, x, weights, "valid")

    x, y = (codes(p) @ [0.2126, 0.7152, 0.0722] for p in (a, b))
    mx, my = smooth(x), smooth(y)
    sxx, syy, sxy = smooth(x * x) - mx * mx, smooth(y * y) - my * my, smooth(x * y) - mx * my
    values = (2 * mx * my + 1e-4) * (2 * sxy + 9e-4) / ((mx * mx + my * my + 1e-4) * (sxx + syy + 9e-4))
    whole = np.lib.stride_tricks.sliding_window_view(mask, (11, 11)).all(axis=(2, 3))
    return values[whole].mean()


def beside(case, description):
    """Eyes two view steps, D a/g each, beside the box: at its sides, then at its corners."""
    distance = case["box"][5] or description["camera"]["position_mm"][2]
    step = distance * description["panel"]["pixel_pitch_mm"] / description["array"]["gap_mm"]
    x, y = case["box"][3] + 2 * step, case["box"][4] + 2 * step
    return [[a, b, distance] for a, b in ((x, 0), (-x, 0), (0, y), (0, -y), (x, y), (-x, y), (x, -y), (-x, -y))]


def measure(program, name, case, model, outside=False):
    display = program.folder / f"{name}.toml"
    text = (ROOT / "displays" / f"{name}.toml").read_text()
    (z_wall, width), (z_model, height) = case["wall"], case["model"]
    display.write_text(f"""{text}
[[content.object]]
image = "{ROOT / 'examples/wall.png'}"
position_mm = [0, 0, {z_wall}]
width_mm = {width}
[[content.object]]
model = "{model}"
position_mm = [0, 0, {z_model}]
height_mm = {height}
tilt_deg = -35
""")
    default_z = tomllib.loads(text).get("camera", {}).get("position_mm", [0, 0, 2000])[2]
    eyes = [[x, y, z or default_z] for x, y, z in (beside(case, tomllib.loads(text)) if outside else case["eyes"])]
    box = [default_z if n is None else n for n in case["box"]]
    frame, z, columns, rows = case["frame"]
    settings = [*case.get("set", []), "camera.pixel_filter=box", "camera.pupil_diameter_mm=4"]

    def camera(eye):
        focus = math.dist(eye, [0, 0, z])
        return ["--camera-mm", ",".join(map(str, eye)), "--target-mm", f"0,0,{z}", "--frame-width-mm", frame, "--size", f"{columns}x{rows}", "--set", *settings,
                f"camera.focus_distance_mm={focus}"]

    def view(eye, *shown):
        return program.picture("render", display, *camera(eye), *shown, "--estimator", "point", "--samples", case["samples"], "--seed", 9)

    photographs = [program.picture("photo", display, *camera(eye), "--samples", 64) for eye in eyes]
    whites = [view(eye, "--pattern", "white") for eye in eyes]
    light = np.concatenate([w.mean(axis=2).ravel() for w in whites])
    gain = np.median(light[light > 0.3 * light.max()])
    masks = [inside(w, gain) for w in whites]
    rows_of = {}
    for pickup in ("nodal", "traced", "integrated", "inverse"):
        panel = program.folder / f"{name}-{pickup}.png"
        began = time.monotonic()
        more = ["--eyes-mm=" + ",".join(map(str, box))] if pickup == "inverse" else []
        said = json.loads(program.run("eia", display, "--pickup", pickup, *more, "--json", "-o", panel, "--set", *settings))
        figures = []
        for eye, photograph, mask in zip(eyes, photographs, masks):
            seen = view(eye, "--panel-image", panel) / gain
            error = (codes(seen) - codes(photograph))[mask]
            figures.append((-10 * math.log10((error**2).mean()), ssim(seen, photograph, mask)))
        rows_of[pickup] = {"psnr_db": [f[0] for f in figures], "ssim": [f[1] for f in figures], "seconds": time.monotonic() - began,
                           "inverse": said.get("inverse")}
    return rows_of


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("program")
    options.add_argument("--only", default="", help="displays whose name holds this text")
    options.add_argument("--beside", action="store_true", help="eyes two view steps beside the box")
    options.add_argument("--model", default=MODEL)
    options.add_argument("--json", action="store_true")
    options = options.parse_args()
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, case in DISPLAYS.items():
            if options.only not in name:
                continue
            found[name] = rows = measure(Program(str(pathlib.Path(options.program).resolve()), pathlib.Path(folder)), name, case, options.model, options.beside)
            if options.json:
                continue
            print(name)
            for pickup, row in rows.items():
                print(f"  {pickup:11} {np.mean(row['psnr_db']):6.2f} dB ({' '.join(f'{x:.2f}' for x in row['psnr_db'])}), SSIM {np.mean(row['ssim']):.3f}", flush=True)
            best = {k: max(np.mean(rows[p][k]) for p in ("nodal", "traced", "integrated")) for k in ("psnr_db", "ssim")}
            least = min(a - b for a, b in zip(rows["inverse"]["psnr_db"], rows["traced"]["psnr_db"]))
            print(f"  gain        {np.mean(rows['inverse']['psnr_db']) - best['psnr_db']:+.2f} dB, SSIM {np.mean(rows['inverse']['ssim']) - best['ssim']:+.3f}; "
                  f"least over traced {least:+.2f} dB; {rows['inverse']['seconds']:.0f} s", flush=True)
    if options.json:
        print(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
