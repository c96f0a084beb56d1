"""The plan of a study in its folder: which rows there are, and what they are rows of. Everything else in the folder follows from it."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import json
import math
import os
import pathlib
import tomllib
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

import lfdsim

from . import checks, columns, design, files, work
from .file import Study, given_twice, read_study
from .problems import StudyError, listed, path_of

FORMAT = 2  # of the folder
PICTURES = "pictures.zarr"  # in it
KINDS = {  # of what stands in plan.json
    "format": int,
    "name": str,
    "identity": str,
    "rows": int,
    "rows_per_chunk": int,
    "checksum": str,
    "display_folder": str,
    "display_text": str,
    "basis": dict,
    "sum": str,  # of all the others
}


@dataclasses.dataclass(frozen=True)
class Plan:
    folder: pathlib.Path
    name: str
    study: Study  # of the copy of the file in the folder
    identity: str  # of all that rows depend on
    display_text: str
    display_folder: pathlib.Path
    rows: int
    rows_per_chunk: int
    checksum: str  # of plan.parquet
    files: dict[str, str]  # that display and rows name, relative to the display's folder, with their SHA-256

    @property
    def chunks(self) -> int:
        return math.ceil(self.rows / self.rows_per_chunk)

    def rows_of(self, chunk: int) -> range:
        return range(chunk * self.rows_per_chunk, min((chunk + 1) * self.rows_per_chunk, self.rows))

    def chunk_name(self, chunk: int) -> str:
        return f"chunk-{chunk:06}"

    def chunk_path(self, chunk: int) -> pathlib.Path:
        return self.folder / "rows" / f"{self.chunk_name(chunk)}.parquet"

    def missing(self) -> list[int]:
        """The chunks that are not done."""
        return [c for c in range(self.chunks) if not self.chunk_path(c).exists()]

    def about(self, chunk: int) -> dict[str, Any]:
        return {"study": self.identity, "chunk": chunk}

    def values_of(self, chunk: int) -> design.Columns:
        """What the chunk's rows change, without reading the other rows."""
        return columns.values_of(self._table_file.read_row_group(chunk))

    def table(self) -> pa.Table:
        """All rows, as planned."""
        path = self.folder / "plan.parquet"
        table, note = files.read_table(path, {"study": self.identity}, "take another folder, or remove this one")
        if (note["checksum"], len(table), self._table_file.num_row_groups) != (self.checksum, self.rows, self.chunks):
            raise StudyError(path, "is not the one that plan.json speaks of; take another folder, or remove this one")
        return table

    @functools.cached_property
    def _table_file(self) -> pq.ParquetFile:
        return pq.ParquetFile(self.folder / "plan.parquet")

    @functools.cached_property
    def display(self) -> "lfdsim.Display":
        """What rows change; on any machine, so its files have to be there, and as they were."""
        for name, sum_ in self.files.items():
            if _digest_of(self.display_folder / name) != sum_:
                raise StudyError(self.display_folder / name, "has changed since the study was planned; give the study another folder")
        return work.described(self.display_text, self.display_folder, self.study.fixed)


def make(path: str | pathlib.Path, folder: str | pathlib.Path) -> Plan:
    """Plans the study of a file in a folder, or finds that it is planned there. Refuses a folder of another study."""
    folder = path_of(folder, "folder")
    study = read_study(path_of(path, "file"))
    with files.held(folder):
        return _make(study, folder)


def _make(study: Study, folder: pathlib.Path) -> Plan:
    display_text, display = _display(study)
    planned = _same_study(study, folder, display_text)
    if planned:
        return planned
    basis = _basis(study, display_text)
    identity = files.digest(basis)
    rows_folder = folder / "rows"
    if rows_folder.exists() and (not rows_folder.is_dir() or any(rows_folder.iterdir())):
        raise StudyError(folder, "has rows but no plan.json: it is no study's folder, or was changed by hand; give another folder")
    if not files.is_of(folder / "plan.parquet", identity):  # planning may have been stopped before plan.json
        files.refuse_foreign(folder / "study.toml", study.text)
        files.refuse_foreign(folder / "plan.parquet")
    for name in ("study.parquet", "report.html", PICTURES, "curves"):
        files.refuse_foreign(folder / name)
    work.check_measures(study)
    changes = design.changes_of(study)
    twice = given_twice(changes)  # a column may replace what [set] fixes
    if twice:
        raise StudyError(study.table or study.path, twice)
    keys = _replicate_keys(study, display_text, changes)
    rows = design.rows_of(study, keys)
    changed = [k for k in rows if k != "replicate"]
    checks.check_keys(study, display, changed)
    checks.check_effects(study, changed)
    rows = checks.whole_numbers(study, display, rows)
    work.check_settings(study, _possible(study, display, rows), study.display_path.parent)
    table = columns.arrow_of(rows)
    per_chunk = study.rows_per_chunk or math.ceil(math.sqrt(len(table)) / 4)
    try:
        rows_folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StudyError(folder, f"cannot be made: {error.strerror}; give another folder") from error
    files.write_table(folder / "plan.parquet", table, {"study": identity}, rows_per_group=per_chunk)
    files.write_whole(folder / "study.toml", study.text.encode())
    plan = {
        "format": FORMAT,
        "name": study.path.stem,
        "identity": identity,
        "rows": len(table),
        "rows_per_chunk": per_chunk,
        "checksum": files.checksum(table, {"study": identity}),
        "display_folder": str(study.display_path.parent.resolve()),
        "display_text": display_text,
        "basis": basis,
    }
    files.write_json(folder / "plan.json", plan | {"sum": files.digest(plan)})
    return dataclasses.replace(load(folder), study=study)


def load(folder: str | pathlib.Path) -> Plan:
    """The plan of a folder, as `make` left it."""
    folder = path_of(folder, "folder")
    path = folder / "plan.json"
    if not path.exists():
        raise StudyError(folder, "holds no study (no plan.json); plan one there: python -m lfdsim.study plan FILE.toml -o FOLDER")
    plan = _kept(path)
    known = Plan(
        folder,
        plan["name"],
        read_study(folder / "study.toml"),
        plan["identity"],
        plan["display_text"],
        pathlib.Path(plan["display_folder"]),
        plan["rows"],
        plan["rows_per_chunk"],
        plan["checksum"],
        plan["basis"]["files"],
    )
    if files.digest(known.study.definition) != files.digest(plan["basis"]["study"]):
        raise StudyError(path, "does not fit study.toml beside it: one was changed by hand; give another folder")
    if plan["basis"]["version"] != lfdsim.__version__:
        raise StudyError(
            path,
            f"was made by lfdsim {plan['basis']['version']}, and this is {lfdsim.__version__}: rows of both would be mixed; use "
            "that version, or another folder",
        )
    return known


def _kept(path: pathlib.Path) -> dict[str, Any]:
    """A plan.json as make() wrote it."""
    try:
        plan: dict[str, Any] = json.loads(path.read_text())
        if plan["format"] != FORMAT:
            raise StudyError(path, f"has format {plan['format']}, which this version does not know; give another folder")
        basis = plan["basis"]
        if (
            all(isinstance(plan[key], kind) for key, kind in KINDS.items())
            and min(plan["rows"], plan["rows_per_chunk"]) > 0
            and all(isinstance(basis[key], dict) for key in ("study", "files"))
            and "version" in basis
        ):
            if plan["sum"] != files.digest({key: value for key, value in plan.items() if key != "sum"}):
                raise StudyError(path, "was changed by hand; give another folder")
            return plan
        why = "it lacks what a plan says"
    except StudyError:
        raise
    except (OSError, KeyError, TypeError, ValueError, RecursionError) as error:
        why = f"{type(error).__name__}: {error}"
    raise StudyError(path, f"is not the plan of a study, or damaged ({why}); give another folder")


def _same_study(study: Study, folder: pathlib.Path, display_text: str) -> Plan | None:
    """The plan there, if it is of this study; what only chooses among results may have changed since."""
    path = folder / "plan.json"
    if not path.exists():
        return None
    there = _kept(path)
    basis, per_chunk = there["basis"], there["rows_per_chunk"]
    mine = json.loads(json.dumps(_basis(study, display_text), default=str))
    if files.digest(basis) != files.digest(mine):
        differing = [k for k in mine if mine[k] != basis.get(k)]
        if "study" in differing:
            differing.remove("study")
            keys = {*mine["study"], *basis["study"]}
            differing += [k for k in sorted(keys) if mine["study"].get(k) != basis["study"].get(k)]
        raise StudyError(folder, f"holds another study, which differs in: {listed(differing)}; give another folder, or remove this one")
    if study.rows_per_chunk not in (None, per_chunk):
        raise StudyError(
            f"{study.path}: rows_per_chunk",
            f"is {study.rows_per_chunk}, but {folder} is in chunks of {per_chunk}; give that, or another folder",
        )
    if files.read_text(folder / "study.toml") != study.text:
        files.write_whole(folder / "study.toml", study.text.encode())
    return dataclasses.replace(load(folder), study=study)


def display_in(path: pathlib.Path, fixed: dict[str, Any]) -> tuple[str, "lfdsim.Display"]:
    """A description's text and its display, which has to be possible with the overrides `fixed`."""
    text = files.read_text(path)
    try:
        display = work.described(text, path.parent.resolve(), fixed)
        lfdsim.check(work.changed(display, path.parent, fixed), warnings=False)
        return text, display
    except ValueError as error:
        raise StudyError(path, f"is not a possible display: {error}") from error


def _display(study: Study) -> tuple[str, "lfdsim.Display"]:
    try:
        return display_in(study.display_path, study.fixed)
    except StudyError as error:
        raise StudyError(f"{study.path}: display", str(error)) from error


def _possible(study: Study, display: "lfdsim.Display", rows: design.Columns) -> list["lfdsim.Display"]:
    """Of the first and the last row, those that are."""
    found = []
    for row in (0, -1):
        try:
            found.append(work.changed(display, study.display_path.parent, {**study.fixed, **design.overrides(rows, row)}))
        except (TypeError, ValueError):  # which will be the row's reason
            continue
    return found


def _replicate_keys(study: Study, display_text: str, changes: list[str]) -> tuple[str, ...]:
    given = changes + list(study.fixed)
    has_errors = "errors" in tomllib.loads(display_text) or any(f"{k}.".startswith("errors.") for k in given)
    varies = has_errors and "errors.seed" not in given
    return study.replicate_keys or (("errors.seed", "render.seed") if varies else ("render.seed",))


def _basis(study: Study, display_text: str) -> dict[str, Any]:
    """All that rows are a function of. Comments and blanks are not."""
    display = tomllib.loads(display_text)
    return {
        "version": lfdsim.__version__,
        "display": files.digest(display),
        "study": study.definition,
        "files": _digests_of_files([display, study.definition, design.texts_of_table(study)], study.display_path.parent),
        "table": study.table and _digest_of(study.table),
    }


def _digests_of_files(values: object, folder: pathlib.Path) -> dict[str, str]:
    """Of every file that a value names: models and the files that they name, tables of lenses, catalogues."""
    if isinstance(values, dict):
        values = list(values.values())
    if isinstance(values, list):
        return {k: v for value in values for k, v in _digests_of_files(value, folder).items()}
    if not isinstance(values, str) or not work.names_file(folder, values):
        return {}
    return {name: _digest_of(folder / name) for name in [values, *_named_by_model(values, folder)]}


def _named_by_model(name: str, folder: pathlib.Path) -> list[str]:
    """The materials, textures and buffers of a model, relative to the folder; nothing of what is no model that can be read."""
    path = folder / name
    try:
        read = lfdsim._core.files_of_model(str(path))
    except (lfdsim.InputError, RuntimeError):
        return []
    return [os.path.relpath(file, folder) for file in read if not path.samefile(file)]


def _digest_of(path: pathlib.Path) -> str:
    try:
        with open(path, "rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise StudyError(path, f"cannot be read: {error.strerror}; the study was planned with it") from error
