"""Python values in TOML syntax."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}


def toml_text(value: Any) -> str:
    """The value in TOML, on one line. TypeError for what TOML has no word for."""
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value + 0)  # of a subclass, such as an enumeration's, the number itself
    if isinstance(value, str):
        return '"' + "".join(_ESCAPES.get(c, c if c.isprintable() else _escaped(c)) for c in value) + '"'
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{toml_text(_name(name))} = {toml_text(each)}" for name, each in value.items()) + "}"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    raise TypeError(f"a {type(value).__name__} cannot be the value of a key; give a number, a text, a list or a dict of them, or None")


def _name(name: Any) -> str:
    if isinstance(name, str):
        return name
    raise TypeError(f"{name!r} cannot be a key; keys are texts")


def _escaped(character: str) -> str:
    if "\ud800" <= character <= "\udfff":
        raise ValueError(f"{character!r}, half of a surrogate pair, is no text that UTF-8 can hold")
    return f"\\U{ord(character):08x}"
