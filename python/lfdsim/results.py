"""Results of a measure."""

from __future__ import annotations

import html
import os
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lfdsim import _core
from lfdsim.arguments import flag
from lfdsim.errors import InputError
from lfdsim.numbers_of import numbers_of
from lfdsim.texts import path_text


class Result:
    """Figures, tables, plots and pictures of one measure. None: a figure that is undefined; `notes` say why.

    It can be pickled, so that measures run in several processes; what was pickled has everything but save().
    """

    _measured: _core.Measured

    def __init__(self, measured: _core.Measured, measure: str) -> None:
        self._measured = measured
        self.measure = measure

    @cached_property
    def figures(self) -> dict[str, Any]:
        """As in the JSON of `lfdsim analyze`; names end in their unit, the error of NAME is NAME_error. Infinite ones are inf."""
        figures: dict[str, Any] = numbers_of(self._measured.figures())
        return figures

    @cached_property
    def notes(self) -> dict[str, str]:
        """Why a figure is None, by its path: {"a.b_deg": "..."}."""
        notes: dict[str, str] = numbers_of(self._measured.notes())
        return notes

    @cached_property
    def findings(self) -> list[dict[str, Any]]:
        """The lines of the report: what, unit, measured and theory (lists of one number or two ends), error, remark."""
        findings: list[dict[str, Any]] = numbers_of(self._measured.findings())
        return findings

    @cached_property
    def remarks(self) -> list[str]:
        """Remarks on what bounds a figure, or on where and why it differs from theory."""
        return self._measured.remarks()

    @cached_property
    def tables(self) -> dict[str, Any]:
        """Curves as pandas.DataFrame; without pandas as dicts of arrays. Columns end in their unit."""
        try:
            from pandas import DataFrame
        except ImportError:
            return self._measured.tables()
        return {name: DataFrame(columns) for name, columns in self._measured.tables().items()}

    @cached_property
    def plots(self) -> dict[str, str]:
        """Curves and maps as SVG."""
        return self._measured.plots()

    @cached_property
    def pictures(self) -> dict[str, tuple[str, NDArray[np.float32]]]:
        """(caption, picture) of each: float32, height x width x 3, linear light."""
        return self._measured.pictures()

    @cached_property
    def seconds(self) -> float:
        """The time that measuring took."""
        return self._measured.seconds()

    def save(self, folder: str | os.PathLike[str], *, replace: bool = False) -> None:
        """Writes what `lfdsim analyze -o FOLDER` writes: figures, tables, plots, pictures, report.html. InputError where the folder
        holds results of another display or other settings, unless those are to be replaced, and of a result that was pickled."""
        if "_measured" not in self.__dict__:
            raise InputError([("save", "this result was pickled; save it where it is measured")])
        self._measured.save(path_text(folder, "folder"), f"lfdsim.analyze(display, {self.measure!r})", flag(replace, "replace"))

    def __getstate__(self) -> dict[str, Any]:
        kept = ("measure", "figures", "notes", "findings", "remarks", "tables", "plots", "pictures", "seconds")
        return {name: getattr(self, name) for name in kept}

    def __repr__(self) -> str:
        lines = [_line(finding) for finding in self.findings]
        return "\n".join([f"lfdsim.Result of {self.measure!r}", *(f"  {what}: {values}" for what, values in lines)])

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td style='text-align:left'>{html.escape(what)}</td><td>{html.escape(values)}</td></tr>"
            for what, values in map(_line, self.findings)
        )
        remarks = "".join(f"<p>{html.escape(remark)}</p>" for remark in self.remarks)
        return f"<table>{rows}</table>{remarks}{''.join(self.plots.values())}"


def _line(finding: dict[str, Any]) -> tuple[str, str]:
    """What was found, and the values: measured (and theory)."""

    def text(values: list[float | None]) -> str:
        return " to ".join("none" if value is None else f"{value:.4g}" for value in values)

    value = f"{text(finding['measured'])} {finding['unit']}".strip() if finding["measured"] else ""
    theory = f"theory {text(finding['theory'])} {finding['unit']}".strip() if finding["theory"] else ""
    return finding["what"], ", ".join(filter(None, (value, theory)))
