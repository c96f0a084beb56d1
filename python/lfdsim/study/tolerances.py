"""What errors of making cost: draws of a display's errors, percentiles of its figures, and how large each error may be for a given loss."""

from __future__ import annotations

import dataclasses
import itertools
import math
import pathlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

import lfdsim
from lfdsim.toml_text import toml_text

from . import api, errors, files, planned, runs, work
from .columns import is_uncertainty
from .errors import ALL, Layout
from .factors import is_number
from .file import MOST_ROWS, Objective
from .problems import StudyError, counted, most_often, nearest, path_of, whole

if TYPE_CHECKING:
    import pandas

PERCENT = (1, 5, 25, 50, 75, 95, 99)
SIZE = [480, 270]
CERTAIN = 0.95  # of studies whose interval of a scale holds the true one
ROUNDING = 1e-12  # of a figure: what it changes by less is no change
WAYS = ("change", "fall", "rise")
EXTRAPOLATED = "extrapolated below the smallest size tried; state a smaller one to measure it"
LEAST_EXTRAPOLATED = 0.1  # of the smallest scale tried: below it a power law says nothing
MEASURES = ("picture", "fov", "crosstalk")


@dataclasses.dataclass(frozen=True)
class Loss:
    """How far a figure may go from that of the display without errors. way: "change" (either way), "fall" or "rise"."""

    figure: str
    amount: float
    way: str = "change"

    def __post_init__(self) -> None:
        if not (is_number(self.amount) and self.amount > 0) or self.way not in WAYS:
            raise StudyError(f"Loss of {self.figure}", f"is {self.amount!r}, {self.way!r}; give an amount above 0, and one of {WAYS}")

    def of(self, figure: np.ndarray, without: float) -> np.ndarray:
        change = np.asarray(figure, float) - without
        return np.abs(change) if self.way == "change" else np.maximum(-change if self.way == "fall" else change, 0.0) + 0.0

    @staticmethod
    def parse(text: str) -> "Loss":
        """FIGURE=AMOUNT; with a sign it may only fall (-) or rise (+) by as much, which the other way is no loss."""
        figure, _, amount = (part.strip() for part in text.rpartition("="))
        try:
            number = float(amount)
        except ValueError:
            number = 0.0
        if not figure or number == 0 or not np.isfinite(number):
            raise StudyError(
                f"--loss {text}", "is not FIGURE=AMOUNT, as in picture.ssim=-0.02 (falls), crosstalk...=+1 (rises), ...=5 (either way)"
            )
        return Loss(figure, abs(number), "fall" if amount.startswith("-") else "rise" if amount.startswith("+") else "change")


@dataclasses.dataclass(frozen=True)
class Tolerance:
    """draws: all errors together, a row each. percentiles: a line for each figure. budget: a line for each loss and error."""

    folder: pathlib.Path
    layout: Layout
    without: "pandas.Series"
    rows: "pandas.DataFrame"
    draws: "pandas.DataFrame"
    percentiles: "pandas.DataFrame"
    budget: "pandas.DataFrame"


def tolerance(
    display: api.Path,
    folder: api.Path,
    draws: int = 200,
    *,
    alone: int | None = None,
    measures: tuple[str | dict[str, Any], ...] = MEASURES,
    losses: tuple[Loss, ...] = (),
    percent: float = 95.0,
    seed: int = 0,
    set: Mapping[str, Any] | None = None,
    dask: object = None,
    workers: int | None = None,
    threads: int = 1,
    progress: bool | None = None,
) -> Tolerance:
    """Draws the errors whose sizes the display's [errors] states, and measures each draw.

    Errors of the array (shift, gap, rotation, pitch, wedge, bow) are normal about zero, and what the display states is their standard
    deviation; those of each lens are drawn anew each time. `alone`: draws of each error alone, at half, once and twice its size (None: three tenths
    of `draws`; 0: none, and no budget). `measures`: names (`picture`: likeness to the scene), or tables as in a study's file. `losses`: what
    `percent` of all displays must keep; the budget says which sizes allow that. `set`: keys of the description with other values, sizes
    of errors among them, as in {"errors.gap_mm": 0.02}; as the program's --set.
    """
    display, folder = path_of(display, "display"), path_of(folder, "folder")
    draws, seed = whole(draws, "draws", 1, MOST_ROWS), whole(seed, "seed", 0, 2**63 - 1)
    alone = alone if alone is None else whole(alone, "alone", 0, MOST_ROWS)
    if not (is_number(percent) and 0 < percent < 100):
        raise StudyError("percent", f"is {percent!r}; give a number above 0 and below 100")
    if not (isinstance(measures, (tuple, list)) and all(isinstance(m, (str, dict)) for m in measures)):
        raise StudyError("measures", f"is {measures!r}; give a tuple of names or tables, as in {MEASURES}")
    if not (isinstance(losses, (tuple, list)) and all(isinstance(loss, Loss) for loss in losses)):
        raise StudyError("losses", f'is {losses!r}; give a tuple of losses, as in (Loss.parse("picture.ssim=-0.02"),)')
    _check_names(measures, losses)
    runs.check_machines(dask, workers, threads, progress)
    changes = dict(set or {})
    described = work.changed(planned.display_in(display, changes)[1], display.parent, changes)
    alone = max(10, draws * 3 // 10) if alone is None else alone
    layout = Layout(errors.sizes_of(described, display), draws, alone, table=described["errors.table"] or "")
    if layout.rows > MOST_ROWS:
        many = f"{draws} and {layout.alone} of each error alone are {layout.rows} rows"
        raise StudyError("draws", f"{many}; at most {MOST_ROWS} are possible")
    with files.held(folder):
        if not (folder / "plan.json").exists():
            files.refuse_foreign(folder / "tolerance.html")
        _keep(folder / "draws.csv", errors.rows_csv(layout, seed))
        _keep(folder / "tolerance.toml", _study_text(display, measures, changes))
        plan = api.plan(folder / "tolerance.toml", folder)
    # As objectives they are found to be figures, or not, after the first chunk.
    wishes = tuple(Objective(loss.figure, "low") for loss in losses)
    plan = dataclasses.replace(plan, study=dataclasses.replace(plan.study, objectives=wishes))
    table = runs.finish(plan, dask, workers, threads, progress).to_pandas()
    return evaluate(folder, layout, table, losses, percent)


def _check_names(measures: tuple[str | dict[str, Any], ...], losses: tuple[Loss, ...]) -> None:
    """Before anything is written or measured. What tables say is checked with the study's file."""
    known = ["picture", "check", *(m.name for m in lfdsim.measures())]
    for name in (m for m in measures if isinstance(m, str)):
        if name not in known:
            raise StudyError("measures (--measure)", f'"{name}" is not a measure; {nearest(name, known)}')
        if measures.count(name) > 1:
            raise StudyError("measures (--measure)", f'"{name}" is given more than once')
    labels = [m if isinstance(m, str) else str(m.get("label", m.get("name"))) for m in measures]
    for loss in losses:
        if losses.count(loss) > 1:
            raise StudyError(f"losses (--loss) {loss.figure}", "is given more than once with this amount")
        label = loss.figure.partition(".")[0]
        if label not in labels:
            raise StudyError(f"losses (--loss) {loss.figure}", f"is of no measure here; {nearest(label, labels)}")


def _keep(path: pathlib.Path, text: str) -> None:
    """As it was when rows were planned."""
    if path.exists() and files.read_text(path) == text:
        return
    if not (path.parent / "plan.json").exists():
        files.refuse_foreign(path)
    else:
        raise StudyError(path.parent, f"holds another study ({path.name} differs); give another folder, or remove this one")
    files.write_whole(path, text.encode())


def _study_text(display: pathlib.Path, measures: tuple[str | dict[str, Any], ...], fixed: Mapping[str, Any]) -> str:
    text = f'schema = 1\ndisplay = {toml_text(str(display.resolve()))}\ndesign = "table"\ntable = "draws.csv"\n'
    if fixed:
        text += "\n[set]\n" + "".join(f"{toml_text(key)} = {toml_text('none' if value is None else value)}\n" for key, value in fixed.items())
    for measure in measures:
        if isinstance(measure, dict):
            settings = measure.get("settings", {})
            text += "\n[[measure]]\n" + "".join(f"{k} = {toml_text(v)}\n" for k, v in measure.items() if k != "settings")
            text += "[measure.settings]\n" + "".join(f"{k} = {toml_text(v)}\n" for k, v in settings.items()) if settings else ""
        elif measure == "picture":
            text += f'\n[[picture]]\nname = "picture"\nsize = {SIZE}\ncompare = true\n'
        elif measure == "check":
            text += '\n[[measure]]\nname = "check"\n'
        else:
            text += f"\n[[measure]]\nname = {toml_text(measure)}\n[measure.settings]\nsize = {SIZE}\n"
    return text


def evaluate(folder: pathlib.Path, layout: Layout, rows: "pandas.DataFrame", losses: tuple[Loss, ...], percent: float) -> Tolerance:
    without = rows.iloc[0]
    if isinstance(without["error"], str):
        raise StudyError(folder, f"the display without errors is impossible: {without['error']}")
    block = next(r for g, s, r in layout.blocks() if g == ALL and s == 1)
    together = rows.iloc[block.start : block.stop]
    kept = together[together["error"].isna()].reset_index(drop=True)
    names = [n for n in rows.columns[2 + len(layout.sizes) : -1] if rows[n].dtype == float]
    for loss in losses:
        if loss.figure not in names:
            raise StudyError(f"loss {loss.figure}", f"is not a figure; {nearest(loss.figure, names)}")
    return Tolerance(
        folder, layout, without, rows, kept, _percentiles(kept, without, names), _budget(layout, rows, without, losses, percent)
    )


def _percentiles(kept: "pandas.DataFrame", without: "pandas.Series", names: list[str]) -> "pandas.DataFrame":
    import pandas

    lines = {}
    for name in (n for n in names if not is_uncertainty(n)):
        values = kept[name].to_numpy(float)
        values = values[np.isfinite(values)]
        if len(values) and not np.allclose(values, without[name], rtol=ROUNDING, atol=0):
            lines[name] = {
                "without errors": without[name],
                "draws": len(values),
                "mean": values.mean(),
                "standard deviation": values.std(ddof=1) if len(values) > 1 else 0.0,
                **{f"{p} %": np.percentile(values, p) for p in PERCENT},
            }
    return pandas.DataFrame.from_dict(lines, orient="index")


def _budget(
    layout: Layout, rows: "pandas.DataFrame", without: "pandas.Series", losses: tuple[Loss, ...], percent: float
) -> "pandas.DataFrame":
    """For each loss and group: the smallest loss that `percent` of draws do not exceed at each scale; the scale at which that is the
    allowed loss, and the interval of that scale. An impossible display, or one without the figure, has lost it."""
    import pandas

    lines = []
    for loss in losses if layout.alone else ():
        for group in layout.groups:
            lost, at, cut = {}, {}, {}
            for scale, block in ((s, r) for g, s, r in layout.blocks() if g == group):
                drawn = rows.iloc[block.start : block.stop][: layout.alone]  # the same draws at each scale
                losses_of = loss.of(drawn[loss.figure].to_numpy(float), without[loss.figure])
                lost[scale] = np.sort(np.where(np.isfinite(losses_of), losses_of, np.inf))
                at[scale] = float(lost[scale][rank_of(len(drawn), percent) - 1])
                if np.isinf(at[scale]):
                    cut[scale] = _why_none(drawn["error"], lost[scale])
            scale, how = allowed_scale(at, loss.amount, cut)
            # How far the loss departs from a power of the scale below what was tried is not known.
            low, high = (np.nan, np.nan) if how == EXTRAPOLATED else _interval(lost, loss.amount, percent)
            if not np.isfinite(without[loss.figure]):
                how = "unknown: the display without errors has no such figure, or an infinite one"
            size = layout.sizes.get(group)
            lines.append(
                {
                    "loss": loss.figure,
                    "allowed": loss.amount,
                    "way": loss.way,
                    "error": group,
                    "size": size,
                    **{f"at {s:g}": v for s, v in at.items()},
                    "allowed scale": scale,
                    "allowed scale from": low,
                    "allowed scale to": high,
                    "how": how,
                    "allowed size": None if size is None else (np.asarray(size) * scale).tolist(),
                }
            )
    return pandas.DataFrame(lines)


def rank_of(draws: int, percent: float) -> int:
    """Of the smallest draw that as many as `percent` of all do not exceed, counted from 1."""
    return max(1, math.ceil(draws * percent / 100 - 1e-9))


def ranks_about(draws: int, percent: float) -> tuple[int, int] | None:
    """Of two draws between which the percentile of all displays lies in CERTAIN of all studies, at least: the nearest two, by the binomial
    distribution of how many draws lie below it (Thompson 1936). None where even all draws are too few."""
    from scipy.stats import binom

    below = binom.cdf(np.arange(draws), draws, percent / 100)  # below[k]: the chance that at most k are
    ends = np.searchsorted(below, below + CERTAIN)
    starts = np.flatnonzero(ends < draws)
    if not len(starts):
        return None
    start = starts[np.argmin(ends[starts] - starts)]
    return int(start) + 1, int(ends[start]) + 1


def fewest_draws(percent: float) -> int:
    """With which ranks_about() are known: that all lie on one side of the percentile is then rare."""
    share = percent / 100
    return next(n for n in itertools.count(1) if share**n + (1 - share) ** n <= 1 - CERTAIN)


def _interval(lost: dict[float, np.ndarray], amount: float, percent: float) -> tuple[float, float]:
    """Where the allowed scale is in CERTAIN of all studies: the scales that ranks_about() allow. Bounds are cut at the smallest and
    largest scale tried. NaN where there are too few draws, or nothing was measured. `lost`: losses in rising order, by scale."""
    ranks = ranks_about(len(next(iter(lost.values()))), percent)
    if not ranks:
        return float("nan"), float("nan")
    high, low = (allowed_scale({s: float(values[rank - 1]) for s, values in lost.items()}, amount)[0] for rank in ranks)
    if not np.isfinite(high):
        return float("nan"), float("nan")
    return (max(low, min(lost)) if np.isfinite(low) else min(lost)), min(high, max(lost))


def _why_none(reasons: "pandas.Series", lost: np.ndarray) -> str:
    """Why so many draws of one block have no figure that nothing is known of the loss."""
    impossible = reasons.dropna()
    if len(impossible):
        return f"{len(impossible)} of {counted(len(lost), 'draw')} impossible{most_often(impossible)}"
    return f"{int((~np.isfinite(lost)).sum())} of {counted(len(lost), 'draw')} without a finite figure"


def allowed_scale(at: dict[float, float], amount: float, cut: Mapping[float, str] | None = None) -> tuple[float, str]:
    """Where the loss is `amount`, if it is a power of the scale between two measured ones; and how that is known. NaN where it is not.

    Towards small errors the power of the least two holds on; towards large ones, where displays become impossible, nothing is guessed.
    `at`: the loss by scale, infinite where it was not measured; `cut`: why it was not."""
    known = [s for s in sorted(at) if np.isfinite(at[s])]
    # What was not measured is no loss: it only ends what is known.
    missing = [s for s in sorted(at) if s not in known]
    why = f" (at {min(missing):g}: {(cut or {}).get(min(missing), 'nothing was measured')})" if missing else ""
    if not known:
        return float("nan"), f"unknown: nothing was measured{why}"
    loses = [s for s in known if at[s] > amount]
    if not loses:
        return known[-1], f"or more: larger ones were not measured{why}" if why else "or more: all that was tried keeps it"
    high = min(loses)  # what larger errors make up for again is not allowed: it would take all sizes between, too
    below = [s for s in known if s < high]
    if below:
        low = max(below)
        if at[low] <= 0 or at[high] <= at[low]:
            return low, f"or a little more: at {high:g} it loses more"
        return _power(at, low, high, amount), "between what was tried"
    if len(known) > 1 and at[high] < at[known[1]]:
        scale = _power(at, high, known[1], amount)
        if scale >= LEAST_EXTRAPOLATED * high:
            return scale, EXTRAPOLATED
    return float("nan"), f"less than {high:g} of its size, which loses more; state a smaller size to measure it{why}"


def _power(at: dict[float, float], low: float, high: float, amount: float) -> float:
    """The scale at which a loss is `amount` that is a power of the scale through two of `at`."""
    power = np.log(at[high] / at[low]) / np.log(high / low)
    return float(low * (amount / at[low]) ** (1 / power))
