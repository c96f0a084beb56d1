"""Studies: one display, changed in many ways and measured each time, on this machine's cores or on many machines. See docs/studies.md."""

import importlib
from typing import TYPE_CHECKING

_HOMES = {
    "api": ("collect", "plan", "report", "run", "run_part"),
    "problems": ("StudyError", "StudyFailed"),
    "tolerances": ("Loss", "Tolerance", "tolerance"),
}
__all__ = ["Loss", "StudyError", "StudyFailed", "Tolerance", "collect", "plan", "report", "run", "run_part", "tolerance"]

if TYPE_CHECKING:  # type checkers, which then know that there are no other names
    from lfdsim.study.api import collect, plan, report, run, run_part
    from lfdsim.study.problems import StudyError, StudyFailed
    from lfdsim.study.tolerances import Loss, Tolerance, tolerance
else:

    def __getattr__(name: str) -> object:
        """When it is first asked for, so that a package that is missing is told by the command, and not by Python."""
        for home, names in _HOMES.items():
            if name in names:
                return getattr(importlib.import_module(f"{__name__}.{home}"), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
