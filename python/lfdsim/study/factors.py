"""A factor of a study: the key or keys of the display that it changes, and the values that these take."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any, TypeGuard

import numpy as np

Quantile = Callable[[np.ndarray], np.ndarray]  # of a distribution: shares of 0 to 1 -> values
Value = bool | int | float | str | list[Any] | None


@dataclasses.dataclass(frozen=True)
class Factor:
    """Has either `levels` (a list of what `keys` become together: one tuple for each level) or a distribution of one number."""

    keys: tuple[str, ...]
    levels: tuple[tuple[Value, ...], ...] = ()
    quantile: Quantile | None = None
    times: tuple[float, ...] = ()  # each key is the drawn number times this
    kind: str = "values"  # the word by which the file gives the values: "from", "normal" ...

    @property
    def name(self) -> str:
        return self.keys[0]

    def at_shares(self, shares: np.ndarray) -> dict[str, list[Value]]:
        """Columns of values for shares of 0 up to 1, shape (rows,): of the distribution, or of levels that are equally likely."""
        if self.quantile is None:
            return self.at_levels(np.minimum((shares * len(self.levels)).astype(int), len(self.levels) - 1))
        drawn = self.quantile(shares)
        return {key: (drawn * by if by != 1 else drawn).tolist() for key, by in zip(self.keys, self.times)}

    def at_levels(self, indices: np.ndarray) -> dict[str, list[Value]]:
        return {key: [self.levels[i][k] for i in indices] for k, key in enumerate(self.keys)}


def truncated_normal(mean: float, sd: float, truncated: float) -> Quantile:
    """Beyond `truncated` standard deviations nothing is drawn."""
    from scipy.special import ndtr, ndtri

    low, high = ndtr(-truncated), ndtr(truncated)
    return lambda shares: mean + sd * np.clip(ndtri(low + shares * (high - low)), -truncated, truncated)


def uniform(low: float, high: float) -> Quantile:
    return lambda shares: low + shares * (high - low)


def integers(low: int, high: int) -> Quantile:
    """Both ends included."""
    return lambda shares: low + np.minimum(np.floor(shares * (high - low + 1)), high - low).astype(np.int64)


def triangular(low: float, mode: float, high: float) -> Quantile:
    share = (mode - low) / (high - low)
    return lambda shares: np.where(
        shares < share, low + np.sqrt(shares * (high - low) * (mode - low)), high - np.sqrt((1 - shares) * (high - low) * (high - mode))
    )


def steps(low: float, high: float, count: int) -> tuple[float, ...]:
    """Evenly spaced, both ends exact; whole numbers stay whole where all of them are."""
    if isinstance(low, int) and isinstance(high, int) and (high - low) % (count - 1) == 0:
        return tuple(low + k * (high - low) // (count - 1) for k in range(count))
    return tuple(low if k == 0 else high if k == count - 1 else low + (high - low) * k / (count - 1) for k in range(count))


def is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
