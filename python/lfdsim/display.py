"""A light field display, as its description in TOML says."""

from __future__ import annotations

import html
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from lfdsim import _core
from lfdsim.errors import DisplayError, UnknownKeyError
from lfdsim.texts import path_text, text as text_of
from lfdsim.toml_text import toml_text


class Display:
    """A valid display, which never changes. Keys are those of a description (docs/format.md): "array.gap_mm", "lens.surface.0.conic".

    Files that it names have absolute paths, so that it is the same display in any folder and process.
    """

    __slots__ = ("_handle", "_text", "_values")
    _handle: _core.Display
    _text: str | None
    _values: dict[str, Any] | None

    def __init__(self) -> None:
        raise TypeError("use Display.load(path) or Display.parse(text)")

    @classmethod
    def _of(cls, handle: _core.Display) -> Display:
        display = object.__new__(cls)
        display._handle, display._text, display._values = handle, None, None
        return display

    @classmethod
    def load(cls, path: str | os.PathLike[str], changes: Mapping[str, Any] | None = None) -> Display:
        """Reads a description from a file, with keys changed as by with_(). DisplayError names every problem of it with its line; of
        what is changed the file may say what is impossible."""
        return cls._of(_core.Display.load(path_text(path, "path"), _overrides(changes or {})))

    @classmethod
    def parse(cls, text: str, folder: str | os.PathLike[str] | None = None, changes: Mapping[str, Any] | None = None) -> Display:
        """Reads a description from a text, with keys changed as by load(). Files that it names are relative to `folder`; default: the
        working directory."""
        place = os.getcwd() if folder is None else path_text(folder, "folder")
        return cls._of(_core.Display.parse(text_of(text, "text"), place, _overrides(changes or {})))

    def with_(self, changes: Mapping[str, Any]) -> Display:
        """The display with keys changed: {"array.gap_mm": 3.3, "diffuser": None}; None removes a key or table. A table is replaced as a
        whole: in its dict, too, None is a key that is absent, so that one that was read can be put back."""
        overrides = _overrides(changes)
        return Display._of(self._handle.changed(overrides)) if overrides else self

    def _with_model(self, model: str | os.PathLike[str] | None) -> Display:
        return self if model is None else Display._of(self._handle.with_model(path_text(model, "model")))

    def __getitem__(self, key: str) -> Any:
        """The value of a key; of a table a dict, of a list of tables a tuple of dicts; None where the display has none."""
        values = self._all()
        if text_of(key, "key") in values:
            return values[key]
        inside = {name[len(key) + 1 :]: value for name, value in values.items() if name.startswith(key + ".")}
        if inside:
            return _tree(inside)
        if _core.known(key):
            return None
        raise _unknown(key)

    def __contains__(self, key: object) -> bool:
        """Whether keys() has the key, or it is that of a table that has a value."""
        return isinstance(key, str) and (key in self._all() or any(name.startswith(key + ".") for name in self._all()))

    def __iter__(self) -> Iterator[str]:
        return self.keys()

    def keys(self) -> Iterator[str]:
        """The keys that have a value, in the order of a description, those that are absent but allowed among them."""
        return iter(self._all())

    def to_dict(self) -> dict[str, Any]:
        """All keys as nested dicts."""
        tree: dict[str, Any] = _tree(self._all())
        return tree

    def drawings(self) -> tuple[str, str]:
        """The display from the side, and a few of its lenses, to scale and with rays: SVG."""
        return self._handle.drawings()

    def _repr_html_(self) -> str:
        text = f"<details><summary>its description</summary><pre>{html.escape(repr(self))}</pre></details>"
        return "".join(self.drawings()) + text

    def _all(self) -> dict[str, Any]:
        if self._values is None:
            # A name of a file, or the display's own, that is absent is an empty text in a description.
            self._values = {key: None if value == "" else value for key, value in self._handle.values().items()}
            if glasses := [key for key, value in self._values.items() if key.endswith(".glass") and value is not None]:
                written = tomllib.loads(repr(self))  # with all that a table of a glass says
                self._values |= {key: _glass_at(key, written) for key in glasses}
        return self._values

    def __repr__(self) -> str:
        if self._text is None:
            self._text = self._handle.text()
        return self._text

    def __eq__(self, other: object) -> bool:
        return repr(self) == repr(other) if isinstance(other, Display) else NotImplemented

    def __hash__(self) -> int:
        return hash(repr(self))

    def __reduce__(self) -> tuple[Callable[[_core.Display], Display], tuple[_core.Display]]:
        return Display._of, (self._handle,)


def _unknown(key: str) -> UnknownKeyError:
    meant = _core.meant(key)
    return UnknownKeyError([("", f"{key or repr(key)}: is unknown; " + (f"did you mean {meant}?" if meant else "docs/format.md lists all keys"))])


def _overrides(changes: Mapping[str, Any]) -> list[str]:
    if not isinstance(changes, Mapping):
        raise TypeError(f"changes are a dict of keys and values, not a {type(changes).__name__}")
    return [_override(key, value) for key, value in changes.items()]


def _override(key: Any, value: Any) -> str:
    """An override in the form of the program's option --set."""
    if not text_of(key, "key") or "=" in key or not key.isprintable():
        raise _unknown(key)
    if value is not None:
        try:
            return f"{key}={toml_text(value)}"
        except OverflowError as error:
            raise DisplayError([(f"{key}={value}", f"{key}: {error}")]) from None
        except (TypeError, ValueError) as error:
            raise type(error)(f"{key}: {error}") from None
    if not _core.known(key):
        raise _unknown(key)
    default = _core.default_word(key)
    return f"{key}=none" if default is None else f"{key}={toml_text(default)}"


def _glass_at(key: str, description: dict[str, Any]) -> Any:
    """A name, or a table whose lists are tuples, as of other keys."""
    glass: Any = description
    for part in key.split("."):
        glass = glass[int(part) if part.isdigit() else part]
    if isinstance(glass, str):
        return glass
    return {k: tuple(map(float, v)) if isinstance(v, list) else v if isinstance(v, str) else float(v) for k, v in glass.items()}


def _tree(values: Mapping[str, Any]) -> Any:
    """Nested dicts from dotted keys; tuples where parts of keys are numbers."""
    parts: dict[str, Any] = {}
    for name, value in values.items():
        first, dot, rest = name.partition(".")
        if dot:
            parts.setdefault(first, {})[rest] = value
        else:
            parts[first] = value
    made = {name: _tree(value) if any(key.startswith(name + ".") for key in values) else value for name, value in parts.items()}
    return tuple(made.values()) if made and all(name.isdigit() for name in made) else made
