"""One row of a study: a display, changed, measured. The only file that knows how lfdsim measures."""

from __future__ import annotations

import dataclasses
import inspect
import os
import pathlib
from collections.abc import Mapping
from typing import Any

import numpy as np

import lfdsim
from lfdsim.arguments import KEYS, seen
from lfdsim.numbers_of import INFINITE

from .factors import Value
from .file import Measure, Picture, Study
from .problems import StudyError, StudyFailed, nearest


@dataclasses.dataclass
class Row:
    """What a row gave: numbers and texts by name, curves (columns of equal length) by name, pictures (height, width, 3) in linear light.
    `error`: why there is nothing, where the display is impossible."""

    figures: dict[str, float | str] = dataclasses.field(default_factory=dict)
    tables: dict[str, dict[str, list[float]]] = dataclasses.field(default_factory=dict)
    pictures: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)
    error: str | None = None


def compute(base: "lfdsim.Display", folder: pathlib.Path, overrides: dict[str, Value], study: Study, threads: int) -> Row:
    """Files that overrides and settings name are relative to `folder`, the display's.

    What the display cannot be or cannot show is the row's error. Anything else that fails (memory, disk, device) is raised: it may work
    another time, so the row is not done."""
    row = Row()
    try:
        try:
            display = changed(base, folder, overrides)
        except TypeError as error:  # a value of a kind that no key takes
            raise ValueError(str(error)) from error
        for measure in study.measures:
            _measure(row, display, measure, _in_folder(measure.settings, folder), threads, study.path)
        for picture in study.pictures:
            _picture(row, display, picture, _in_folder(picture.settings, folder), threads)
    except StudyError:
        raise
    except ValueError as error:
        if isinstance(error, lfdsim.InputError) and (error.key == "device" or error.lacks_memory):
            raise StudyFailed("", str(error)) from error  # another machine, or this one another day, has it
        return Row(error=" ".join(str(error).split()))
    return row


def changed(base: "lfdsim.Display", folder: pathlib.Path, overrides: dict[str, Value]) -> "lfdsim.Display":
    """The display with other values: "none" removes a key; `errors.shift_mm.0` is one component of a vector."""
    whole: dict[str, Value] = {}
    for key, value in _in_folder(overrides, folder).items():
        stem, _, last = key.rpartition(".")
        if not (last.isdigit() and isinstance(value, (int, float))):
            whole[key] = None if value == "none" else value
            continue
        vector = whole.get(stem, base[stem])
        if not isinstance(vector, (list, tuple)) or int(last) >= len(vector):
            raise ValueError(f"{key}: {stem} is not a vector in the display; state it there")
        whole[stem] = [value if k == int(last) else v for k, v in enumerate(vector)]
    return base.with_(whole) if whole else base


def described(text: str, folder: pathlib.Path, fixed: Mapping[str, Any]) -> "lfdsim.Display":
    """The display of a description with the whole keys of `fixed` changed: without them it need not be possible."""
    whole = {k: None if v == "none" else v for k, v in _in_folder(fixed, folder).items() if not k.rpartition(".")[2].isdigit()}
    return lfdsim.Display.parse(text, folder, whole)


FILE_KEYS = ("model", "image", "table", "start")  # the last words of keys that name one file


def _in_folder(values: Mapping[str, Any], folder: pathlib.Path) -> dict[str, Any]:
    """Names of files with their folder, the display's: that in which a worker runs is another."""

    def is_name(key: str, text: str) -> bool:
        names_one = key.rpartition(".")[2] in FILE_KEYS and text not in ("", "none") and not text.startswith("built-in:")
        return names_one or names_file(folder, text)

    return {k: str(folder / v) if isinstance(v, str) and is_name(k, v) else v for k, v in values.items()}


def names_file(folder: pathlib.Path, text: str) -> bool:
    return 0 < len(text) < 1000 and "\0" not in text and "\n" not in text and (folder / text).is_file()


def check_measures(study: Study) -> None:
    """Names and settings that lfdsim does not know would fail in every row."""
    names = ["check", *(m.name for m in lfdsim.measures())]
    settings = [
        p.name
        for p in inspect.signature(lfdsim.analyze).parameters.values()
        if p.kind is p.KEYWORD_ONLY and p.name not in ("threads", "progress")
    ]
    for number, measure in enumerate(study.measures, 1):
        where = f"{study.path}: [[measure]] {number}"
        if measure.name not in names:
            raise StudyError(f"{where} name", f'"{measure.name}" is not a measure; {nearest(measure.name, names)}')
        known = [] if measure.name == "check" else settings
        for key in measure.settings:
            if key not in known:
                raise StudyError(f"{where} settings", f'"{key}" is not a setting of {measure.name}; {nearest(key, known)}')
        if measure.name == "check" and measure.tables:
            raise StudyError(f"{where} tables", "check has none; leave them out")


def check_settings(study: Study, displays: list["lfdsim.Display"], folder: pathlib.Path) -> None:
    """Settings that lfdsim refuses with each of these displays would make all rows impossible."""
    named = [(f"[[measure]] {n} settings", m.settings) for n, m in enumerate(study.measures, 1) if m.name != "check"]
    for where, settings in named + [(f"[[picture]] {n}", p.settings) for n, p in enumerate(study.pictures, 1)]:
        given = {k: v for k, v in _in_folder(settings, folder).items() if k in (*KEYS, "model")}
        model = given.pop("model", None)
        reasons = [_refused(display, model, given) for display in displays]
        if reasons and all(reasons):
            raise StudyError(f"{study.path}: {where}", reasons[0])


def _refused(display: "lfdsim.Display", model: Any, settings: dict[str, Any]) -> str:
    """Why, or nothing."""
    try:
        found = seen(display, model, **settings)
        if model is not None and not os.path.isfile(found["content.model"]) and not str(model).startswith("built-in:"):
            return f"model: {model}: no such model file"
    except (TypeError, ValueError) as error:
        return " ".join(str(error).split())
    return ""


def _measure(row: Row, display: "lfdsim.Display", measure: Measure, settings: dict[str, Any], threads: int, path: pathlib.Path) -> None:
    if measure.name == "check":
        found = lfdsim.check(display, warnings=False)
        row.figures.update(flat({k: found[k] for k in ("geometry", "theory")}, measure.label))
        return
    result = lfdsim.analyze(display, measure.name, threads=threads, progress=False, **settings)
    row.figures.update(flat(result.figures, measure.label))
    for name in measure.tables:
        if name not in result.tables:
            raise StudyError(
                f"{path}: [[measure]] {measure.label}: tables", f'"{name}" is not a table of {measure.name}; {nearest(name, result.tables)}'
            )
        table = result.tables[name]
        row.tables[f"{measure.label}.{name}"] = {str(c): np.asarray(table[c], float).tolist() for c in table}


def _picture(row: Row, display: "lfdsim.Display", picture: Picture, settings: dict[str, Any], threads: int) -> None:
    view = lfdsim.render(display, threads=threads, progress=False, **settings)
    row.pictures[picture.name] = np.asarray(view, np.float32)
    row.figures[f"{picture.name}.mean"] = float(np.mean(view, dtype=float))
    if picture.compare:
        settings.pop("samples", None)
        truth = lfdsim.photograph(display, threads=threads, progress=False, **settings)
        row.figures.update(flat(lfdsim.compare(view, truth), picture.name))


def flat(value: Any, name: str) -> dict[str, float | str]:
    """Tables and lists as names with dots: `fov.horizontal.own_lens_deg.0`."""
    if isinstance(value, dict):
        return {k: v for key, inner in value.items() for k, v in flat(inner, f"{name}.{key}").items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return {k: v for number, inner in enumerate(value) for k, v in flat(inner, f"{name}.{number}").items()}
    if isinstance(value, str):
        return {name: INFINITE.get(value, value)}
    return {name: float("nan") if value is None else float(value)}
