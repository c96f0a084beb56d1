"""Python values in TOML syntax."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}


def toml_text(value: Any) -> str:
    """The value in TOML, on one line; in a dict None is the value of a key that is absent. TypeError for what TOML has no word for,
    OverflowError for a whole number that a description cannot hold."""
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and not -(2**63) <= value < 2**63:
        raise OverflowError(f"is or holds {value}; whole numbers have 64 bits; give one from -2^63 to 2^63 - 1")
    if isinstance(value, (int, float)):
        return repr(value + 0)  # of a subclass, such as an enumeration's, the number itself
    if isinstance(value, str):
        return '"' + "".join(_ESCAPES.get(c, c if c.isprintable() else _escaped(c)) for c in value) + '"'
    if isinstance(value, Mapping):
        given = {_name(name): each for name, each in value.items() if each is not None}
        return "{" + ", ".join(f"{toml_text(name)} = {toml_text(each)}" for name, each in given.items()) + "}"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    if value is None:
        raise TypeError("None cannot be in a list; leave it out")
    raise TypeError(f"a {type(value).__name__} cannot be the value of a key; give a number, a text, a list or a dict of them, or None")


def _name(name: Any) -> str:
    if isinstance(name, str):
        return name
    raise TypeError(f"{name!r} cannot be a key; keys are texts")


def _escaped(character: str) -> str:
    if "\ud800" <= character <= "\udfff":
        raise ValueError(f"{character!r}, half of a surrogate pair, is no text that UTF-8 can hold")
    return f"\\U{ord(character):08x}"
