"""Texts that the program can take: in UTF-8."""

from __future__ import annotations

import os
from typing import Any


def text(value: Any, name: str) -> str:
    """TypeError unless it is a text; UnicodeEncodeError, a ValueError, for one with half of a surrogate pair."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is a {type(value).__name__}; give a text")
    value.encode()
    return value


def path_text(value: Any, name: str) -> str:
    """Of a path of any kind."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"{name} is a {type(value).__name__}; give a path")
    return text(os.fsdecode(value), name)
