"""Progress of long work: a bar on a terminal or in a notebook."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, Union

import numpy as np

Report = Callable[[str, int, int], None]  # the stage, units done, units in all
Progress = Union[bool, Report, None]

_WIDTH = 40  # of the bar in a terminal, characters


@contextlib.contextmanager
def shown(progress: Progress) -> Iterator[Report | None]:
    """The receiver of progress of long work. None: a bar if standard error is visible to a user; True, False: always, never; or a function.

    Work of less than 50 ms reports nothing.
    """
    if callable(progress):
        yield progress
        return
    if isinstance(progress, np.bool_):
        progress = bool(progress)
    if progress is not None and not isinstance(progress, bool):
        raise TypeError(f"progress is a {type(progress).__name__}; give True, False, None or a function of (stage, done, units)")
    in_notebook = progress is not False and _in_notebook()
    if progress is False or (progress is None and not in_notebook and not _on_terminal()):
        yield None
        return
    bar: _Bar = _NotebookBar() if in_notebook else _TerminalBar()
    try:
        yield bar
    finally:
        bar.end()


def _on_terminal() -> bool:
    try:
        return sys.stderr.isatty()
    except (AttributeError, ValueError):  # there is none, or it is closed
        return False


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    running = shell.get_ipython() if shell else None
    return running is not None and getattr(running, "kernel", None) is not None


class _Bar:
    """Keeps the time of each stage."""

    def __init__(self) -> None:
        self.stage, self.begun = "", time.monotonic()

    def __call__(self, stage: str, done: int, units: int) -> None:
        if stage != self.stage:
            self.stage, self.begun = stage, time.monotonic()
        share = min(done / units, 1.0) if units > 0 else 0.0
        spent = time.monotonic() - self.begun
        self.draw(share, f"{spent / share * (1 - share):.0f} s left" if share > 0.02 else f"{spent:.1f} s")

    def draw(self, share: float, remark: str) -> None:
        raise NotImplementedError

    def end(self) -> None:
        raise NotImplementedError


class _TerminalBar(_Bar):
    """One line on standard error, redrawn, and wiped at the end."""

    drawn = False

    def draw(self, share: float, remark: str) -> None:
        bar = "=" * int(share * _WIDTH)
        self._write(f"\r{self.stage:<18} [{bar:<{_WIDTH}}] {int(share * 100):3} %  {remark}\x1b[K")
        self.drawn = True

    def end(self) -> None:
        if self.drawn:
            self._write("\r\x1b[K")

    @staticmethod
    def _write(text: str) -> None:
        with contextlib.suppress(OSError, ValueError, AttributeError):  # nothing can be done about a closed standard error
            sys.stderr.write(text)
            sys.stderr.flush()


class _NotebookBar(_Bar):
    """A bar below the cell, which goes when the work is done."""

    shown: Any = None

    def draw(self, share: float, remark: str) -> None:
        from IPython.display import HTML, display

        html = HTML(f'<progress value="{share:.3f}" max="1" style="width: 20em"></progress> {self.stage}, {remark}')
        if self.shown is None:
            self.shown = display(html, display_id=True)
        else:
            self.shown.update(html)

    def end(self) -> None:
        if self.shown is not None:
            from IPython.display import HTML

            self.shown.update(HTML(""))
