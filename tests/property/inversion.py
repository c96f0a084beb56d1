#!/usr/bin/python3
"""Content by inversion on displays drawn at random, held against the other pick-ups: inversion.py LFDSIM_PROGRAM [--displays N] [--first N].

A display shows two pictures of a wall, one behind its lenses and one before them. Its panel is made by each pick-up; eyes drawn at random in the box that the
program reports, which it has neither fitted nor held out, see them by point samples of another seed. Light is
relative to what the program says of a white panel. No display may serve its eyes worse than by traced content by more than 0.1 dB of PSNR in the mean, none of
them by more than 0.5 dB, and in the mean over the displays it must be better than the best of the other pick-ups. Prints a line for each display.
"""
import argparse
import json
import math
import pathlib
import sys
import tempfile

import numpy as np

import run

import displays

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))
import inverse as views  # noqa: E402  (codes)

EYES, SAMPLES, WORST_MEAN_DB, WORST_DB = 4, 256, 0.1, 0.5
SIMPLE = ("traced", "nodal", "integrated")


def shares(white, gain, pitch):
    """Of each element the light of a white panel over the most within a lens pitch (elements); 0 where either is too dark to be judged."""
    light = white.mean(axis=2)
    nearby = light
    for axis in (0, 1):
        padded = np.pad(nearby, [(pitch, pitch) if a == axis else (0, 0) for a in (0, 1)])
        nearby = np.lib.stride_tricks.sliding_window_view(padded, 2 * pitch + 1, axis).max(axis=-1)
    share = np.divide(light, nearby, out=np.zeros_like(light), where=nearby > 0.6 * gain)
    return np.where(share > 0.6, share, 0)


def show_walls(_, description):
    """Gives a display two pictures of a wall to show."""
    distance, width = description["camera"]["position_mm"][2], panel_mm(description)[0]
    wall = str(ROOT / "examples/wall.png")
    content = description.setdefault("content", {})
    content["object"] = [{"image": wall, "position_mm": [0, 0, -min(0.05 * width, 0.1 * distance)], "width_mm": 1.5 * width},
                         {"image": wall, "position_mm": [0.1 * width, 0, min(0.03 * width, 0.05 * distance)], "width_mm": 0.3 * width}]
    for key in ("model", "depth_mm", "height_mm"):
        content.pop(key, None)
    for key in ("estimator", "samples"):
        description["render"].pop(key, None)


def panel_mm(description):
    return np.array(description["panel"]["pixels"]) * description["panel"]["pixel_pitch_mm"]


def element_mm(description, theory):
    """The default of content.inverse.pixel_mm: what finer elements of a view see is not fitted."""
    pitch, panel, image = np.min(description["array"]["pitch_mm"]), description["panel"], theory["pixel_image_mm"]
    finest = min(pitch, image) if isinstance(image, float) else pitch  # none of pinholes, or infinite
    if "subpixels" in panel:
        finest = max(finest, 12 * panel["pixel_pitch_mm"])
    return max(finest / 2, description["camera"]["position_mm"][2] * math.tan(math.radians(1 / 60)))


class Inversions:
    def __init__(self, options, folder):
        self.options, self.folder, self.harness = options, folder, run.Harness(options.program, folder, False, int(options.panel_pixels))

    def picture(self, *command):
        out = self.folder / "picture.npy"
        done = self.harness.lfdsim(*command, "--progress", "none", "-o", out)
        if done.returncode:
            raise RuntimeError(" ".join(map(str, command)) + ": " + done.stderr)
        return np.load(out).astype(np.float64)

    def display(self, number):
        """What the program says, and by each pick-up the PSNR of each eye's view; empty where no eye sees the screen."""
        description, path, checked, _ = self.harness.drawn(number, show_walls)
        width, height = panel_mm(description)
        said = {}
        for pickup in (*SIMPLE, "inverse"):
            done = self.harness.lfdsim("eia", path, "--pickup", pickup, "--json", "--progress", "none", "-o", self.folder / f"{pickup}.png")
            if done.returncode:
                return {"refused": done.stderr.strip()}, {"traced": []}
            said[pickup] = json.loads(done.stdout)
        report = said["inverse"]["inverse"]
        rng = np.random.default_rng([2031, number])
        places = [rng.uniform(*(np.array(box[k], float) for k in ("low_mm", "high_mm"))) for box in report["eyes"] for _ in range(EYES)]
        columns = min(max(round(1.1 * width / element_mm(description, checked["theory"])), 16), 240)
        rows = min(max(12, round(columns * height / width)), 240)

        def camera(eye):
            return ["--camera-mm", ",".join(map(str, eye)), "--target-mm", "0,0,0", "--frame-width-mm", 1.1 * width, "--size", f"{columns}x{rows}", "--set",
                    "camera.pixel_filter=box", f"camera.pupil_diameter_mm={min(4, 0.02 * eye[2])}", f"camera.focus_distance_mm={math.dist(eye, (0, 0, 0))}"]

        def view(eye, *shown):
            return self.picture("render", path, *camera(eye), *shown, "--estimator", "point", "--samples", SAMPLES, "--seed", 9)

        whites = [view(eye, "--pattern", "white") for eye in places]
        gain = report["white_light"]  # a median over this test's elements would count those that are mostly gaps
        psnr = {pickup: [] for pickup in (*SIMPLE, "inverse")}
        pitch = math.ceil(columns * min(np.max(description["array"]["pitch_mm"]) / (1.1 * width), 1))
        for eye, white in zip(places, whites):
            share = shares(white, gain, pitch)
            mask = share > 0
            if mask.sum() < 50:
                continue
            photograph = self.picture("photo", path, *camera(eye), "--samples", 64)
            for pickup, found in psnr.items():
                seen = view(eye, "--panel-image", self.folder / f"{pickup}.png")[mask] / gain / share[mask][:, None]
                found.append(-10 * math.log10(max(np.mean((views.codes(seen) - views.codes(photograph[mask]))**2), 1e-12)))
        return report, psnr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--displays", type=int, default=12)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--panel-pixels", type=float, default=6e4)
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for the descriptions and panels")
    options = parser.parse_args()
    options.program = options.program.resolve()
    folder = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="lfdsim-inversion-"))
    folder.mkdir(exist_ok=True, parents=True)
    inversions, gains, over_best, failed = Inversions(options, folder.resolve()), [], [], 0
    for n in range(options.first, options.first + options.displays):
        number = n // 2 + (displays.OTHERS if n % 2 else 0)  # both halves of what can be drawn
        report, psnr = inversions.display(number)
        if not psnr["traced"]:
            print(f"{number:5} {report.get('refused', 'no eye sees enough of the screen')}", flush=True)
            continue
        gain = np.array(psnr["inverse"]) - np.array(psnr["traced"])
        best = max(SIMPLE, key=lambda pickup: np.mean(psnr[pickup]))
        gains.append(gain.mean())
        over_best.append(np.mean(psnr["inverse"]) - np.mean(psnr[best]))
        held = gain.mean() >= -WORST_MEAN_DB and gain.min() >= -WORST_DB
        failed += not held
        print(f"{number:5} traced {np.mean(psnr['traced']):6.2f} dB, gain {gain.mean():+6.2f}, least {gain.min():+6.2f} dB{'' if held else ' FAILED'}; "
              f"{over_best[-1]:+6.2f} over {best}; the program says "
              f"{report['held_out_traced']['psnr_db']:.2f} and {report['held_out']['psnr_db']:.2f}; {report['places']} places, {report['rays_per_element']} rays, "
              f"{report['seconds']:.1f} s{'' if report['result'] == 'inverse' else ', written is ' + report['result']}", flush=True)
    print(f"{len(gains)} displays, mean gain {np.mean(gains):+.2f} dB, median {np.median(gains):+.2f}, over the best of the others {np.mean(over_best):+.2f} and "
          f"{np.median(over_best):+.2f}, {min(over_best):+.2f} at least; {failed} failed")
    return 1 if failed or not np.mean(over_best) > 0 else 0


if __name__ == "__main__":
    sys.exit(main())
