#!/usr/bin/python3
"""Renders displays with lfdsim and with this folder's double-precision tracer, and compares: run.py LFDSIM_PROGRAM [--quick] [--only TEXT] [--out FOLDER].

Single rays: away from edges every pixel agrees within 1/255 + 1e-6, and the panel pixel that each ray met (read from the address image)
is the same for 99.9 % of all rays, 99.4 % through glass in air off axis. With subpixels and glasses each channel has its own edges and its own
picture (`noise`); 99.7 % of rays see the same light, and at least half of the picture is off the edges. Means over samples: see blurred() and
filtered(). The last line counts passed and failed comparisons; the exit code is 1 if any failed, and the pictures of those are kept in FOLDER
(default: a new temporary folder).
"""
import argparse
import functools
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import numpy as np
from PIL import Image

import cases
import colour
import colour_cases
import errors
import errors_cases
import lattice_cases
import tracer
from display import resolve, theory

GOLDEN = pathlib.Path(__file__).resolve().parent.parent / "golden"
TOLERANCE = 1 / 255 + 1e-6
FALSE_ALARM = 1e-8   # probability that chance alone fails one blurred comparison; less than a hundred are made: below 1e-6 together
COMPARED = 0.5       # the least share of a coloured picture that must be off the edges, by a sample of its pixels
MANY = 300           # so many pixels near edges that few directions do not find are something else
NEAR_ENOUGH = 0.015  # root mean square over a picture by which filtered light may differ from exact means, beyond chance
QUICK = {"camera": {"resolution": [64, 36]}}  # of --quick


@functools.lru_cache(maxsize=1)
def panel_images(columns, rows):
    """As uint8 (rows, columns, 3): checker, address (see golden/README.md), waves (smooth, so that means over many pixels tell widths) and noise (unlike
    in neighbours and channels)."""
    r, c = np.ogrid[:rows, :columns]

    def image(*colours):
        return np.stack(np.broadcast_arrays(*(np.asarray(colour).astype(np.uint8) for colour in colours)), axis=2)

    squares = 255 * ((r // 11 + c // 11) % 2)
    return {"checker": image(*[255 - squares] * 3), "address": image(c // 16, r // 16, c % 16 * 16 + r % 16),
            "waves": image(127.5 + 127.5 * np.cos(c / 9.0), 127.5 + 127.5 * np.cos(r / 9.0), squares),
            "noise": np.random.default_rng(5).integers(0, 256, (rows, columns, 3), np.uint8)}


class Harness:
    def __init__(self, program, folder, only):
        self.program, self.folder, self.only = program, folder, only
        self.passed = self.failed = 0

    def wanted(self, name):
        return self.only in name

    def lfdsim(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, timeout=3600)
        if done.returncode:
            raise RuntimeError(f"lfdsim {arguments[0]} ended with {done.returncode}: {done.stderr.strip()[-600:]}")
        return done.stdout

    def render(self, description, image, *options, estimator="point"):
        """lfdsim's picture (rows, columns, 3) of a description with a panel image (uint8)."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            cases.write(folder, description)
            Image.fromarray(image).save(folder / "panel.png", compress_level=1)
            self.lfdsim("render", folder / "display.toml", "--panel-image", folder / "panel.png", "--estimator", estimator, *options, "-o", folder / "out.npy")
            return np.load(folder / "out.npy").astype(float)

    def told(self, description):
        """The description with all errors of lenses in its table, as `lfdsim errors` tells those that it draws."""
        wrong = description.get("errors", {})
        if not any(key in wrong for key in errors.DRAWN):
            return description
        with tempfile.TemporaryDirectory() as name:
            table = pathlib.Path(name) / "told.csv"
            self.lfdsim("errors", cases.write(table.parent, description), "-o", table)
            rows = errors.read_table(table)
        return {**description, "errors": {**{key: wrong[key] for key in errors.OF_ARRAY if key in wrong}, "table": rows}}

    def check(self, name, compare):
        """Runs one comparison: compare() returns (good, what was found, pictures by name)."""
        try:
            good, found, pictures = compare()
        except (RuntimeError, OSError, subprocess.TimeoutExpired, KeyError, ValueError) as error:
            good, found, pictures = False, str(error), {}
        print(("pass  " if good else "FAIL  ") + name + ": " + found, flush=True)
        self.passed, self.failed = self.passed + good, self.failed + (not good)
        if not good and pictures:
            folder = self.folder / "".join(c if c.isalnum() else "_" for c in name)
            folder.mkdir(parents=True, exist_ok=True)
            for label, picture in {**pictures, "difference": abs(pictures["got"] - pictures["wanted"])}.items():
                np.save(folder / f"{label}.npy", picture)
                Image.fromarray((255 * np.clip(picture, 0, 1)).astype(np.uint8)).save(folder / f"{label}.png")


def single_rays(harness, description, pattern, share, compared=None):
    """One ray per pixel. share: of the rays that must meet the same panel pixel (pattern "address") or see the same light (others), None for any.

    compared: the least share of the picture, all channels, that must be off the edges.
    """
    display = resolve(harness.told(description))
    image = panel_images(*display.panel.pixels)[pattern]
    linear = colour.decode(image, display.panel.encoding)
    x, y = tracer.centers(display)
    traced = colour.trace(display, *tracer.camera_rays(display, x, y))
    wanted = colour.shade(display, traced, linear)
    shape = (*display.camera.resolution[::-1], 3)
    got = harness.render(description, image, "--samples", 1).reshape(-1, 3)
    error = np.abs(got - wanted)
    differs = error > TOLERANCE
    note = f"largest error elsewhere {error[~differs].max():.1e}"
    good = True
    if share:
        if pattern == "address":
            differs |= np.rint(got * 255) != np.rint(wanted * 255)
        same = 1 - differs.any(axis=1).mean()
        good = same >= share
        note = f"same {'panel pixel' if pattern == 'address' else 'light'} {100 * same:.3f} %"
    if compared:
        some = np.random.default_rng(6).choice(len(x), min(400, len(x)), replace=False)
        off_edges = 1 - colour.near_edge(display, linear, x[some], y[some]).mean()
        good &= off_edges >= compared
        note += f"; {100 * off_edges:.0f} % off the edges"
    odd = np.flatnonzero(differs.any(axis=1))
    for spokes, rings in ((8, 2), (48, 5)):  # look closer only where few directions found no edge
        if len(odd) and (rings == 2 or len(odd) < MANY):
            differs[odd] &= ~colour.near_edge(display, linear, x[odd], y[odd], spokes=spokes, rings=rings)
            odd = odd[differs[odd].any(axis=1)]
    if len(odd):
        k = odd[np.argmax((error * differs)[odd].max(axis=1))]
        note += f"; {len(odd)} differ off the edges, first at column {x[k] - 0.5:.0f} row {y[k] - 0.5:.0f}: got {got[k]}, wanted {wanted[k]}, status {traced[0][1].status[k]}"
    lit = f"{100 * (traced[0][1].column >= 0).mean():.0f} % lit, {(error > TOLERANCE).any(axis=1).sum()} of {len(x)} pixels differ, at edges; "
    return bool(good) and not len(odd), lit + note, {"got": got.reshape(shape), "wanted": wanted.reshape(shape)}


def address_of(description):
    """The same rays with nothing that scales their colour, so that the address image can be read back."""
    return cases.merge(description, {"panel": {"encoding": "linear", "emission_exponent": 0.0, "aperture_ratio": 1.0}, "render": {"fresnel": "none"}})


def golden(harness, name):
    """Against the stored exact picture."""
    text = (GOLDEN / f"{name}.toml").read_text()
    stored, address = np.load(GOLDEN / f"{name}.npz"), name in ("clear_15_degrees", "opaque_oblique")
    image = panel_images(3840, 2160)["address" if address else "checker"]
    got, wanted = harness.render(tomllib.loads(text), image, "--samples", 1), stored["rgb"].astype(float)
    wrong = (np.abs(got - wanted).max(axis=2) > TOLERANCE) & ~stored["edge"]
    found, good = f"{wrong.sum()} pixels differ off the edges", not wrong.any()
    if address:
        same = (np.rint(got * 255) == np.rint(wanted * 255)).all(axis=2).mean()
        good &= same >= (0.994 if name.startswith("clear") else 0.999)
        found += f"; same panel pixel {100 * same:.3f} %"
    return good, found, {"got": got, "wanted": wanted}


def own_golden(name):
    """This folder's tracer against the stored exact picture."""
    display = resolve(tomllib.loads((GOLDEN / f"{name}.toml").read_text()))
    hits = tracer.trace(display, *tracer.camera_rays(display, *tracer.centers(display)))
    stored = np.load(GOLDEN / f"{name}.npz")
    wrong = (np.stack([hits.column, hits.row], axis=1) != stored["panel_pixel"].reshape(-1, 2)).any(axis=1) & ~stored["edge"].ravel()
    return not wrong.any(), f"{wrong.sum()} panel pixels differ off the edges", {}


def blurred(harness, description, count, sampling, pattern="waves"):
    """Means of `count` samples per pixel against `count` random ones of ours: z-tests per pixel, together and of the whole picture.

    With v our sample variance (its own uncertainty added), a difference of two means has variance (1 + s) v / count, s = 1 for random samples; scrambled
    Sobol points have at most s = e. z = difference / standard deviation. Each of three tests fails by chance with a probability below FALSE_ALARM / 3:
    - one figure: Bernstein's |z| <= sqrt(2 L) + 4 L / (3 count deviation), L = ln(2 figures / probability), for values in [0, 1];
    - together: the sum over the P pixels of the channels' mean z^2 is at most P + 2 sqrt(P L) + 2 L, L = ln(1 / probability) (Laurent and Massart 2000);
    - the picture's mean: as one figure, with count P samples.
    """
    display, image, wanted, variance = exact_means(harness.told(description), count, pattern)
    got = harness.render(description, image, "--samples", count, "--sampling", sampling, "--seed", 7)
    brightest = display.subpixels.gain  # of each channel
    shape, got, wanted, variance = got.shape, got.reshape(-1, 3) / brightest, wanted / brightest, variance / brightest**2
    chance, share = FALSE_ALARM / 3, 1 + (np.e if sampling == "sobol" else 1)

    def score(difference, v, n, figures):
        """|z| over its bound, and z."""
        log = np.log(2 * figures / chance)
        deviation = np.sqrt(share * (v + np.sqrt(2 * v * log / n) + log / n) / n)
        return np.abs(difference) / (np.sqrt(2 * log) * deviation + 4 * log / (3 * n)), difference / deviation

    pixel, z = score(got - wanted, variance, count, got.size)
    whole, _ = score((got - wanted).mean(axis=0), variance.mean(axis=0), count * len(got), 3)
    log = -np.log(chance)
    together = (z**2).mean(axis=1).sum() / (len(got) + 2 * np.sqrt(len(got) * log) + 2 * log)
    ratios = pixel.max(), together, whole.max()
    found = "of what chance allows: one pixel {:.2f}, all together {:.2f}, the picture's mean {:.2f}".format(*ratios)
    return bool(max(ratios) <= 1), found, {"got": got.reshape(shape), "wanted": wanted.reshape(shape)}


def exact_means(description, count, pattern):
    """(display, the panel image, our means of `count` samples (pixels, 3), the variance of one sample)."""
    return exact_means_of(json.dumps(description), count, pattern)


@functools.lru_cache(maxsize=1)  # each way of sampling is held against the same means
def exact_means_of(text, count, pattern):
    display = resolve(json.loads(text))
    image = panel_images(*display.panel.pixels)[pattern]
    return display, image, *colour.sampled(display, colour.decode(image, display.panel.encoding), count, seed=1)


def filtered(harness, description, count, pattern, strata):
    """The filtered estimator with `strata` samples a pixel against our means: root mean square over the picture, less what chance adds to ours, at most
    NEAR_ENOUGH and what as many random samples would err."""
    _, image, wanted, variance = exact_means(harness.told(description), count, pattern)
    got = harness.render(description, image, "--samples", strata, estimator="filtered")
    shape, got = got.shape, got.reshape(-1, 3)
    beyond = np.sqrt(max(((got - wanted) ** 2).mean() - variance.mean() / count, 0))
    allowed = np.sqrt(NEAR_ENOUGH**2 + variance.mean() / strata)
    found = f"root mean square {beyond:.4f} of {allowed:.4f} allowed, largest {np.abs(got - wanted).max():.3f}"
    return bool(beyond <= allowed), found, {"got": got.reshape(shape), "wanted": wanted.reshape(shape)}


def paraxial(harness, description):
    """The figures of `lfdsim check --json` against our own, to 1e-6; None, where there is no figure, against null."""
    wanted = theory(resolve(description))
    with tempfile.TemporaryDirectory() as name:
        path = cases.write(pathlib.Path(name), description)
        got = json.loads(harness.lfdsim("check", path, "--json"))["theory"]

    def same(a, b):
        if a is None or b is None:
            return a is b
        return np.shape(a) == np.shape(b) and np.allclose(a, b, rtol=1e-6, atol=0)

    for name, value in list(wanted.items()):  # along x' and y': a figure and "fov_y_deg"
        if isinstance(value, list):
            stem, unit = (name.removesuffix("_deg"), "_deg") if name.endswith("_deg") else (name, "")
            wanted[name], wanted[f"{stem}_y{unit}"] = value
    missing = [k for k in wanted if k not in got]
    if missing:
        return False, "check does not print theory." + ", theory.".join(missing), {}
    wrong = {k: (got[k], v) for k, v in wanted.items() if not same(got[k], v)}
    told = ", ".join(f"{k} {np.round(v, 4)}" for k, v in wanted.items() if v is not None)
    return not wrong, f"got and wanted differ: {wrong}" if wrong else told, {}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--quick", action="store_true", help="fewer pixels, samples and golden pictures")
    parser.add_argument("--only", default="", help="comparisons whose name holds this text")
    parser.add_argument("--out", type=pathlib.Path, help="folder for pictures of failed comparisons")
    options = parser.parse_args()
    folder = options.out or pathlib.Path(tempfile.mkdtemp(prefix="lfdsim-oracle-"))
    harness = Harness(options.program, folder, options.only)
    todo = []
    for name in ("clear_on_axis", "clear_15_degrees", "opaque_oblique", "opaque_oblique_exact_fresnel"):
        todo.append((f"golden {name}, this tracer", lambda name=name: own_golden(name)))
        todo.append((f"golden {name}", lambda name=name: golden(harness, name)))
    sharp = {**cases.SHARP, **lattice_cases.SHORT, **lattice_cases.MORE}
    for name, description in sharp.items():
        if options.quick and (name in cases.LONG or name in lattice_cases.MORE):
            continue
        if options.quick:
            description = cases.merge(description, QUICK)
        off_axis = "clear" in name and "on axis" not in name
        todo.append((f"{name}, address", lambda d=description, o=off_axis: single_rays(harness, address_of(d), "address", 0.994 if o else 0.999)))
        panel = description["panel"]
        if not options.quick or description["render"]["fresnel"] != "none" or panel["emission_exponent"] or panel.get("aperture_ratio", 1) < 1:
            todo.append((f"{name}, checker", lambda d=description: single_rays(harness, d, "checker", None)))
        todo.append((f"{name}, theory", lambda d=description: paraxial(harness, d)))
    for name, description in {**colour_cases.SHORT, **({} if options.quick else colour_cases.MORE)}.items():
        if options.quick:
            description = cases.merge(description, QUICK)
        todo.append((f"{name}, noise", lambda d=description: single_rays(harness, d, "noise", 0.997, COMPARED)))
        todo.append((f"{name}, theory", lambda d=description: paraxial(harness, d)))
    for name, description in {**errors_cases.SHORT, **({} if options.quick else errors_cases.MORE)}.items():
        if options.quick:
            description = cases.merge(description, QUICK)
        todo.append((f"{name}, address", lambda d=description: single_rays(harness, address_of(d), "address", 0.994 if "caps" in name else 0.999)))
        todo.append((f"{name}, checker", lambda d=description: single_rays(harness, d, "checker", None)))
    for name, description in {**errors_cases.COLOURED_SHORT, **({} if options.quick else errors_cases.COLOURED_MORE)}.items():
        todo.append((f"{name}, noise", lambda d=description: single_rays(harness, d, "noise", 0.997, COMPARED)))
    count, strata, samplings = (2048, 144, ["sobol"]) if options.quick else (16384, 3844, ["random", "sobol"])
    more = {} if options.quick else colour_cases.BLURRED_MORE
    fine = {**colour_cases.FINE_SHORT, **({} if options.quick else colour_cases.FINE_MORE)}
    wrong = {**errors_cases.BLURRED_SHORT, **({} if options.quick else errors_cases.BLURRED_MORE)}
    coloured = {**colour_cases.BLURRED_SHORT, **more, **fine, **wrong}
    for name, description in {**cases.BLURRED, **coloured}.items():
        pattern = "noise" if name in fine else "waves"
        for s in samplings:
            todo.append((f"{name}, {s}", lambda d=description, s=s, p=pattern: blurred(harness, d, count, s, p)))
        if name in coloured:
            todo.append((f"{name}, filtered", lambda d=description, p=pattern: filtered(harness, d, count, p, strata)))
    for name, compare in todo:
        if harness.wanted(name):
            harness.check(name, compare)
    if harness.failed:
        print(f"pictures of what failed: {folder}")
    print(f"{harness.passed} passed, {harness.failed} failed")
    return 1 if harness.failed else 0


if __name__ == "__main__":
    sys.exit(main())
