"""Chunks on a Dask cluster, whoever has made it: machines of a laboratory, dask-jobqueue on Slurm, PBS, LSF or SGE, a cloud."""

from __future__ import annotations

import functools
from collections.abc import Generator, Iterable
from typing import TYPE_CHECKING

from . import chunk as one_chunk
from . import planned as plans
from .planned import Plan
from .problems import StudyError

if TYPE_CHECKING:
    import distributed


def client_of(dask: object) -> "distributed.Client":
    """A distributed.Client: itself, or one for an address or a cluster."""
    try:
        import distributed
    except ImportError as error:
        raise StudyError("dask", "needs the Python package distributed; pip install distributed") from error
    if isinstance(dask, distributed.Client):
        return dask
    try:
        return distributed.Client(dask, timeout=10)
    except (OSError, ValueError, TypeError) as error:
        raise StudyError(
            f"dask {dask}", f"no scheduler answers there ({error}); start one (dask scheduler), and give its address, as in tcp://HOST:8786"
        ) from error


def run(plan: Plan, chunks: Iterable[int], dask: object, threads: int) -> Generator[tuple[int, one_chunk.Outcome], None, None]:
    """Yields (chunk, what became of it) as they end. Chunks of workers that die are computed by others."""
    import distributed

    client = client_of(dask)
    try:
        client.wait_for_workers(1, timeout=600)
    except TimeoutError as error:
        raise StudyError(f"dask {dask}", "has had no worker for ten minutes; start some (dask worker ADDRESS)") from error
    folder = str(plan.folder.resolve())
    futures = {
        client.submit(_attempt, folder, plan.identity, c, threads, pure=False, key=f"lfdsim-{plan.identity[:12]}-{c}"): c for c in chunks
    }
    try:
        for future in distributed.as_completed(futures):
            raised = future.exception()
            yield futures[future], {"problem": f"{type(raised).__name__}: {raised}", "fatal": False} if raised else future.result()
            future.release()
    finally:
        client.cancel(list(futures))
        if client is not dask:
            client.close()


def _attempt(folder: str, identity: str, chunk: int, threads: int) -> one_chunk.Outcome:
    try:
        plan = _plan(folder, identity)
    except (StudyError, OSError) as error:
        return {"problem": f"a worker does not see the study: {error}. Workers need the folder under the same path", "fatal": True, "input": True}
    return one_chunk.attempt(plan, chunk, threads)


@functools.lru_cache(maxsize=1)
def _plan(folder: str, identity: str) -> Plan:
    plan = plans.load(folder)
    if plan.identity != identity:
        raise StudyError(folder, "is another study's here")
    return plan
