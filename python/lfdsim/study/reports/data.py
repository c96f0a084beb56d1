"""The rows of a study as a report sees them: numbers of factors, figures worth showing, rows that were possible."""

from __future__ import annotations

import dataclasses
import tomllib

import numpy as np
import pandas as pd

from ..collected import table_of
from ..columns import is_uncertainty
from ..planned import Plan

MOST_LEVELS = 12  # values of a factor that plots and groups show one by one
MOST_FIGURES = 8  # shown where neither limits nor objectives say which ones matter


@dataclasses.dataclass(frozen=True)
class Data:
    plan: Plan
    rows: pd.DataFrame  # the possible ones
    failed: pd.DataFrame  # the others, with `error`
    factors: dict[str, np.ndarray]  # numbers, shape (rows,); of texts, lists and unknown values the number of the level
    numbers: set[str]  # of the factors those that are numbers
    left_out: list[str]  # factors that are neither numbers nor of few levels
    levels: dict[str, list[str]]  # of factors with few values: their names, in the order of the factor's numbers, see `positions`
    positions: dict[str, np.ndarray]  # of those: the number of each row's level
    figures: list[str]  # shown: they vary


def read(plan: Plan) -> Data:
    table = table_of(plan).to_pandas()
    rows = table[table["error"].isna()].reset_index(drop=True)
    keys = [n for n in plan.table().column_names if n != "replicate" and not n.endswith(".seed")]
    factors, levels, positions, numbers, left_out = {}, {}, {}, set(), []
    for name in _representatives(plan, keys):
        column = _filled(plan, name, rows[name])
        distinct, position = _levels(column)
        if len(distinct) < 2:
            continue
        if _is_number(column):
            factors[name] = column.to_numpy(float)
            numbers.add(name)
        elif len(distinct) <= MOST_LEVELS:
            factors[name] = position.astype(float)
        else:
            left_out.append(name)
            continue
        if len(distinct) <= MOST_LEVELS:
            levels[name], positions[name] = distinct, position
    return Data(plan, rows, table[table["error"].notna()], factors, numbers, left_out, levels, positions, _figures(plan, rows))


def _is_number(column: pd.Series) -> bool:
    return pd.api.types.is_numeric_dtype(column) and not column.isna().any()


def _filled(plan: Plan, name: str, column: pd.Series) -> pd.Series:
    """With the display's own value where a cell is empty, if [set] or the description states a number."""
    value: object = plan.study.fixed.get(name)
    stem, _, last = name.rpartition(".")
    vector = plan.study.fixed.get(stem)
    if isinstance(vector, list) and last.isdigit() and int(last) < len(vector):
        value = vector[int(last)]
    if value is None:
        value = tomllib.loads(plan.display_text)
        for part in name.split("."):
            if isinstance(value, list) and part.isdigit() and int(part) < len(value):
                value = value[int(part)]
            else:
                value = value.get(part) if isinstance(value, dict) else None
    if isinstance(value, (int, float)) and not isinstance(value, bool) and pd.api.types.is_numeric_dtype(column):
        return column.fillna(value)
    return column


def _representatives(plan: Plan, keys: list[str]) -> list[str]:
    """Of keys that are tied the first alone."""
    return [f.name for f in plan.study.factors] if plan.study.factors else keys


def _levels(column: pd.Series) -> tuple[list[str], np.ndarray]:
    if _is_number(column):
        distinct, position = np.unique(column.to_numpy(), return_inverse=True)
        return [f"{v:.6g}" for v in distinct], position
    distinct, position = np.unique(column.fillna("-").astype(str).to_numpy(dtype=str), return_inverse=True)
    return distinct.tolist(), position


def _figures(plan: Plan, rows: pd.DataFrame) -> list[str]:
    named = [o.figure for o in plan.study.objectives] + [limit.figure for limit in plan.study.limits]
    if not named:
        start = list(rows.columns).index("row") + 1 + len(plan.table().column_names)
        named = [n for n in rows.columns[start:-1] if pd.api.types.is_numeric_dtype(rows[n]) and not is_uncertainty(n)]
        named = [n for n in named if _varies(rows[n])][:MOST_FIGURES]
    return list(dict.fromkeys(n for n in named if n in rows.columns and pd.api.types.is_numeric_dtype(rows[n]) and rows[n].notna().any()))


def _varies(column: pd.Series) -> bool:
    finite = column[np.isfinite(column)]
    return len(finite) > 1 and finite.max() - finite.min() > 1e-12 * np.abs(finite).max()
