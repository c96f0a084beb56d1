"""Chunks on this machine's cores: as many processes as are wanted, each computing one chunk after the other."""

from __future__ import annotations

import contextlib
import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Iterable, Iterator

from .planned import Plan

ATTEMPTS = 3  # at a chunk in whose work a process dies


def run(plan: Plan, chunks: Iterable[int], workers: int, threads: int) -> Iterator[tuple[int, dict]]:
    """Yields (chunk, what became of it) as they end. Processes that die are replaced. Stopped (Ctrl-C, an error), it stops them."""
    wanted: queue.SimpleQueue[int] = queue.SimpleQueue()
    for chunk in chunks:
        wanted.put(chunk)
    # Only a simple queue can be left by Ctrl-C at any moment: futures keep locks then, on which others wait for ever.
    ended: queue.SimpleQueue[tuple[int, dict | Exception]] = queue.SimpleQueue()

    def drive(process: _Process) -> None:
        while not process.stopped:
            try:
                chunk = wanted.get_nowait()
            except queue.Empty:
                return
            try:
                ended.put((chunk, process.run(chunk)))
            except Exception as error:
                ended.put((chunk, error))

    left, processes = wanted.qsize(), [_Process(plan, threads) for _ in range(workers)]
    try:
        for process in processes:
            threading.Thread(target=drive, args=(process,), daemon=True).start()
        for _ in range(left):
            chunk, result = ended.get()
            if isinstance(result, Exception):
                raise result
            yield chunk, result
    finally:
        for process in processes:
            process.stop()


class _Process:
    """A worker process, started when it is first needed. No fork, and no second run of the user's script: both have surprises."""

    def __init__(self, plan: Plan, threads: int):
        self.command = [sys.executable, "-m", "lfdsim.study.worker", str(plan.folder), str(threads)]
        self.child: subprocess.Popen | None = None
        self.stopped = False
        self.starting = threading.Lock()  # so that none is started behind stop()

    def run(self, chunk: int) -> dict:
        code = 0
        for _ in range(ATTEMPTS):
            try:
                if not self._start():
                    return {"problem": "stopped", "fatal": True}
                self.child.stdin.write(f"{chunk}\n")
                self.child.stdin.flush()
                return json.loads(self.child.stdout.readline())
            except (OSError, ValueError):  # it died: its pipes are closed, its last line is not whole
                code = self._end()
        return {"problem": f"the process that computed it died {ATTEMPTS} times (exit code {code})", "fatal": False}

    def _start(self) -> bool:
        with self.starting:
            if self.child is None and not self.stopped:
                # Python's own modules are not looked for where the user stands.
                environment = os.environ | {"PYTHONPATH": os.pathsep.join(p or os.getcwd() for p in sys.path), "PYTHONSAFEPATH": "1"}
                self.child = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)
            return not self.stopped

    def _end(self) -> int:
        with self.starting:
            child, self.child = self.child, None
        if child is None:
            return 0
        child.kill()
        with contextlib.suppress(OSError):  # of a pipe that it closed
            child.stdin.close()
        child.stdout.close()
        return child.wait()

    def stop(self) -> None:
        with self.starting:
            self.stopped = True
        self._end()
