"""The errors of a display's [errors], each with its size, and the rows of a tolerance study: what each row gives them.

Rows, in this order: the display without errors; then for each group (all errors together; each alone) and each scale of the sizes, the
draws. Draw k has the same random numbers in every group and at every scale, so that what differs is the errors' doing.
"""

from __future__ import annotations

import csv
import dataclasses
import io
import json
from typing import TYPE_CHECKING

import numpy as np

from .factors import truncated_normal
from .problems import StudyError

if TYPE_CHECKING:
    import lfdsim

WHOLE = ("shift_mm", "gap_mm", "rotation_deg", "pitch_ppm", "wedge_deg", "bow_mm")  # of the array: what is stated is a standard deviation
EACH = ("decenter_sd_mm", "height_sd_mm", "tilt_sd_deg", "curvature_sd")  # of each lens, drawn by the display itself
ALL = "all together"
TRUNCATED = 3.0  # standard deviations, as the errors of each lens are


@dataclasses.dataclass(frozen=True)
class Layout:
    """Which rows are what. Scale 1 is as the display states it."""

    sizes: dict[str, float | list[float]]  # of the errors that are not zero, by their key
    draws: int  # of all together at scale 1
    alone: int  # of every other group and scale; of all together as many as there are draws, at most
    scales: tuple[float, ...] = (0.5, 1.0, 2.0)
    table: str = ""  # errors.table, whose errors are those of every row

    @property
    def groups(self) -> list[str]:
        return [ALL, *self.sizes] if self.alone else [ALL]

    @property
    def rows(self) -> int:
        return self.blocks()[-1][2].stop

    def blocks(self) -> list[tuple[str, float, range]]:
        """(group, scale, rows)."""
        blocks, start = [], 1
        for group in self.groups:
            for scale in self.scales if self.alone else (1.0,):
                count = self.alone if group != ALL else self.draws if scale == 1 else min(self.alone, self.draws)
                blocks.append((group, scale, range(start, start + count)))
                start += count
        return blocks


def sizes_of(display: lfdsim.Display, path: object) -> dict[str, float | list[float]]:
    """The errors that a display has, but for those that are zero and those of its table."""
    keys = [f"errors.{name}" for name in (*WHOLE, *EACH)]
    sizes = {key: np.asarray(display[key], float).tolist() for key in keys if np.any(display[key])}
    if not sizes:
        raise StudyError(
            f"{path}: [errors]",
            "states no error; give sizes there, as in decenter_sd_mm = 0.01 (of each lens) or gap_mm = 0.02 (of the "
            "array: a standard deviation here), or by --set errors.gap_mm=0.02",
        )
    return sizes


def rows_csv(layout: Layout, seed: int) -> str:
    drawn = {key: _units(key, size, max(layout.draws, layout.alone), seed) for key, size in layout.sizes.items()}
    seeds = np.random.SeedSequence(seed).generate_state(max(layout.draws, layout.alone), np.uint32)
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow([*layout.sizes, "errors.seed"])
    out.writerow([*(json.dumps(_value(key, size, 0.0, drawn[key][0])) for key, size in layout.sizes.items()), 0])
    for group, scale, rows in layout.blocks():
        for draw in range(len(rows)):
            out.writerow(
                [
                    *(
                        json.dumps(_value(key, size, scale if group in (ALL, key) else 0.0, drawn[key][draw]))
                        for key, size in layout.sizes.items()
                    ),
                    int(seeds[draw]),
                ]
            )
    return text.getvalue()


def _units(key: str, size: float | list[float], draws: int, seed: int) -> np.ndarray:
    """Standard normal numbers, none beyond TRUNCATED, shape (draws, components)."""
    name = key.removeprefix("errors.")
    place = (*WHOLE, *EACH).index(name)  # an error keeps its numbers when another is added
    shares = np.random.default_rng([seed, place]).random((draws, np.size(size)))
    return truncated_normal(0.0, 1.0, TRUNCATED)(shares)


def _value(key: str, size: float | list[float], scale: float, units: np.ndarray) -> float | list[float]:
    if not isinstance(size, list) and key.removeprefix("errors.") in EACH:
        return size * scale
    values = [float(s * scale * u) for s, u in zip(np.atleast_1d(size), units)]
    return values if isinstance(size, list) else values[0]
