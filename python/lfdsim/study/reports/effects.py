"""The effect of each factor on a figure: regression, Sobol indices, interactions, yield, Pareto front. Statistics are SciPy's."""

from __future__ import annotations

import dataclasses
import warnings

import numpy as np
from scipy import stats

from ..file import Limit, Objective


@dataclasses.dataclass(frozen=True)
class Regression:
    """y = sum of coefficient x (factor - mean)/sd + rest. A coefficient is what one standard deviation of the factor does to the
    figure, in the figure's unit; `errors` are half-widths of 95 % intervals; `explained` the share of the figure's variance (R squared)."""

    coefficients: np.ndarray
    errors: np.ndarray
    explained: float


def regression(factors: np.ndarray, figure: np.ndarray, of: np.ndarray | None = None) -> Regression | None:
    """factors (rows, factors). `of`: which row of the design each one repeats; replicates count as one, by their mean, since what a row
    has beyond the sum is the same in all of them. None where there are too few rows, or factors that follow from each other."""
    kept = np.isfinite(figure)
    y = figure[kept]
    _, first, place = np.unique((np.arange(len(figure)) if of is None else of)[kept], return_index=True, return_inverse=True)
    x, means = factors[kept][first], np.bincount(place, y) / np.bincount(place)
    free = len(means) - x.shape[1] - 1
    if free < 1 or np.any(x.std(0) == 0) or np.ptp(y) == 0:
        return None
    design = np.column_stack([np.ones(len(means)), (x - x.mean(0)) / x.std(0)])
    found, _, rank, _ = np.linalg.lstsq(design, means, rcond=None)
    if rank < design.shape[1]:
        return None
    fitted = design @ found
    variance = np.sum((means - fitted) ** 2) / free
    errors = stats.t.ppf(0.975, free) * np.sqrt(variance * np.diag(np.linalg.inv(design.T @ design)))
    return Regression(found[1:], errors[1:], float(1 - np.sum((y - fitted[place]) ** 2) / np.sum((y - y.mean()) ** 2)))


@dataclasses.dataclass(frozen=True)
class Sobol:
    """Shares of the figure's variance, shape (factors,): of each factor alone, and with its interactions; half-widths of 95 % intervals."""

    first: np.ndarray
    total: np.ndarray
    first_error: np.ndarray
    total_error: np.ndarray


def sobol(figure: np.ndarray, factors: int) -> Sobol:
    """Of all rows of a saltelli design, in their order: finite figures that are not all the same."""
    base = len(figure) // (factors + 2)
    a, b, ab = figure[:base], figure[base : 2 * base], figure[2 * base :].reshape(factors, 1, base)
    found = stats.sobol_indices(func={"f_A": a[None], "f_B": b[None], "f_AB": ab}, n=base)
    with warnings.catch_warnings():  # a factor without any effect has no spread either: its interval is NaN, and stands for 0
        warnings.simplefilter("ignore")
        spread = found.bootstrap(confidence_level=0.95, n_resamples=999)
    intervals = (spread.first_order.confidence_interval, spread.total_order.confidence_interval)
    halves = [np.nan_to_num(np.ravel(interval.high - interval.low) / 2) for interval in intervals]
    return Sobol(np.ravel(found.first_order), np.ravel(found.total_order), *halves)


def groups(values: np.ndarray, positions: np.ndarray | None, most: int = 8) -> tuple[np.ndarray, np.ndarray]:
    """Each row's group, and each group's mean value: levels as they are, or equally many rows in each."""
    if positions is None:
        edges = np.quantile(values, np.linspace(0, 1, most + 1)[1:-1])
        positions = np.searchsorted(edges, values, side="right")
    used, positions = np.unique(positions, return_inverse=True)
    return positions, np.array([values[positions == k].mean() for k in range(len(used))])


def cell_means(first: np.ndarray, second: np.ndarray, figure: np.ndarray) -> np.ndarray:
    """Mean of the figure where `first` and `second` are these groups, shape (groups of first, groups of second); NaN in empty cells."""
    shape = (first.max() + 1, second.max() + 1)
    cell = first * shape[1] + second
    kept = np.isfinite(figure)
    count = np.bincount(cell[kept], minlength=shape[0] * shape[1])
    with np.errstate(invalid="ignore"):
        means: np.ndarray = (np.bincount(cell[kept], figure[kept], shape[0] * shape[1]) / count).reshape(shape)
    return means


def interaction(means: np.ndarray) -> float:
    """Root mean square of what two factors do together beyond the sum of what each does, in the figure's unit. NaN with empty cells."""
    additive = means.mean(0, keepdims=True) + means.mean(1, keepdims=True) - means.mean()
    return float(np.sqrt(np.mean((means - additive) ** 2)))


def passes(figure: np.ndarray, limit: Limit) -> np.ndarray:
    """NaN does not pass."""
    low = -np.inf if limit.low is None else limit.low
    high = np.inf if limit.high is None else limit.high
    return np.asarray((figure >= low) & (figure <= high))


def share_with_interval(passed: np.ndarray, of: int) -> tuple[float, float, float]:
    """The share, and its 95 % interval. `passed`: of each row of the design, how many of its `of` replicates.

    Wilson's interval (J. Am. Stat. Assoc. 22, 1927) for as many independent draws as tell as much as these rows do: replicates of one
    row resemble each other (Dean and Pagano, J. Surv. Stat. Methodol. 3, 2015, with the design effect of Kish, Survey Sampling, 1965)."""
    draws = _independent_draws(passed / of, of)
    share, z2 = float(passed.mean() / of), float(stats.norm.ppf(0.975)) ** 2
    middle = (share + z2 / (2 * draws)) / (1 + z2 / draws)
    half = np.sqrt(z2 * (share * (1 - share) / draws + z2 / (4 * draws**2))) / (1 + z2 / draws)
    return share, max(0.0, float(middle - half)), min(1.0, float(middle + half))


def _independent_draws(shares: np.ndarray, of: int) -> float:
    """From one for each row, whose replicates then agree, to one for each replicate."""
    rows, share = len(shares), shares.mean()
    if rows == 1 or share in (0, 1):  # nothing tells how much replicates differ
        return rows
    variance = shares.var(ddof=1) / rows
    return rows * of if variance == 0 else min(1 + share * (1 - share) / variance, rows * of)


def pareto(figures: np.ndarray, objectives: tuple[Objective, ...]) -> np.ndarray:
    """Of figures (rows, objectives) those rows that none surpasses: none is as good in all and better in one. NaN is not on the front."""
    costs = figures * np.array([-1.0 if o.best == "high" else 1.0 for o in objectives])
    front: np.ndarray = np.isfinite(costs).all(1)
    order = np.lexsort(costs.T[::-1])  # a row can only be surpassed by one before it
    best = np.empty((0, costs.shape[1]))
    for row in order:
        if not front[row]:
            continue
        if np.any(np.all(best <= costs[row], 1) & np.any(best < costs[row], 1)):
            front[row] = False
        else:
            best = np.vstack([best, costs[row]])
    return front
