"""tolerance.html: percentiles of a display's figures under its errors, and the budget of the errors."""

from __future__ import annotations

import html
import pathlib
from typing import TYPE_CHECKING

import numpy as np

from .. import files
from . import page, plots
from ..errors import ALL
from ..problems import counted, most_often
from ..tolerances import EXTRAPOLATED, Tolerance, fewest_draws

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

NAME = "tolerance.html"
STYLE = "\nbody{max-width:none}p{max-width:60em}td:first-child{overflow-wrap:anywhere;min-width:12em}td,th{padding:.15em .45em}"


def write(found: Tolerance, percent: float) -> pathlib.Path:
    layout = found.layout
    parts = [
        f"<h1>Tolerances</h1><p>{html.escape(' '.join(_counts(found)))} All rows are in study.parquet.</p>",
        *(_budget(found, lines, percent) for lines in _losses(found)),
        "<h2>Sizes of the errors</h2>" + page.table(["error", "size"], [[k, str(v)] for k, v in layout.sizes.items()]),
        "<p class=note>Of the whole array: the standard deviation of a normal distribution about zero, cut off at 3. Of each lens "
        "(_sd): as the display draws them.</p>",
    ]
    if len(found.percentiles):
        head = ["figure", *found.percentiles.columns]
        parts.append(
            "<h2>Figures</h2>"
            + page.table(
                head,
                [[name, *(f"{x:.5g}" for x in line)] for name, line in zip(found.percentiles.index, found.percentiles.astype(float).values.tolist())],
            )
            + "<p class=note>Percentiles: so many displays are below. Figures that errors do not change are left out.</p>"
        )
    text = (
        f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Tolerances</title><style>{page.STYLE}{STYLE}</style>\n"
        + "\n".join(parts)
        + "\n</html>\n"
    )
    files.write_whole(found.folder / NAME, text.encode())
    return found.folder / NAME


def _counts(found: Tolerance) -> list[str]:
    """How many draws there are, and how many of them are impossible: of all errors together, and of each alone and at other sizes."""
    layout, sentences = found.layout, []
    blocks: dict[str, list[int]] = {"of all errors together": [], "of each error alone and at other sizes": []}
    for group, scale, block in layout.blocks():
        blocks["of all errors together" if group == ALL and scale == 1 else "of each error alone and at other sizes"] += list(block)
    for what, numbers in blocks.items():
        reasons = found.rows["error"].iloc[numbers].dropna()
        if numbers:
            sentences.append(f"{counted(len(numbers), 'draw')} {what}, {len(reasons)} of them impossible{most_often(reasons)}.")
    if layout.table:
        sentences.append(f"All rows, also the one without errors, have the errors of errors.table ({layout.table}).")
    return sentences


SHORT = ("without errors", "5 %", "50 %", "95 %")


def summary(found: Tolerance, percent: float) -> list[str]:
    """For a terminal 100 columns wide: a line for each figure, and for each loss and error."""
    lines = [*_counts(found)]
    if len(found.percentiles):
        lines += ["", f"{'figure':<48}" + "".join(f"{name:>15}" if name == SHORT[0] else f"{name:>12}" for name in SHORT)]
        for name, line in found.percentiles.iterrows():
            numbers = [f"{line[column]:>{15 if column == SHORT[0] else 12}.5g}" for column in SHORT]
            lines += [f"{name:<48}" + "".join(numbers)] if len(str(name)) < 48 else [str(name), " " * 48 + "".join(numbers)]
    for of_it in _losses(found):
        first = of_it.iloc[0]
        lines += ["", f"Budget for {first['loss']}: it may {WAYS[first['way']]} {first['allowed']:g}"]
        for _, line in of_it.iterrows():
            size = "" if line["error"] == ALL else f", {_sizes(line)}"
            scale = _scale(line)
            known = f"{scale} of its size{size}; " if scale else ""
            lines.append(f"  {line['error']}: {known}{line['how']}")
        lines += [f"  {reason}"] if (reason := _too_few(of_it, percent)) else []
    return lines


WAYS = {"change": "change by", "fall": "fall by", "rise": "rise by"}


def _losses(found: Tolerance) -> list[pd.DataFrame]:
    """The budget's lines of each loss."""
    return [lines for _, lines in found.budget.groupby(["loss", "way", "allowed"], sort=False)] if len(found.budget) else []


def _budget(found: Tolerance, lines: pd.DataFrame, percent: float) -> str:
    first = lines.iloc[0]
    may = WAYS[first["way"]]
    rows = [
        [
            line["error"],
            str(line["size"]) if line["error"] != ALL else "",
            f"{line['at 1']:.4g}",
            _scale(line),
            _sizes(line),
            line["how"],
        ]
        for _, line in lines.iterrows()
    ]
    head = ["error", "size", f"loss that {percent:g} % do not exceed", "allowed scale", "allowed size", ""]
    return (
        f"<h2>Budget for {html.escape(first['loss'])}</h2><p>In {percent:g} % of all displays it may {may} {first['allowed']:g} at most. {_too_few(lines, percent)}</p>"
        + page.table(head, rows)
        + _curves(found, lines, first["allowed"])
    )


def _too_few(lines: pd.DataFrame, percent: float) -> str:
    """Why known scales have no interval, where that is so; those that are extrapolated say it themselves."""
    unsure = lines["allowed scale"].notna() & lines["allowed scale from"].isna() & (lines["how"] != EXTRAPOLATED)
    reason = (
        f"At {percent:g} % an allowed scale has an interval only with {fewest_draws(percent)} draws or more; make more draws (--draws, --alone)."
    )
    return reason if unsure.any() else ""


def _scale(line: pd.Series) -> str:
    """The allowed scale and its interval, whose bounds are not known beyond the scales tried; nothing where the scale is not known."""
    if np.isnan(line["allowed scale"]):
        return ""
    low, high = line["allowed scale from"], line["allowed scale to"]
    tried = [float(name.removeprefix("at ")) for name in line.index if name.startswith("at ")]
    bounds = f"{low:.3g}{' or less' * (low == min(tried))} to {high:.3g}{' or more' * (high == max(tried))}"
    return f"{line['allowed scale']:.3g}" + ("" if np.isnan(low) or low == high else f" ({bounds})")


def _sizes(line: pd.Series) -> str:
    return "" if line["error"] == ALL or np.isnan(line["allowed scale"]) else ", ".join(f"{x:.4g}" for x in np.atleast_1d(line["allowed size"]))


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
