"""A study's file: what is varied, how rows are chosen, what is measured, and what of it is wanted."""

from __future__ import annotations

import dataclasses
import pathlib
from typing import Any

from . import factors, files
from .factors import Factor, Quantile, Value
from .problems import StudyError, nearest
from .tables import Table

DESIGNS = ("grid", "lhs", "sobol", "monte_carlo", "saltelli", "table")
SAMPLED = ("lhs", "sobol", "monte_carlo", "saltelli")
MOST_ROWS = 10_000_000  # a table of which a large machine can still hold


@dataclasses.dataclass(frozen=True)
class Measure:
    """`check` or a measure of `lfdsim.analyze`. Figures are stored under `label.path`."""

    name: str
    label: str
    settings: dict[str, Any]
    figures: tuple[str, ...]  # wanted in the table; empty: all
    tables: tuple[str, ...]  # curves to be kept


@dataclasses.dataclass(frozen=True)
class Picture:
    """A view of the display, kept in linear light; with `compare` also its likeness to the scene itself."""

    name: str
    settings: dict[str, Any]  # of lfdsim.render: camera_mm, target_mm, size, samples, model
    compare: bool


@dataclasses.dataclass(frozen=True)
class Limit:
    """Of the yield: rows whose figure is in min .. max pass."""

    figure: str
    low: float | None
    high: float | None


@dataclasses.dataclass(frozen=True)
class Objective:
    figure: str
    best: str  # "high" or "low"


@dataclasses.dataclass(frozen=True)
class Study:
    path: pathlib.Path
    text: str
    display_path: pathlib.Path
    fixed: dict[str, Any]  # overrides of every row
    factors: tuple[Factor, ...]
    design: str
    table: pathlib.Path | None  # of design "table"
    rows: int  # of sampled designs; of saltelli the base samples
    seed: int
    replicates: int
    replicate_keys: tuple[str, ...]
    rows_per_chunk: int | None
    measures: tuple[Measure, ...]
    pictures: tuple[Picture, ...]
    limits: tuple[Limit, ...]
    objectives: tuple[Objective, ...]
    definition: dict[str, Any]  # what rows and their figures depend on, as it stands in the file

    @property
    def wished(self) -> list[str]:
        """The figures of limits and objectives."""
        return [limit.figure for limit in self.limits] + [objective.figure for objective in self.objectives]


def read_study(path: str | pathlib.Path) -> Study:
    path = pathlib.Path(path)
    text = files.read_text(path)
    values = files.parse_toml(text, path)
    top = Table(str(path), "", values)
    top.refuse_dates(values)
    top.integer("schema", low=1, high=1)
    design = top.text("design", among=DESIGNS)
    table = path.parent / top.text("table") if design == "table" else None
    fixed = dict(top.table("set", None).values)
    for key, value in fixed.items():
        if isinstance(value, dict):
            inner = next(iter(value), "...")
            raise top.wrong(f"[set] {key}", f'is a table; write each key in quotes, such as "{key}.{inner}" = ...')
    the_factors = tuple(_factor(t) for t in top.tables("factor"))
    _check_factors(top, design, the_factors, fixed)
    study = Study(
        path=path,
        text=text,
        display_path=path.parent / top.text("display"),
        fixed=fixed,
        factors=the_factors,
        design=design,
        table=table,
        rows=_rows(top, design),
        seed=top.integer("seed", 0),
        replicates=top.integer("replicates", 1, low=1, high=1_000_000),
        replicate_keys=tuple(top.items("replicate_keys", ())),
        rows_per_chunk=top.integer("rows_per_chunk", None, low=1, high=1_000_000),
        measures=tuple(_measure(t) for t in top.tables("measure")),
        pictures=tuple(_picture(t) for t in top.tables("picture")),
        limits=tuple(_limit(t) for t in top.tables("limit")),
        objectives=tuple(_objective(t) for t in top.tables("objective")),
        definition=_definition(values),
    )
    top.end()
    _check_measures(top, study)
    return study


def _factor(table: Table) -> Factor:
    if table.has("keys") and table.has("key"):
        raise table.wrong("keys", "stands beside key; give one of them")
    keys = tuple(table.items("keys")) if table.has("keys") else (table.text("key"),)
    kinds = [k for k in ("values", "from", "normal", "uniform", "triangular", "integers") if table.has(k)]
    if len(kinds) != 1:
        raise table.wrong(
            "",
            f"has {' and '.join(kinds) or 'no values'}; give one of: values, from with to and steps, normal, uniform, triangular, integers",
        )
    times = tuple(table.vector("times", len(keys), [1.0] * len(keys))) if kinds[0] != "values" else ()
    if kinds[0] == "values":
        factor = Factor(keys, _levels(table, keys))
    elif kinds[0] == "from":
        low, high, count = table.number("from"), table.number("to"), table.integer("steps", low=2, high=1_000_000)
        if low == high:
            raise table.wrong("to", f"is {high}, as from is; give another end, or values = [{high}]")
        levels = tuple(tuple(x * by if by != 1 else x for by in times) for x in factors.steps(low, high, count))
        factor = Factor(keys, levels, kind="from")
    else:
        factor = Factor(keys, (), _distribution(table.table(kinds[0]), kinds[0]), times, kinds[0])
    table.end()
    return factor


def _levels(table: Table, keys: tuple[str, ...]) -> tuple[tuple[Value, ...], ...]:
    values = table.items("values", kind=None, allowed="a list of values")
    if len(keys) == 1:
        return tuple((v,) for v in values)
    if not all(isinstance(v, list) and len(v) == len(keys) for v in values):
        raise table.wrong("values", f"of {len(keys)} keys are lists of {len(keys)} values each: [[...], [...]]")
    return tuple(map(tuple, values))


def _distribution(table: Table, kind: str) -> Quantile:
    if kind == "normal":
        made = factors.truncated_normal(table.number("mean", 0), table.number("sd", above=0), table.number("truncated", 3, above=0))
    elif kind == "integers":
        first = table.integer("from", 0)
        made = factors.integers(first, table.integer("to", low=first))
    else:
        low = table.number("from")
        high = table.number("to", above=low)
        mode = table.number("mode", (low + high) / 2) if kind == "triangular" else low
        if not low <= mode <= high:
            raise table.wrong("mode", f"is {mode}; give a number from {low} to {high}")
        made = factors.uniform(low, high) if kind == "uniform" else factors.triangular(low, mode, high)
    table.end()
    return made


def _rows(top: Table, design: str) -> int:
    if design not in SAMPLED:
        return 0
    rows: int = top.integer("rows", low=1, high=MOST_ROWS)
    if design == "saltelli" and (rows < 2 or rows & (rows - 1)):
        raise top.wrong("rows", f"is {rows}; give a power of 2 for the design saltelli, such as 64")
    return rows


def _measure(table: Table) -> Measure:
    name = table.text("name")
    measure = Measure(
        name,
        table.text("label", name),
        dict(table.table("settings", None).values),
        tuple(table.items("figures", ())),
        tuple(table.items("tables", ())),
    )
    table.end()
    return measure


def _picture(table: Table) -> Picture:
    settings = {
        "camera_mm": table.vector("camera_mm", 3, None),
        "target_mm": table.vector("target_mm", 3, None),
        "size": table.size("size"),
        "samples": table.integer("samples", None, low=1),
        "model": table.text("model", None),
    }
    compare = table.take("compare", False)
    if not isinstance(compare, bool):
        raise table.wrong("compare", f"is {compare!r}; give true or false")
    picture = Picture(table.text("name"), {k: v for k, v in settings.items() if v is not None}, compare)
    table.end()
    return picture


def _limit(table: Table) -> Limit:
    limit = Limit(table.text("figure"), table.number("min", None), table.number("max", None))
    if limit.low is None and limit.high is None:
        raise table.wrong("", "limits nothing; give min, max or both")
    if limit.low is not None and limit.high is not None and limit.low > limit.high:
        raise table.wrong("min", f"is {limit.low}, above max, which is {limit.high}: no row would pass; give a min up to max")
    table.end()
    return limit


def _objective(table: Table) -> Objective:
    objective = Objective(table.text("figure"), table.text("best", among=("high", "low")))
    table.end()
    return objective


def _check_factors(top: Table, design: str, all_factors: tuple[Factor, ...], fixed: dict[str, Any]) -> None:
    if design == "table" and all_factors:
        raise top.wrong("[[factor]]", 'has no meaning with design = "table": the table\'s columns are the factors')
    if design != "table" and not all_factors:
        raise top.wrong("[[factor]]", 'is missing; give at least one, or design = "table"')
    twice = given_twice([key for f in all_factors for key in f.keys] + list(fixed))
    if twice:
        raise top.wrong("[[factor]]", twice)
    for number, f in enumerate(all_factors, 1):
        if design == "grid" and not f.levels:
            raise top.wrong(f"[[factor]] {number}", f'is a distribution, of which a grid has no steps; give values, or design = "lhs"')


def given_twice(keys: list[str]) -> str:
    """What is wrong with keys that change the same value; nothing if none do."""
    for key in keys:
        if keys.count(key) > 1:
            return f"{key} is given more than once"
        vector, _, component = key.rpartition(".")
        if component.isdigit() and vector in keys:
            return f"{key} and all of {vector} are given; give one of them"
    return ""


def _check_measures(top: Table, study: Study) -> None:
    if not study.measures and not study.pictures:
        raise top.wrong("[[measure]]", "is missing; give at least one [[measure]] or [[picture]]")
    labels = [m.label for m in study.measures] + [p.name for p in study.pictures]
    for label in labels:
        if labels.count(label) > 1:
            raise top.wrong("[[measure]]", f'two are called "{label}"; give one of them another label')
        if not label.replace("_", "").replace("-", "").isalnum():
            raise top.wrong("[[measure]]", f'"{label}" becomes the name of columns and files; give letters, digits, _ and -')
        if label in ("row", "channel"):
            raise top.wrong("[[measure]] or [[picture]]", f'"{label}" is what an axis of the pictures is called; give another name')
    for figure in study.wished:
        label = figure.partition(".")[0]
        if label not in labels:
            raise top.wrong(f"[[limit]] or [[objective]] {figure}", f"is of no measure here; {nearest(label, labels)}")


def _definition(values: dict[str, Any]) -> dict[str, Any]:
    """Without what only chooses among results, which may change while finished rows stay."""
    kept = {k: v for k, v in values.items() if k not in ("limit", "objective", "rows_per_chunk", "display", "table")}
    kept["measure"] = [{k: v for k, v in m.items() if k != "figures"} for m in values.get("measure", [])]
    return kept
