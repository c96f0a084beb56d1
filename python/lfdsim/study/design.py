"""The rows of a study: what each changes in the display. A pure function of the study's file."""

from __future__ import annotations

import csv
import itertools
import json
import math
import pathlib

import numpy as np

from .factors import Value
from .file import MOST_ROWS, SAMPLED, Study
from .problems import StudyError, counted

Columns = dict[str, list[Value]]


def rows_of(study: Study, replicate_keys: tuple[str, ...]) -> Columns:
    """One list for each key, all of the same length; `replicate` counts from 0 where a row is repeated with other seeds."""
    if study.design in SAMPLED:
        _check_count(study, study.rows * (len(study.factors) + 2 if study.design == "saltelli" else 1))
    columns = _grid(study) if study.design == "grid" else _table(study.table) if study.table else _sampled(study)
    count = len(next(iter(columns.values())))
    _check_count(study, count)
    if study.replicates == 1:
        return columns
    for key in replicate_keys:
        if key in columns or key in study.fixed:
            raise StudyError(f"{study.path}: replicates", f"change {key}, which the study sets itself; give other replicate_keys")
    repeats: list[Value] = list(range(study.replicates))
    repeated: Columns = {"replicate": repeats * count}
    repeated |= {key: [v for v in values for _ in range(study.replicates)] for key, values in columns.items()}
    # The same seeds for every setting: what differs between settings is then theirs, not chance's.
    seeds: list[Value] = [int(np.random.SeedSequence([study.seed, r]).generate_state(1)[0]) for r in range(study.replicates)]
    return repeated | {key: seeds * count for key in replicate_keys}


def _check_count(study: Study, rows: int) -> None:
    """Before there are any in memory."""
    if rows * study.replicates > MOST_ROWS:
        many = f"{rows * study.replicates} rows; at most {MOST_ROWS} are possible"
        raise StudyError(study.path, f"has {many}: take fewer, or several studies")


def _grid(study: Study) -> Columns:
    """The last factor changes fastest."""
    columns: Columns = {}
    shape = [len(f.levels) for f in study.factors]
    _check_count(study, math.prod(shape))
    for factor, indices in zip(study.factors, np.unravel_index(np.arange(np.prod(shape)), shape)):
        columns |= factor.at_levels(indices)
    return columns


def shares_of(design: str, rows: int, dimensions: int, seed: int) -> np.ndarray:
    """Points of the unit cube, shape (rows, dimensions).

    Of saltelli (rows * (dimensions + 2), dimensions): A, B, and A with each column of B.
    """
    from scipy.stats import qmc

    random = np.random.default_rng(seed)
    if design == "monte_carlo":
        return random.random((rows, dimensions))
    if design == "lhs":
        return qmc.LatinHypercube(dimensions, rng=random).random(rows)
    columns = 2 * dimensions if design == "saltelli" else dimensions
    points = qmc.Sobol(columns, rng=random).random_base2(int(np.ceil(np.log2(rows))))[:rows]
    if design == "sobol":
        return points
    a, b = points[:, :dimensions], points[:, dimensions:]
    mixed = [np.where(np.arange(dimensions) == k, b, a) for k in range(dimensions)]
    return np.concatenate([a, b, *mixed])


def _sampled(study: Study) -> Columns:
    try:
        shares = shares_of(study.design, study.rows, len(study.factors), study.seed)
    except ValueError as error:
        raise StudyError(f"{study.path}: design", f'"{study.design}" is not possible with these factors and rows: {error}') from error
    columns: Columns = {}
    for factor, share in zip(study.factors, shares.T):
        columns |= factor.at_shares(share)
    return columns


def _table(path: pathlib.Path) -> Columns:
    """A CSV file with a key at the head of each column; an empty cell leaves the key as it is in the display."""
    if path.exists() and not path.is_file():
        raise StudyError(path, "is not a file; give a table of rows")
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = list(itertools.islice(csv.reader(file), MOST_ROWS + 2))
    except (OSError, ValueError, csv.Error) as error:
        raise StudyError(path, f"cannot be read: {error}") from error
    if len(lines) < 2:
        raise StudyError(path, "has no rows; give a line of keys and a line for each row")
    keys = [key.strip() for key in lines[0]]
    if "replicate" in keys:
        raise StudyError(f"{path}:1", "replicate is what the study calls its own repetitions, and no key; give another column")
    if len(set(keys)) < len(keys) or "" in keys:
        raise StudyError(f"{path}:1", "names a key twice or not at all; give each column one key")
    for number, line in enumerate(lines[1:], 2):
        if len(line) != len(keys):
            raise StudyError(f"{path}:{number}", f"has {counted(len(line), 'cell')}; give {len(keys)}, one for each key")
    return {key: [_cell(line[k]) for line in lines[1:]] for k, key in enumerate(keys)}


def changes_of(study: Study) -> list[str]:
    """The keys that rows change."""
    return list(_table(study.table)) if study.table else [key for factor in study.factors for key in factor.keys]


def texts_of_table(study: Study) -> list[str]:
    """Each once: some are names of files."""
    if not study.table:
        return []
    return sorted({value for values in _table(study.table).values() for value in values if isinstance(value, str)})


def _cell(text: str) -> Value:
    """Numbers, true, false and lists as in JSON; all else is a text. None: left as it is."""
    if not text.strip():
        return None
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):  # a number of thousands of digits, lists in lists
        return text
    return value if isinstance(value, (bool, int, float, str, list)) else text


def overrides(columns: Columns, row: int) -> dict[str, Value]:
    return {key: values[row] for key, values in columns.items() if key != "replicate" and values[row] is not None}
