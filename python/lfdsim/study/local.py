"""Chunks on this machine's cores: as many processes as are wanted, each computing one chunk after the other."""

from __future__ import annotations

import contextlib
import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Generator, Iterable
from typing import IO

from .chunk import Outcome
from .planned import Plan

ATTEMPTS = 3  # at a chunk in whose work a process dies


def run(plan: Plan, chunks: Iterable[int], workers: int, threads: int) -> Generator[tuple[int, Outcome], None, None]:
    """Yields (chunk, what became of it) as they end. Processes that die are replaced. Stopped (Ctrl-C, an error), it stops them."""
    wanted: queue.SimpleQueue[int] = queue.SimpleQueue()
    for chunk in chunks:
        wanted.put(chunk)
    # Only a simple queue can be left by Ctrl-C at any moment: futures keep locks then, on which others wait for ever.
    ended: queue.SimpleQueue[tuple[int, Outcome | Exception]] = queue.SimpleQueue()

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

    def __init__(self, plan: Plan, threads: int) -> None:
        self.command = [sys.executable, "-m", "lfdsim.study.worker", str(plan.folder), str(threads)]
        self.child: subprocess.Popen[str] | None = None
        self.stopped = False
        self.starting = threading.Lock()  # so that none is started behind stop()

    def run(self, chunk: int) -> Outcome:
        code = 0
        for _ in range(ATTEMPTS):
            try:
                child = self._start()
                if child is None:
                    return {"problem": "stopped", "fatal": True}
                words, answers = _pipes(child)
                words.write(f"{chunk}\n")
                words.flush()
                outcome: Outcome = json.loads(answers.readline())
                return outcome
            except (OSError, ValueError):  # it died: its pipes are closed, its last line is not whole
                code = self._end()
        return {"problem": f"the process that computed it died {ATTEMPTS} times (exit code {code})", "fatal": False}

    def _start(self) -> subprocess.Popen[str] | None:
        """None: stopped."""
        with self.starting:
            if self.child is None and not self.stopped:
                # Python's own modules are not looked for where the user stands.
                environment = os.environ | {"PYTHONPATH": os.pathsep.join(p or os.getcwd() for p in sys.path), "PYTHONSAFEPATH": "1"}
                self.child = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)
            return None if self.stopped else self.child

    def _end(self) -> int:
        with self.starting:
            child, self.child = self.child, None
        if child is None:
            return 0
        child.kill()
        words, answers = _pipes(child)
        with contextlib.suppress(OSError):  # of a pipe that it closed
            words.close()
        answers.close()
        return child.wait()

    def stop(self) -> None:
        with self.starting:
            self.stopped = True
        self._end()


def _pipes(child: subprocess.Popen[str]) -> tuple[IO[str], IO[str]]:
    assert child.stdin and child.stdout  # it was started with both
    return child.stdin, child.stdout
