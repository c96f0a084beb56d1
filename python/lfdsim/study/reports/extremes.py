"""The best, the middle and the worst row by the first objective, each with a picture."""

from __future__ import annotations

import io

import matplotlib.image
import numpy as np

import lfdsim

from .. import pictures, work
from ..chunk import overrides_of
from .data import Data

COLUMNS = 480  # of a picture that is made for the report


def extremes(data: Data) -> list[tuple[str, int, bytes | str]]:
    """(title, place in data.rows, PNG or why there is none)."""
    objective = data.plan.study.objectives[0]
    figure = data.rows[objective.figure].to_numpy(float)
    order = np.argsort(-figure if objective.best == "high" else figure, kind="stable")
    order = order[~np.isnan(figure[order])]
    if not len(order):
        return []
    return [
        (title, int(order[at]), _picture(data, int(data.rows["row"].iloc[order[at]])))
        for title, at in (("best", 0), ("middle", len(order) // 2), ("worst", -1))
    ]


def _picture(data: Data, row: int) -> bytes | str:
    """Of the study's first picture, or made now."""
    plan = data.plan
    if plan.study.pictures:
        return png(pictures.read(plan, row, plan.study.pictures[0].name))
    try:
        display = work.changed(plan.display, plan.display_folder, overrides_of(plan, row))
        width, height = display["camera.resolution"]
        share = min(1.0, COLUMNS / width)
        return png(lfdsim.render(display, size=(max(1, round(width * share)), max(1, round(height * share))), progress=False))
    except (ValueError, RuntimeError) as error:
        return f"no picture: {error}"


def png(linear: np.ndarray) -> bytes:
    """sRGB of linear light (height, width, 3); brighter than white is white."""
    light = np.clip(np.nan_to_num(linear), 0, 1)
    coded = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    file = io.BytesIO()
    matplotlib.image.imsave(file, np.round(255 * coded).astype(np.uint8), format="png")
    return file.getvalue()
