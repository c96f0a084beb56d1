"""POV-Ray's true surfaces against lfdsim's, one ray a pixel: how many pixels away from lens edges agree, and why the others do not.

Each panel pixel has a colour of its own, so that any other panel pixel is a difference. The tracer of tests/oracle, a third program in double precision,
tells where the exact ray goes.
"""
import sys

import numpy as np

import pictures
import programs
from programs import say
from scenes import ROOT, Exported, Scene, Truth, address, address_panel, described

sys.path.insert(0, str(ROOT / "tests/oracle"))
from path import PANEL, TOTAL  # noqa: E402

TITLE = "### POV-Ray: true surfaces"
WITHIN = 1 / 255 + 1e-5
KINDS = ("next to a lens edge", "panel pixel border", "total internal reflection", "other")
COLOURS = ((0.9, 0.75, 0.1), (0.1, 0.35, 0.9), (0.1, 0.7, 0.2), (0.9, 0.05, 0.05))


def kinds(truth, differs, shown):
    """For each pixel that differs the index in KINDS of the first reason that applies, -1 for the others."""
    kind = np.full(differs.shape, -1)
    exact_total = truth.status == TOTAL
    dark = ~(shown.max(axis=2) > 0)
    for number, is_one in reversed(list(enumerate((~truth.away, (truth.status == PANEL) & truth.near_border(), exact_total | dark, np.ones_like(differs))))):
        kind[differs & is_one] = number
    return kind


def compare(program, folder, name, surround, degrees, size):
    description = described(name, size, degrees, array={"surround": surround}, render={"fresnel": "exact" if surround == "opaque" else "none"})
    scene = Scene(program, folder, description, address_panel(description))
    exported = Exported(scene, "pov")
    povs, ran = exported.render()
    ours, _ = scene.lfdsim("--estimator", "point")
    wrong, _ = scene.lfdsim("--estimator", "point", "--set", f"array.gap_mm={1.001 * description['array']['gap_mm']:.9g}")
    truth = Truth(description)
    differs = (np.abs(povs - ours) > WITHIN).any(axis=2)
    kind = kinds(truth, differs, povs)
    away = truth.away
    odd = differs & away
    exact = np.stack([truth.column, truth.row])
    readable = surround != "opaque"  # Fresnel's losses change the colours that are addresses
    on_panel = odd & (truth.status == PANEL) & readable
    row = {"display": name, "surround": surround, "degrees": degrees, "size": list(size), "pixels": int(differs.size),
           "lit": float((ours.max(axis=2) > 0).mean()), "away": int(away.sum()), "agree": float(1 - odd.sum() / away.sum()),
           "psnr_away": pictures.psnr(povs[away], ours[away]), "psnr": pictures.psnr(povs, ours),
           "agree_if_gap_were_wrong": float(1 - ((np.abs(povs - wrong) > WITHIN).any(axis=2) & away).sum() / away.sum()),
           "kinds": {word: int((kind == k).sum()) for k, word in enumerate(KINDS)},
           "odd_where_exact_is_on_panel": int(on_panel.sum()),
           "of_these_lfdsim_exact": int((on_panel & (address(ours) == exact).all(axis=0)).sum()),
           "of_these_pov_exact": int((on_panel & (address(povs) == exact).all(axis=0)).sum()),
           "wall_s": ran.wall, "processor_s": ran.processor}
    say(f"POV-Ray, {name}, {surround}, {degrees} degrees: {100 * row['agree']:.4f} % of {row['away']} pixels away from edges agree; differ: {row['kinds']}")
    return row, picture(ours, kind, away)


def picture(ours, kind, away):
    """lfdsim's picture, pale, and paler away from edges, with the pixels that differ in the colours of their kinds."""
    shown = (0.45 + 0.3 * away[:, :, None] + 0.25 * np.clip(ours.mean(axis=2, keepdims=True), 0, 1)) * np.ones(3)
    for number, colour in enumerate(COLOURS):
        shown[kind == number] = colour
    return shown


def measure(program, folder, size, displays, angles=(0, 15, 30)):
    rows, shown = [], []
    for name in displays:
        for surround in ("opaque", "plate", "clear"):
            for degrees in angles:
                row, one = compare(program, folder / f"{name}-{surround}-{degrees}", name, surround, degrees, size)
                rows.append(row)
                if name == displays[0] and degrees == angles[-1]:
                    shown.append(one)
    return {"program": programs.version("pov"), "rows": rows}, shown


def sheet(shown):
    """The middle of each picture, three times as large, side by side."""
    parts = []
    for one in shown:
        rows, columns = one.shape[:2]
        high, wide = min(rows, 150), min(columns, 150)
        top, left = (rows - high) // 2, (columns - wide) // 2
        parts += [np.kron(one[top:top + high, left:left + wide], np.ones((3, 3, 1))), np.ones((3 * high, 12, 3))]
    return np.concatenate(parts[:-1], axis=1)


def text(found, image):
    rows = found["rows"]
    odd = sum(row["odd_where_exact_is_on_panel"] for row in rows)
    lines = [TITLE, "",
             f"{found['program']}, one ray through each pixel's centre, {rows[0]['size'][0]} x {rows[0]['size'][1]} pixels, no diffuser; exact Fresnel weights where the surround is opaque, none elsewhere. "
             "Agree: share of the pixels away from lens edges whose colours are within 1/255 in linear light. "
             "In brackets, the share with lfdsim's gap made longer by a thousandth, to show that the comparison would detect it. The last four columns count "
             "all pixels that differ, each under the first reason that holds.", "",
             "| display | surround | from | away from edges | agree | PSNR there, dB | " + " | ".join(KINDS) + " |", "|---" * (6 + len(KINDS)) + "|"]
    for row in rows:
        lines.append(f"| {row['display']} | {row['surround']} | {row['degrees']}° | {100 * row['away'] / row['pixels']:.1f} % | {100 * row['agree']:.4f} % ({100 * row['agree_if_gap_were_wrong']:.1f} %) | "
                     f"{row['psnr_away']:.1f} | " + " | ".join(str(row["kinds"][kind]) for kind in KINDS) + " |")
    lines += ["",
              "*Away from lens edges*: the exact rays through the pixel and its eight neighbours meet the same lenses in the same order and end alike (on the "
              "panel, beside it, absorbed). The exact rays are those of the tracer of `tests/oracle/`. *Panel pixel border*: the exact ray meets the panel "
              "within 1/1000 panel pixel of a border, where single precision, or a hit that POV-Ray finds to 10⁻⁶, may fall on either side. *Total internal "
              "reflection*: the exact ray is totally reflected somewhere, or POV-Ray's picture is dark there. *Other*: none of these.",
              f"In plate and clear, the exact ray ends on the panel for {odd} of the pixels that differ away from edges: lfdsim shows that panel pixel in "
              f"{sum(row['of_these_lfdsim_exact'] for row in rows)}, POV-Ray in {sum(row['of_these_pov_exact'] for row in rows)} of them.", "",
              f"![Pixels that differ]({image})", "",
              f"Middle of {rows[0]['display']} from {max(row['degrees'] for row in rows)}°: opaque, plate, "
              "clear; darker is near lens edges. Yellow: next to a lens edge. Blue: panel pixel border. Green: total internal reflection. Red: other."]
    return lines
