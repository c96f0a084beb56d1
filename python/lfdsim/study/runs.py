"""Computes the rows of a study that are not there yet, and gives the table of all."""

from __future__ import annotations

import os
import sys

import numpy as np
import pyarrow as pa

from . import collected, local
from . import planned as plans
from .chunk import Outcome
from .problems import StudyError, StudyFailed, counted, listed, whole


MOST_AT_ONCE = 1024  # processes, and threads of each, as of the program's --threads


def check_machines(dask: object, workers: int | None, threads: int, progress: object = None) -> None:
    if workers is not None:
        whole(workers, "workers", 1, MOST_AT_ONCE)
    whole(threads, "threads", 1, MOST_AT_ONCE)
    if not (progress is None or isinstance(progress, (bool, np.bool_))):
        raise StudyError("progress", f"is {progress!r}; give True, False or None")
    if dask is not None and workers is not None:
        raise StudyError("workers", "are of this machine; with dask the cluster has its own. Give one of them")


def finish(
    plan: plans.Plan, dask: object = None, workers: int | None = None, threads: int = 1, progress: bool | None = None
) -> pa.Table:
    """Computes the missing chunks, and returns the table (Arrow). StudyError names chunks that failed; the others are kept."""
    if (plan.folder / collected.NAME).exists():
        return collected.table_of(plan)
    plan.table()  # as planned, or it is refused before work begins
    compute(plan, plan.missing(), dask, workers, threads, progress)
    return collected.table_of(plan)


def compute(plan: plans.Plan, chunks: list[int], dask: object, workers: int | None, threads: int, progress: bool | None) -> None:
    if not chunks:
        return
    if dask is not None:
        from . import cluster

        results = cluster.run(plan, chunks, dask, threads)
    else:
        results = local.run(plan, chunks, min(workers or cores(), len(chunks)), threads)
    show = _Progress(plan, chunks, sys.stderr.isatty() if progress is None else progress)
    problems: dict[str, list[int]] = {}
    checked = False
    try:
        for number, result in results:
            if "problem" in result:
                problems.setdefault(result["problem"], []).append(number)
                if result["fatal"]:
                    raise (StudyError if result.get("input") else StudyFailed)("", result["problem"])
                continue
            show.add(result)
            if not checked and result["failed"] < result["rows"]:
                collected.check_wishes(plan, number)
                checked = True
    finally:
        results.close()
        show.end()
    if problems:
        what = "; ".join(f"chunk {listed(map(str, numbers), 5)}: {problem}" for problem, numbers in problems.items())
        raise StudyFailed(plan.folder, f"{what}. The other chunks are finished and kept; run the same command again to try these once more")


def cores() -> int:
    """That this process may use: what a batch system gave it, not what the machine has."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Progress:
    def __init__(self, plan: plans.Plan, chunks: list[int], shown: bool) -> None:
        self.shown, self.failed = shown, 0
        self.total = plan.rows
        self.done = plan.rows - sum(len(plan.rows_of(c)) for c in chunks)

    def add(self, result: Outcome) -> None:
        self.done += result["rows"]
        self.failed += result["failed"]
        if self.shown:
            impossible = f", {self.failed} impossible" if self.failed else ""
            # The carriage return is its own: what else is printed has none.
            terminal = getattr(sys.stderr, "stream", sys.stderr)
            print(f"\rlfdsim: {self.done} of {counted(self.total, 'row')}{impossible} ", end="", file=terminal, flush=True)

    def end(self) -> None:
        if self.shown:
            print(file=sys.stderr)
