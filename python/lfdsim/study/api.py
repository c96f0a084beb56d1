"""The programming interface: each step of a study separately, and all of them together."""

from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING

from . import chunk, collected, pictures, runs
from . import planned as plans
from .file import MOST_ROWS
from .planned import Plan
from .problems import StudyError, StudyFailed, whole

if TYPE_CHECKING:
    import pandas

Path = str | pathlib.Path


def run(
    file: Path, folder: Path, dask: object = None, *, workers: int | None = None, threads: int = 1, progress: bool | None = None
) -> "pandas.DataFrame":
    """Runs the study of a file in a folder and returns its rows.

    What is finished there is not computed again. `dask`: a distributed.Client or a scheduler's address; None: `workers` processes
    here (1 to 1024; None: one for each core), each with `threads` threads. `progress`: a line on standard error (None: where that is a terminal).
    """
    runs.check_machines(dask, workers, threads, progress)
    return runs.finish(plan(file, folder), dask, workers, threads, progress).to_pandas()


def plan(file: Path, folder: Path) -> Plan:
    """Chooses all rows of a study, and computes none."""
    made = plans.make(file, folder)
    pictures.prepare(made)
    return made


def run_part(folder: Path, part: int, parts: int, threads: int = 1) -> int:
    """Computes every `parts`-th chunk of a planned study in this process, from chunk `part`. Returns how many rows these are."""
    whole(parts, "parts (--of)", 1, MOST_ROWS)
    whole(part, "part (--chunk)", 0, parts - 1)
    runs.check_machines(None, None, threads)
    the_plan = plans.load(folder)
    the_plan.table()  # as planned, or it is refused before work begins
    numbers = range(part, the_plan.chunks, parts)
    for number in numbers:
        result = chunk.attempt(the_plan, number, threads)
        if result.get("input"):
            raise StudyError("", result["problem"])
        if "problem" in result:
            raise StudyFailed(f"{folder}: chunk {number}", f"{result['problem']}. Finished rows are kept; run the same command again")
    return sum(len(the_plan.rows_of(n)) for n in numbers)


def collect(folder: Path) -> "pandas.DataFrame":
    """The rows of a study whose chunks are all there; writes study.parquet."""
    return collected.table_of(plans.load(folder)).to_pandas()


def report(folder: Path) -> pathlib.Path:
    """Writes report.html of a study whose chunks are all there."""
    from .reports import page

    return page.write(plans.load(folder))
