"""What is wrong with a display or an argument: where, what was given, what is allowed, and the remedy."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

_OPTION = re.compile(r"(?<![\w-])--([a-z][a-z-]*[a-z])")
_KEYS_OF_OPTIONS = {"eyes-mm": "content.inverse.eyes_mm"}  # options without an argument in Python
_KEY = re.compile(r"[a-z_]+(\.[a-z_0-9]+)*(\[\d+\])*\Z")


class Problem(NamedTuple):
    """A problem of the input."""

    where: str  # "tablet.toml:12:1", a key that was set, an argument, a file
    what: str
    key: str  # the display's key or the argument that is to blame; "" where there is none
    remedy: str  # what is allowed or what to do instead; "" where the message has nothing of that kind

    def __str__(self) -> str:
        named = not self.where or (self.where.startswith(self.key + "=") and self.what.startswith(self.key + ":"))
        return self.what if named else f"{self.where}: {self.what}"


def in_python(text: str) -> str:
    """A message of the program, whose options are arguments in Python: --eye-distance-mm is eye_distance_mm."""
    return _OPTION.sub(lambda option: _KEYS_OF_OPTIONS.get(option[1], option[1].replace("-", "_")), text)


def _problem(where: str, what: str) -> Problem:
    """The problem that a message of the program states."""
    where = "measure" if where == "MEASURE" else where.removeprefix("--set ")
    where, what = in_python(where), in_python(what)
    key, colon, rest = what.partition(": ")
    if not colon or not _KEY.match(key):
        key, rest = where.partition("=")[0], what
        if not _KEY.match(key):
            key = ""
    remedy = re.search(r"(?:; |, (?=allowed))(.*)\Z", rest, re.DOTALL)
    return Problem(where, what, key, remedy[1] if remedy else "")


class InputError(ValueError):
    """Bad input, with all problems that were found. `key` and `remedy` are those of the first."""

    def __init__(self, problems: list[tuple[str, str]]) -> None:
        self.problems = [_problem(*problem) for problem in problems]
        super().__init__("\n".join(map(str, self.problems)))

    @property
    def key(self) -> str:
        return self.problems[0].key if self.problems else ""

    @property
    def remedy(self) -> str:
        return self.problems[0].remedy if self.problems else ""

    @property
    def lacks_memory(self) -> bool:
        """Whether a problem is that too little memory is free, as the program words it: another time there may be enough."""
        return any(" of memory; " in problem.what for problem in self.problems)

    def of_arguments(self, names: Mapping[str, str]) -> InputError:
        """The same error with other places: of the arguments that the user gave."""
        return type(self)([(names.get(problem.where, problem.where), problem.what) for problem in self.problems])

    def __reduce__(self) -> tuple[type[InputError], tuple[list[tuple[str, str]]]]:
        return type(self), ([problem[:2] for problem in self.problems],)


class DisplayError(InputError):
    """Invalid description of a display."""


class UnknownKeyError(DisplayError, KeyError):
    """No display has such a key."""

    __str__ = Exception.__str__  # KeyError would show the message in quotes


class LfdsimWarning(UserWarning):
    """Something was dropped from a model or repaired, or does not fit."""
