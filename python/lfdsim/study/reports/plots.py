"""The plots of a study's report, each as the text of an SVG."""

from __future__ import annotations

import io
import itertools
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ParamSpec

import matplotlib
import numpy as np

with warnings.catch_warnings():  # no plot here has three dimensions, whose part of matplotlib may be of another version on Debian
    warnings.filterwarnings("ignore", "Unable to import Axes3D")
    from matplotlib.figure import Figure

from . import effects
from .data import Data

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.typing import RcKeyType

STYLE: dict[RcKeyType, Any] = {
    "svg.hashsalt": "lfdsim",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 9,
    "axes.formatter.useoffset": False,
}
BLUE, ORANGE, GREY = "#2563a8", "#c8641e", "#9aa3ad"
MOST_DOTS = 2000
Arguments = ParamSpec("Arguments")


def svg(figure: Figure) -> str:
    text = io.StringIO()
    figure.savefig(text, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": None})
    return text.getvalue()[text.getvalue().index("<svg") :]


def panels(count: int, columns: int = 4, height: float = 2.2, sharey: bool = False) -> tuple[Figure, list[Axes]]:
    columns = min(columns, count)
    rows = -(-count // columns)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(2.6 * columns, height * rows), layout="constrained")
        axes = list(np.atleast_1d(figure.subplots(rows, columns, squeeze=False, sharey=sharey)).ravel())
    for spare in axes[count:]:
        spare.set_visible(False)
    return figure, axes


def drawn(plot: Callable[Arguments, Figure]) -> Callable[Arguments, str]:
    """Styles hold while an SVG is written, too."""

    def wrapped(*args: Arguments.args, **more: Arguments.kwargs) -> str:
        with matplotlib.rc_context(STYLE):
            return svg(plot(*args, **more))

    return wrapped


@drawn
def histograms(data: Data) -> Figure:
    figure, axes = panels(len(data.figures))
    for axis, name in zip(axes, data.figures):
        values = data.rows[name].to_numpy(float)
        values = values[np.isfinite(values)]
        axis.hist(values, bins=min(40, max(5, int(np.sqrt(len(values))))), color=BLUE)
        for percent in (5, 50, 95) if len(values) else ():
            axis.axvline(np.percentile(values, percent), color="black", lw=1 if percent == 50 else 0.6, ls="-" if percent == 50 else ":")
        for limit in data.plan.study.limits:
            for at in (limit.low, limit.high) if limit.figure == name else ():
                if at is not None:
                    axis.axvline(at, color=ORANGE, lw=1.5)
        axis.set_title(name)
        axis.set_ylabel("rows")
    return figure


@drawn
def main_effects(data: Data, name: str) -> Figure:
    """The mean of a figure in each group of a factor's values, over all values of the others; dots are rows."""
    figure, axes = panels(len(data.factors), sharey=True)
    y = data.rows[name].to_numpy(float)
    dots = np.flatnonzero(np.isfinite(y))
    dots = dots[np.linspace(0, len(dots) - 1, min(len(dots), MOST_DOTS)).astype(int)]
    for axis, (factor, x) in zip(axes, data.factors.items()):
        positions, centres = effects.groups(x, data.positions.get(factor))
        means = [
            y[(positions == k) & np.isfinite(y)].mean() if np.any((positions == k) & np.isfinite(y)) else np.nan
            for k in range(len(centres))
        ]
        axis.scatter(x[dots], y[dots], s=4, color=GREY, alpha=0.5, linewidths=0, rasterized=len(dots) > 300)
        axis.plot(centres, means, "o-", color=BLUE, ms=4)
        if factor in data.levels and not _numeric(data.levels[factor]):
            axis.set_xticks(range(len(data.levels[factor])), data.levels[factor])
        axis.set_xlabel(factor)
        axis.locator_params(axis="x", nbins=4) if factor not in data.levels or _numeric(data.levels[factor]) else None
    axes[0].set_ylabel(name)
    return figure


def _numeric(levels: list[str]) -> bool:
    return all(level.replace(".", "").replace("-", "").replace("e", "").replace("+", "").isdigit() for level in levels)


Pair = tuple[float, str, str, np.ndarray, np.ndarray]  # strength, first factor, second, cell means, centres of the first's groups


def strongest_pairs(data: Data, name: str, most: int = 4) -> list[Pair]:
    """The strongest first."""
    y, pairs = data.rows[name].to_numpy(float), []
    grouped = {f: effects.groups(x, data.positions.get(f), 4) for f, x in data.factors.items()}
    for first, second in itertools.combinations(data.factors, 2):
        means = effects.cell_means(grouped[first][0], grouped[second][0], y)
        strength = effects.interaction(means)
        if np.isfinite(strength):
            pairs.append((strength, first, second, means, grouped[first][1]))
    return sorted(pairs, key=lambda p: -p[0])[:most]


@drawn
def interactions(data: Data, pairs: list[Pair], name: str) -> Figure:
    """Lines that are not parallel: what one factor does depends on the other."""
    figure, axes = panels(len(pairs), sharey=True, height=2.6)
    colours = matplotlib.colormaps["viridis"]
    for axis, (strength, first, second, means, centres) in zip(axes, pairs):
        _, seconds = effects.groups(data.factors[second], data.positions.get(second), 4)
        for k, centre in enumerate(seconds):
            label = data.levels[second][k] if second in data.levels else f"about {centre:.4g}"
            axis.plot(centres, means[:, k], "o-", ms=3, color=colours(k / max(1, len(seconds) - 1) * 0.9), label=label)
        axis.legend(title=second, fontsize=7, title_fontsize=7, frameon=False)
        axis.set_xlabel(first)
        axis.set_title(f"beyond the sum: {strength:.3g}")
    axes[0].set_ylabel(name)
    return figure


@drawn
def bars(
    names: list[str],
    values: np.ndarray,
    errors: np.ndarray,
    label: str,
    second: tuple[np.ndarray, np.ndarray] | None = None,
    labels: tuple[str, str] = ("", ""),
) -> Figure:
    """The largest above; `second` beside them (total indices beside first ones)."""
    order = np.argsort(np.abs(second[0] if second else values))
    figure, (axis,) = panels(1, height=0.6 + 0.32 * len(names))
    figure.set_figwidth(6)
    place, thick = np.arange(len(names)), 0.38 if second else 0.7
    axis.barh(place + (thick / 2 if second else 0), values[order], thick, xerr=errors[order], color=BLUE, ecolor="black", label=labels[0])
    if second:
        axis.barh(place - thick / 2, second[0][order], thick, xerr=second[1][order], color=ORANGE, ecolor="black", label=labels[1])
        axis.legend(frameon=False, loc="lower right")
    axis.set_yticks(place, [names[k] for k in order])
    axis.axvline(0, color="black", lw=0.6)
    axis.locator_params(axis="x", nbins=6)
    axis.set_xlabel(label)
    return figure


@drawn
def pareto(data: Data, front: np.ndarray) -> Figure:
    objectives = data.plan.study.objectives
    pairs = list(itertools.combinations(range(len(objectives)), 2))[:6]
    figure, axes = panels(len(pairs), columns=3, height=2.8)
    for axis, (i, j) in zip(axes, pairs):
        x, y = (data.rows[objectives[k].figure].to_numpy(float) for k in (i, j))
        axis.scatter(x[~front], y[~front], s=6, color=GREY, linewidths=0, rasterized=len(x) > 300)
        axis.scatter(x[front], y[front], s=16, color=ORANGE)
        axis.set_xlabel(f"{objectives[i].figure} ({objectives[i].best} is best)")
        axis.set_ylabel(f"{objectives[j].figure} ({objectives[j].best} is best)")
    return figure
