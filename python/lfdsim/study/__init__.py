"""Studies: one display, changed in many ways and measured each time, on this machine's cores or on many machines. See docs/studies.md."""

from .api import collect, plan, report, run, run_part
from .problems import StudyError, StudyFailed
from .tolerances import Loss, Tolerance, tolerance

__all__ = ["Loss", "StudyError", "StudyFailed", "Tolerance", "collect", "plan", "report", "run", "run_part", "tolerance"]
