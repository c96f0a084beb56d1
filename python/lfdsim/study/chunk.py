"""One chunk of a study's rows: computed once, kept row by row, and written as one file when all are there.

While a chunk is in work, each finished row is a line of a journal beside its place. A kill loses the row in work alone: whoever takes the
chunk next, on any machine, reads the journals. Two that work on one chunk at a time waste time and harm nothing: rows are a pure function
of the plan, journals have their own names, and files appear whole.
"""

from __future__ import annotations

import json
import os
import pathlib
import time
import uuid
import zlib
from collections.abc import Iterator
from typing import Any, TypedDict

import pyarrow as pa

from . import columns, design, files, pictures, work
from .factors import Value
from .planned import Plan
from .problems import StudyError, StudyFailed

REMEDY = "remove this file and run again: its rows are computed anew"


class Record(TypedDict):
    """A finished row, as journals have it."""

    row: int
    figures: dict[str, float | str]
    tables: dict[str, dict[str, list[float]]]
    error: str | None
    seconds: float


class Outcome(TypedDict, total=False):
    """What became of a chunk: its rows, how many of them are impossible and how long it took; or what went wrong, see attempt()."""

    rows: int
    failed: int
    seconds: float
    problem: str
    fatal: bool
    input: bool


def run(plan: Plan, chunk: int, threads: int) -> Outcome:
    """Computes what is left of a chunk. Says how many rows it has, how many of them are impossible, and how long they took."""
    if plan.chunk_path(chunk).exists():
        return summary(read(plan, chunk)[0], 0.0)
    start = time.perf_counter()
    journals = _journals(plan, chunk)
    done = {row: record for path in journals for row, record in _records(plan, path) if row in plan.rows_of(chunk)}
    values = plan.values_of(chunk)
    journal = None
    try:
        for place, row in enumerate(plan.rows_of(chunk)):
            if row not in done:
                done[row] = _compute(plan, row, _overrides(plan, values, place), threads)
                journal = journal or _Journal(plan, chunk)
                journal.add(done[row])
    finally:
        if journal:
            journal.close()
    table = _write(plan, chunk, [done[row] for row in plan.rows_of(chunk)])
    for path in _journals(plan, chunk):
        path.unlink(missing_ok=True)
    return summary(table, time.perf_counter() - start)


def attempt(plan: Plan, chunk: int, threads: int) -> Outcome:
    """What run() says, or what went wrong; `fatal` where other chunks would not fare better, `input` where the user has to
    mend something before another try."""
    try:
        return run(plan, chunk, threads)
    except StudyError as error:
        return {"problem": str(error), "fatal": True, "input": not isinstance(error, StudyFailed)}
    except Exception as error:
        return {"problem": f"{type(error).__name__}: {error}", "fatal": False}


def read(plan: Plan, chunk: int) -> tuple[pa.Table, dict[str, Any]]:
    return files.read_table(plan.chunk_path(chunk), plan.about(chunk), REMEDY)


def summary(table: pa.Table, seconds: float) -> Outcome:
    return {"rows": len(table), "failed": len(table) - table["error"].null_count, "seconds": seconds}


def overrides_of(plan: Plan, row: int) -> dict[str, Value]:
    """All that a row changes in the display."""
    chunk, place = divmod(row, plan.rows_per_chunk)
    return _overrides(plan, plan.values_of(chunk), place)


def _overrides(plan: Plan, values: design.Columns, place: int) -> dict[str, Value]:
    return {**plan.study.fixed, **design.overrides(values, place)}


def _compute(plan: Plan, row: int, overrides: dict[str, Value], threads: int) -> Record:
    start = time.perf_counter()
    made = work.compute(plan.display, plan.display_folder, overrides, plan.study, threads)
    pictures.write(plan, row, made.pictures)
    return {"row": row, "figures": made.figures, "tables": made.tables, "error": made.error, "seconds": time.perf_counter() - start}


def _write(plan: Plan, chunk: int, records: list[Record]) -> pa.Table:
    """Curves first: a chunk whose rows have their file is done."""
    for name in dict.fromkeys(name for r in records for name in r["tables"]):
        folder = plan.folder / "curves" / name
        folder.mkdir(parents=True, exist_ok=True)
        files.write_table(folder / f"{plan.chunk_name(chunk)}.parquet", _curves(records, name), plan.about(chunk))
    table = pa.table(
        {
            "row": pa.array([r["row"] for r in records], pa.int64()),
            **columns.figures_arrow([r["figures"] for r in records]),
            "error": pa.array([r["error"] for r in records], pa.string()),
        }
    )
    files.write_table(plan.chunk_path(chunk), table, plan.about(chunk), {"seconds": [round(r["seconds"], 6) for r in records]})
    return table


def _curves(records: list[Record], name: str) -> pa.Table:
    """The curves of all rows below each other, with their row's number first."""
    curves = [(r["row"], r["tables"][name]) for r in records if name in r["tables"]]
    lengths = [max(map(len, curve.values()), default=0) for _, curve in curves]
    heads = dict.fromkeys(head for _, curve in curves for head in curve)
    rows = pa.array([row for (row, _), n in zip(curves, lengths) for _ in range(n)], pa.int64())
    return pa.table(
        {"row": rows}
        | {h: pa.array([x for (_, c), n in zip(curves, lengths) for x in c.get(h, [float("nan")] * n)], pa.float64()) for h in heads}
    )


def _journals(plan: Plan, chunk: int) -> list[pathlib.Path]:
    return sorted((plan.folder / "rows").glob(f"{plan.chunk_name(chunk)}.*.journal"))


def _records(plan: Plan, path: pathlib.Path) -> Iterator[tuple[int, Record]]:
    """Whole lines of this study; a line that was cut off is not one."""
    try:
        lines = path.read_bytes().split(b"\n")
    except FileNotFoundError:  # another run has finished the chunk meanwhile
        return
    for line in lines:
        sum_, _, text = line.partition(b" ")
        if text and sum_ == _line_sum(plan, text):
            record = json.loads(text)
            yield record["row"], record


def _line_sum(plan: Plan, text: bytes) -> bytes:
    return b"%08x" % zlib.crc32(plan.identity.encode() + text)


class _Journal:
    def __init__(self, plan: Plan, chunk: int) -> None:
        self.plan, self.path = plan, plan.folder / "rows" / f"{plan.chunk_name(chunk)}.{uuid.uuid4().hex[:12]}.journal"
        with files.full_disk_told(self.path):
            self.file = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND, 0o666)

    def add(self, record: Record) -> None:
        text = json.dumps(record, separators=(",", ":")).encode()
        line = _line_sum(self.plan, text) + b" " + text + b"\n"
        with files.full_disk_told(self.path):
            while line:
                line = line[os.write(self.file, line) :]

    def close(self) -> None:
        os.close(self.file)
