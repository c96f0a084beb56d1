"""A process that computes chunks: their numbers come on standard input, what became of them goes to standard output, a line of JSON each.

Usage: python -m lfdsim.study.worker FOLDER THREADS. It ends with its standard input, so with whoever started it, even one that was killed.
"""

from __future__ import annotations

import json
import os
import queue
import signal
import sys
import threading

from . import chunk, planned


def main(folder: str, threads: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all of a terminal's processes; the first one decides what it means
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)  # what a library prints is no answer
    wanted: queue.SimpleQueue[int] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(wanted,), daemon=True).start()
    the_plan = planned.load(folder)
    while True:
        number = wanted.get()
        answers.write(json.dumps(chunk.attempt(the_plan, number, threads)) + "\n")


def _listen(wanted: queue.SimpleQueue[int]) -> None:
    for line in sys.stdin:
        wanted.put(int(line))
    os._exit(0)  # journals are whole lines, files appear whole: nothing is lost


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
