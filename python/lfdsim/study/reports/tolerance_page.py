"""tolerance.html: percentiles of a display's figures under its errors, and the budget of the errors."""

from __future__ import annotations

import html
import pathlib
from typing import TYPE_CHECKING

import numpy as np

from .. import files
from . import page, plots
from ..errors import ALL
from ..problems import counted
from ..tolerances import Tolerance

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

NAME = "tolerance.html"


def write(found: Tolerance, percent: float) -> pathlib.Path:
    layout = found.layout
    impossible = layout.draws - len(found.draws)
    parts = [
        f"<h1>Tolerances</h1><p>{counted(layout.draws, 'draw')} of all errors together, {impossible} of them impossible. "
        "All rows are in study.parquet.</p>",
        "<h2>Sizes of the errors</h2>" + page.table(["error", "size"], [[k, str(v)] for k, v in layout.sizes.items()]),
        "<p class=note>Of the whole array: the standard deviation of a normal distribution about zero, cut off at 3. Of each lens "
        "(_sd): as the display draws them.</p>",
    ]
    if len(found.percentiles):
        head = ["figure", *found.percentiles.columns]
        parts.append(
            "<h2>Figures</h2>"
            + page.table(
                head, [[name, *line] for name, line in zip(found.percentiles.index, found.percentiles.astype(float).values.tolist())]
            )
            + "<p class=note>Percentiles: so many displays are below. Figures that errors do not change are left out.</p>"
        )
    parts += [_budget(found, figure, percent) for figure in dict.fromkeys(found.budget["loss"])] if len(found.budget) else []
    text = (
        f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Tolerances</title><style>{page.STYLE}</style>\n"
        + "\n".join(parts)
        + "\n</html>\n"
    )
    files.write_whole(found.folder / NAME, text.encode())
    return found.folder / NAME


def _budget(found: Tolerance, figure: str, percent: float) -> str:
    lines = found.budget[found.budget["loss"] == figure]
    first = lines.iloc[0]
    may = {"change": "change by", "fall": "fall by", "rise": "rise by"}[first["way"]]
    rows = [
        [
            line["error"],
            str(line["size"]) if line["error"] != ALL else "",
            f"{line['at 1']:.4g}",
            f"{line['allowed scale']:.3g}",
            _sizes(line),
            line["how"],
        ]
        for _, line in lines.iterrows()
    ]
    head = ["error", "size", f"loss of the worst {100 - percent:g} %", "allowed scale", "allowed size", ""]
    return (
        f"<h2>Budget for {html.escape(figure)}</h2><p>It may {may} {first['allowed']:g} in {percent:g} % of all displays.</p>"
        + page.table(head, rows)
        + _curves(found, lines, first["allowed"])
    )


def _sizes(line: pd.Series) -> str:
    return "" if line["error"] == ALL else ", ".join(f"{x:.4g}" for x in np.atleast_1d(line["allowed size"]))


@plots.drawn
def _curves(found: Tolerance, lines: pd.DataFrame, allowed: float) -> Figure:
    """Loss over scale, both logarithmic: a straight line is a power law, its slope the power."""
    figure, (axis,) = plots.panels(1, height=3.4)
    figure.set_figwidth(7)
    scales = np.array(found.layout.scales)
    for _, line in lines.iterrows():
        losses = np.array([line[f"at {s:g}"] for s in scales])
        good = np.isfinite(losses) & (losses > 0)
        axis.plot(
            scales[good],
            losses[good],
            "o-",
            ms=4,
            lw=2.2 if line["error"] == ALL else 1,
            color="black" if line["error"] == ALL else None,
            label=line["error"],
        )
    axis.axhline(allowed, color=plots.ORANGE, label="allowed")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.yaxis.set_major_formatter("{x:g}")
    axis.yaxis.set_minor_formatter("")
    axis.set_xticks(scales, [f"{s:g}" for s in scales])
    axis.xaxis.minorticks_off()
    axis.set_xlabel("scale of the errors' sizes")
    axis.set_ylabel("loss")
    axis.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    return figure
