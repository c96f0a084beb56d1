"""What rows change, judged before they are planned: each would otherwise fail, or change nothing, once a night is spent on it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import lfdsim
from lfdsim.arguments import KEYS, warn

from . import work
from .design import Columns
from .factors import Factor
from .file import Study
from .problems import StudyError, listed

# The keys that a setting of a measure or picture overrides.
REPLACED = {name: (key,) for name, key in KEYS.items()} | {"model": ("content.model", "content.object")}


def check_keys(study: Study, display: "lfdsim.Display", keys: Iterable[str]) -> None:
    """A key that no display has would fail in every row."""
    for key in keys:
        try:
            stem, _, last = key.rpartition(".")
            value = display[stem if last.isdigit() else key]
        except (KeyError, ValueError) as error:
            raise StudyError(f"{study.table or study.path}: {key}", f"is not a key of the display: {error}") from error
        if last.isdigit() and not (isinstance(value, tuple) and int(last) < len(value)):
            found = f"has {len(value)} components" if isinstance(value, tuple) else "is not a vector in the display; state it there"
            raise StudyError(f"{study.table or study.path}: {key}", f"names no component: {stem} {found}")


def check_effects(study: Study, keys: Iterable[str]) -> None:
    """Refuses a key that settings of every measure and picture override; warns of one that some override, and of a key of [set] that
    all override."""
    places = [(f"[[measure]] {m.label}", list(m.settings)) for m in study.measures]
    for picture in study.pictures:  # what it is compared with has the samples of the display
        places.append((f"[[picture]] {picture.name}", [s for s in picture.settings if not (s == "samples" and picture.compare)]))
    for key in (*study.fixed, *keys):
        own = [[f"{s} of {where}" for s in settings if _replaces(s, key)] for where, settings in places]
        overriding = [setting for found in own for setting in found]
        override = f"{listed(overriding)} {'overrides' if len(overriding) == 1 else 'override'} it"
        if key in study.fixed:
            if all(own):
                warn([f"{study.path}: [set] {key} changes nothing: {override}"])
        elif all(own):
            repeats = study.replicates > 1 and key in (study.replicate_keys or ("render.seed",))
            remedy = "leave that out, or give other replicate_keys" if repeats else "leave out one or the other"
            raise StudyError(f"{study.table or study.path}: {key}", f"changes nothing: {override}; {remedy}")
        elif overriding:
            warn([f"{study.table or study.path}: {key} changes only a part of the figures: {override}"])


def _replaces(setting: str, key: str) -> bool:
    return any(f"{key}.".startswith(f"{replaced}.") for replaced in REPLACED.get(setting, ()))


def whole_numbers(study: Study, display: "lfdsim.Display", rows: Columns) -> Columns:
    """The rows, with whole numbers for keys that take no others: 300, not 300.0. Refuses fractions there."""
    made = dict(rows)
    for key, values in rows.items():
        real = next((v for v in values if isinstance(v, float)), None)
        if key == "replicate" or real is None or not _takes_whole(study, display, key, real):
            continue
        fraction = next((v for v in values if isinstance(v, float) and not v.is_integer()), None)
        if fraction is not None:
            raise StudyError(f"{study.table or study.path}: {key}", f"takes whole numbers, and {fraction:.6g} is none; {_remedy(study, key)}")
        made[key] = [int(v) if isinstance(v, float) else v for v in values]
    return made


def _takes_whole(study: Study, display: "lfdsim.Display", key: str, real: float) -> bool:
    now = _value(display, key)
    if now is None:  # the display has no value of which it could be seen
        try:
            now = _value(work.changed(display, study.display_path.parent, {key: round(real) if math.isfinite(real) else 1}), key)
        except (KeyError, TypeError, ValueError):
            return False
    return isinstance(now, int) and not isinstance(now, bool)


def _value(display: "lfdsim.Display", key: str) -> Any:
    """Of a key, or of one component of a vector; None where the display has none."""
    stem, _, last = key.rpartition(".")
    if not last.isdigit():
        return display[key]
    vector = display[stem]
    return vector[int(last)] if isinstance(vector, tuple) and int(last) < len(vector) else None


def _remedy(study: Study, key: str) -> str:
    factor = next((f for f in study.factors if key in f.keys), None)
    if factor is None or factor.kind == "values":
        return "give whole ones"
    return _whole_steps(factor, factor.keys.index(key)) if factor.kind == "from" else "give integers = { from, to }, or values"


def _whole_steps(factor: Factor, place: int) -> str:
    low, high = (level[place] for level in (factor.levels[0], factor.levels[-1]))
    if not (isinstance(low, (int, float)) and isinstance(high, (int, float)) and low == int(low) and high == int(high)):
        return "give from and to that are whole"
    span, parts = abs(int(high) - int(low)), len(factor.levels) - 1
    nearest = next(p for away in range(parts) for p in (parts + away, parts - away) if span % p == 0)
    return f"all are whole with steps = {nearest + 1}"
