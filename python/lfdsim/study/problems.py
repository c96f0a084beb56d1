"""Errors of studies: what is wrong, where, and what to do about it."""

from __future__ import annotations

import difflib
import pathlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, SupportsIndex

from lfdsim import _core
from lfdsim.errors import InputError
from lfdsim.texts import path_text

if TYPE_CHECKING:
    import pandas


class StudyError(ValueError):
    """Something that the user can mend. `where` names the file, table and key; the message says what is allowed."""

    def __init__(self, where: object, what: str):
        message = f"{where}: {what}" if where else what
        super().__init__(_core.shown(message.encode(errors="backslashreplace").decode()))
        self.where = str(where)


class StudyFailed(StudyError):
    """Work that failed though the input is right: a process died, memory or a device was missing. It may succeed another time."""


def whole(value: object, name: str, low: int, high: int) -> int:
    if isinstance(value, SupportsIndex) and not isinstance(value, bool) and low <= value.__index__() <= high:
        return value.__index__()
    raise StudyError(name, f"is {value!r}; give a whole number from {low} to {high}")


def path_of(value: object, name: str) -> pathlib.Path:
    try:
        return pathlib.Path(path_text(value, name))
    except InputError as error:
        raise StudyError("", str(error)) from None


def counted(count: int, one: str) -> str:
    """1 row, 2 rows."""
    return f"{count} {one}" if count == 1 else f"{count} {one}s"


def most_often(reasons: "pandas.Series") -> str:
    """The most frequent of the reasons why rows are impossible, as a further clause; nothing without any."""
    return f", most often because: {reasons.value_counts().index[0]}" if len(reasons) else ""


def listed(names: Iterable[str], most: int = 12) -> str:
    names = list(names)
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def nearest(name: str, known: Iterable[str]) -> str:
    """What was meant, as the end of a message: the most similar names, or all where none is."""
    known = list(known)
    similar = difflib.get_close_matches(name, known, n=3, cutoff=0.6)
    if similar:
        return "did you mean " + " or ".join(similar) + "?"
    return "there are: " + listed(known) if known else "there are none"
