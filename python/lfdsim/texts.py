"""Texts that the program can take: in UTF-8."""

from __future__ import annotations

import os
from typing import Any

from lfdsim.errors import InputError


def text(value: Any, name: str) -> str:
    """TypeError unless it is a text; ValueError for one with half of a surrogate pair."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is a {type(value).__name__}; give a text")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise ValueError(f"{name} is no text that UTF-8 can hold: {error}") from None
    return value


def path_text(value: Any, name: str) -> str:
    """Of a path of any kind; InputError for an empty one."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"{name} is a {type(value).__name__}; give a path")
    path = text(os.fsdecode(value), name)
    if not path:
        raise InputError([(name, "is empty; give a path")])
    if "\0" in path:
        raise ValueError(f"{name} is {path!r}; no file's name has a null character")
    return path
