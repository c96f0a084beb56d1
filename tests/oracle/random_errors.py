#!/usr/bin/python3
"""Displays with errors drawn at random, rendered by lfdsim and by this folder's tracer: random_errors.py LFDSIM_PROGRAM [--first N] [--count N], by hand.

The same number, the same display: every lattice, lens and surround, layers, glued lenses, stops, subpixels and glasses, cameras up to 52 degrees
and close by, errors of the array and of each lens, drawn and by a table. Off edges all pixels must agree, as in run.py. A display that lfdsim refuses is named.
"""
import argparse
import math
import pathlib
import re
import sys
import tempfile

import numpy as np

import run
from cases import surface, surfaces
from display import resolve
from errors_cases import wrong

P = 7.92  # the pitch of a display of scale 1
THIN = ("ideal", "pinhole")


def corner_of(lattice, p, py):
    """How far a cell's corners are from its axis."""
    return {"square": p / math.sqrt(2), "hexagon": p / math.sqrt(3), "strips": p / 2}.get(lattice, math.hypot(p, py) / 2)


def draw_lens(rng, kind, p, inner, semi, reach, fills):
    """A lens of semi-aperture `reach`, or, of thin and spherical ones, `semi`; inner: the cell's inner radius."""
    round_semi, index = (0.99 * inner if fills else semi), float(rng.uniform(1.4, 1.8))

    def curved(low, high):
        return float(rng.uniform(low, high)) / reach

    if kind == "plano":
        return {"type": "plano_convex", "sphere_radius_mm": reach / float(rng.uniform(0.35, 0.9)), "aperture_radius_mm": round_semi,
                "cylinder_height_mm": float(rng.uniform(0.05, 0.8)) * p / 2, "index": index, "facing": str(rng.choice(["viewer", "viewer", "panel"]))}
    if kind == "ideal":
        return {"type": "ideal", "focal_length_mm": p * float(rng.uniform(0.9, 2)), "aperture_radius_mm": round_semi}
    if kind == "pinhole":
        return {"type": "pinhole", "aperture_radius_mm": inner * float(rng.uniform(0.2, 0.9))}
    if kind == "asphere":
        c = curved(0.4, 0.8)
        even = [float(rng.uniform(-0.03, 0.03)) * c**3, float(rng.uniform(-0.02, 0.02)) * c**5]
        return surfaces(surface(0.0, reach, c * reach**2 / 1.6 + 0.2 * reach, index), surface(-c, reach, conic=float(rng.uniform(-1, 0)), even=even))
    if kind == "biconvex":
        a, b = curved(0.1, 0.5), curved(0.2, 0.7)
        return surfaces(surface(a, reach, (a + b) * reach**2 / 1.7 + 0.1 * reach, index, conic=float(rng.uniform(-1.5, 0.3))),
                        surface(-b, reach, conic=float(rng.uniform(-1.5, 0.3))))
    if kind == "doublet":
        return surfaces(surface(curved(0.05, 0.3), reach, 0.5 * reach, 1.62), surface(curved(0.1, 0.4), reach, 0.9 * reach, index), surface(-curved(0.2, 0.6), reach))
    if kind == "hollow":
        return surfaces(surface(-curved(0.05, 0.4), reach, 0.5 * reach, index), surface(curved(0.02, 0.4), reach))
    a = curved(0.3, 0.6)
    return surfaces(surface(a, reach, 0.8 * reach, index), surface(a * float(rng.uniform(0.1, 0.5)), reach))  # meniscus


def of_glass(rng, lens):
    glass = {"vd": float(rng.uniform(12, 60))}
    for row in [lens] if "index" in lens else lens["surface"][:-1]:
        row["glass"] = {"nd": row.pop("index"), **glass}


def draw_camera(rng, p, scale, coloured, plate):
    tilt, round_about, away = rng.choice([0, 8, 20, 35, 52]), rng.uniform(0, 2 * math.pi), 90 * p
    a, b = math.radians(tilt) * math.cos(round_about), math.radians(tilt) * math.sin(round_about)
    camera = {"position_mm": [away * math.sin(a) * math.cos(b), away * math.sin(b), away * math.cos(a) * math.cos(b)],
              "target_mm": [0.37 * scale, -0.21 * scale, 0.0], "frame_width_mm": (44 if coloured else float(rng.choice([50, 111, 140]))) * scale,
              "resolution": [72, 40] if plate else [112, 63]}
    if rng.random() < 0.12:  # close by
        camera |= {"position_mm": [float(rng.uniform(-high, high) + z) * scale for high, z in ((30, 0), (20, 0), (20, 70))], "target_mm": [5 * scale, 3 * scale, 0.0],
                   "up": [0.2, 1.0, 0.1]}
    return camera


def draw_errors(rng, p, lateral, level, tilts, curves):
    """(errors of the array and what is drawn, sizes of the table's columns or None). level: of glued lenses."""
    size, of_array, columns = math.exp(rng.uniform(math.log(0.05), 0)), {}, {}
    table, drawn = {"table": (1, 0), "drawn": (0, 1), "both": (0.5, 0.5), "array": (0, 0)}[str(rng.choice(["table", "drawn", "both", "array"]))]
    for key, most in (("shift_mm", [0.3 * p] * 2), ("rotation_deg", 5.0), ("pitch_ppm", 6000.0), ("gap_mm", 0.1 * p), ("wedge_deg", [1.2] * 2), ("bow_mm", 0.12 * p)):
        if rng.random() < 0.5 and not (level and key in ("gap_mm", "wedge_deg", "bow_mm")):
            of_array[key] = [float(v) for v in rng.uniform(-1, 1, 2) * most * size] if isinstance(most, list) else float(rng.uniform(-1, 1)) * most * size
    for key, names, most, possible in (("decenter_sd_mm", ("dx_mm", "dy_mm"), 0.98 * lateral, True), ("height_sd_mm", ("dz_mm",), 0.08 * p, not level),
                                       ("tilt_sd_deg", ("tilt_x_deg", "tilt_y_deg"), 7.0, tilts), ("curvature_sd", ("curvature",), 0.12, curves)):
        if possible and rng.random() < 0.65:
            columns |= {name: most * size * table for name in names} if table else {}
            of_array |= {key: most * size * drawn / 3, "seed": int(rng.integers(0, 2**40))} if drawn else {}
    return of_array, columns or None


def draw(number):
    """(description, what it is, whether it is in colour)."""
    rng = np.random.default_rng([2027, number])
    scale = math.exp(rng.uniform(math.log(0.04), math.log(4)))
    p, kind = P * scale, str(rng.choice(["plano", "plano", "asphere", "biconvex", "doublet", "hollow", "meniscus", "ideal", "pinhole"]))
    lattice, fills = str(rng.choice(["square", "rectangle", "hexagon", "brick", "strips"])), bool(rng.random() < 0.5) and kind != "pinhole"
    two = lattice in ("rectangle", "brick")
    py = p * float(rng.uniform(0.75, 1.35)) if two else p
    inner = min(p, py) / 2
    semi = inner * float(rng.uniform(0.7, 1.0))
    lens = draw_lens(rng, kind, p, inner, semi, corner_of(lattice, p, py) * float(rng.uniform(1.02, 1.06)) if fills else semi, fills)
    if kind != "pinhole" and rng.random() < 0.25:
        lens["stop_radius_mm"] = inner * float(rng.uniform(0.3, 0.8))
    plate = kind in ("plano", "asphere", "biconvex") and rng.random() < 0.35
    glued = kind in ("plano", "asphere") and lens.get("facing") != "panel" and rng.random() < 0.2
    plates = [{"thickness_mm": p * float(rng.uniform(0.05, 0.25)), "index": float(rng.uniform(1.3, 1.8))} for _ in range(int(rng.choice([0, 0, 1, 2])))]
    array = {"lattice": lattice, "pitch_mm": [p, py] if two else p, "surround": "plate" if plate else "opaque", "aperture": "cell" if fills else "circle",
             "base_z_mm": sum(layer["thickness_mm"] for layer in plates) + (0.0 if glued else p * float(rng.uniform(0.3, 1.2)))}
    if lattice == "strips":
        array["slant_deg"] = float(rng.uniform(-50, 50))
    elif rng.random() < 0.4:
        array["rotation_deg"] = float(rng.uniform(-45, 45))
    if rng.random() < 0.4:
        array["offset_mm"] = [float(v) for v in rng.uniform(-0.4, 0.4, 2) * p]
    if rng.random() < 0.25:
        array["count"] = [int(rng.integers(3, 9)), 1 if lattice == "strips" else int(rng.integers(3, 8))]
    coloured = rng.random() < 0.3
    panel = {"pixels": [400, 266] if coloured else [1200, 800], "pixel_pitch_mm": (0.27 if coloured else 0.09) * scale,
             "encoding": str(rng.choice(["linear", "srgb"])), "emission_exponent": float(rng.choice([0, 0, 1.5])), **({"layer": plates} if plates else {})}
    if coloured:
        panel["subpixels"] = str(rng.choice(["none", "rgb_stripe", "pentile_rgbg", "delta", "bgr_stripe", "rgb_rows"]))
        panel |= {"aperture_ratio": float(rng.uniform(0.4, 0.9))} if rng.random() < 0.4 else {}
        if kind not in THIN and rng.random() < 0.6:
            of_glass(rng, lens)
    lateral = max(0.0 if fills or kind == "pinhole" else inner - semi, 0.1 * inner)
    description = {"schema": 1, "panel": panel, "lens": lens, "array": array, "camera": draw_camera(rng, p, scale, coloured, plate),
                   "content": {"viewing_distance_mm": 90 * p}, "render": {"samples": 1, "fresnel": str(rng.choice(["none", "exact", "schlick"]))}}
    of_array, columns = draw_errors(rng, p, lateral, glued, not glued and not plate, kind != "pinhole")
    description = wrong(description, of_array, columns, seed=number, share=float(rng.choice([1, 1, 0.5])))
    what = [kind, lattice, array["aperture"], array["surround"], *["glued"] * glued, *["layers"] * bool(plates), *["stop"] * ("stop_radius_mm" in lens),
            *[panel.get("subpixels", "")] * coloured, *description["errors"]]
    return description, f"{number}: {', '.join(what)}", coloured


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=100)
    options = parser.parse_args()
    harness = run.Harness(options.program, pathlib.Path(tempfile.mkdtemp(prefix="lfdsim-oracle-")), "")
    pixels = wrongly = 0
    for number in range(options.first, options.first + options.count):
        description, name, coloured = draw(number)
        if not description["errors"]:
            continue
        try:
            resolve(harness.told(description))
        except RuntimeError as error:
            print(f"refused  {name}: {str(error)[-200:]}", flush=True)
            continue
        for d, pattern in [(description, "noise")] if coloured else [(run.address_of(description), "address"), (description, "checker")]:
            seen = []

            def compare(d=d, pattern=pattern):
                seen[:] = run.single_rays(harness, d, pattern, None)
                return seen

            harness.check(f"{name}, {pattern}", compare)
            pixels += math.prod(d["camera"]["resolution"])
            wrongly += int((re.findall(r"(\d+) differ off the edges", seen[1]) or [0])[0]) if seen else 0
    print(f"{harness.passed} passed, {harness.failed} failed; {wrongly} of {pixels} pixels differ off the edges")
    return 1 if harness.failed else 0


if __name__ == "__main__":
    sys.exit(main())
