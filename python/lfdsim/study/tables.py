"""Reads tables of a TOML file key by key. Each complaint names the file, the table and the key, and says what is allowed."""

from __future__ import annotations

import datetime
from typing import Any, TypeVar

from .factors import is_number
from .problems import StudyError, nearest

REQUIRED: Any = object()  # of no type, so that the type of what is read is not wider where there is no default
Default = TypeVar("Default")


class Table:
    """Keys are taken one by one; `end` refuses those that nobody took."""

    def __init__(self, file: str, name: str, values: dict[str, Any]) -> None:
        self.file, self.name, self.values = file, name, values
        self.asked: list[str] = []

    def where(self, key: str = "") -> str:
        return f"{self.file}: {self.name}{' ' if self.name and key else ''}{key}".removesuffix(": ")

    def wrong(self, key: str, what: str) -> StudyError:
        return StudyError(self.where(key), what)

    def has(self, key: str) -> bool:
        self.asked.append(key)
        return key in self.values

    def take(self, key: str, default: object = REQUIRED, allowed: str = "") -> Any:
        if not self.has(key):
            if default is REQUIRED:
                raise self.wrong(key, f"is missing; give {allowed}")
            return default
        return self.values[key]

    def text(self, key: str, default: Default = REQUIRED, among: tuple[str, ...] = ()) -> str | Default:
        allowed = "one of " + ", ".join(f'"{a}"' for a in among) if among else "a text"
        value = self.take(key, default, allowed)
        if value is default or isinstance(value, str) and value and (not among or value in among):
            return value
        hint = f" ({nearest(value, among)})" if among and isinstance(value, str) else ""
        raise self.wrong(key, f"is {value!r}; give {allowed}{hint}")

    def number(self, key: str, default: Default = REQUIRED, above: float | None = None) -> float | Default:
        allowed = "a number" + (f" above {above}" if above is not None else "")
        value = self.take(key, default, allowed)
        if value is default or is_number(value) and (above is None or value > above):
            return value
        raise self.wrong(key, f"is {value!r}; give {allowed}")

    def integer(self, key: str, default: Default = REQUIRED, low: int = 0, high: int = 2**53) -> int | Default:
        allowed = f"a whole number from {low} to {high}" if low < high else str(low)
        value = self.take(key, default, allowed)
        if value is default or isinstance(value, int) and not isinstance(value, bool) and low <= value <= high:
            return value
        raise self.wrong(key, f"is {value!r}; give {allowed}")

    def items(
        self, key: str, default: Default = REQUIRED, kind: type | None = str, allowed: str = "a list of texts"
    ) -> list[Any] | Default:
        """A list with at least one entry, all of a kind."""
        value = self.take(key, default, allowed)
        if value is default or isinstance(value, list) and value and all(kind is None or isinstance(v, kind) for v in value):
            return value
        raise self.wrong(key, f"is {value!r}; give {allowed}" + (", not an empty one" if value == [] else ""))

    def size(self, key: str) -> list[int] | None:
        value = self.take(key, None)
        if value is None or isinstance(value, list) and len(value) == 2 and all(type(v) is int and 0 < v < 65536 for v in value):
            return value
        raise self.wrong(key, f"is {value!r}; give columns and rows, 1 to 65535 each, as in [480, 270]")

    def vector(self, key: str, count: int, default: Default = REQUIRED) -> list[float] | Default:
        value = self.items(key, default, None, f"{count} numbers")
        if value is default or isinstance(value, list) and len(value) == count and all(map(is_number, value)):
            return value
        raise self.wrong(key, f"is {value!r}; give {count} numbers")

    def table(self, key: str, default: object = REQUIRED) -> "Table":
        value = self.take(key, {} if default is not REQUIRED else default, "a table")
        if not isinstance(value, dict):
            raise self.wrong(key, f"is {value!r}; give a table")
        return Table(self.file, f"{self.name} {key}".strip(), value)

    def tables(self, key: str) -> list["Table"]:
        """Of [[key]]; none where the file has none."""
        value = self.take(key, [])
        if not (isinstance(value, list) and all(isinstance(v, dict) for v in value)):
            raise self.wrong(key, f"is not a list of tables; write [[{key}]] above each")
        return [Table(self.file, f"[[{key}]] {number}", v) for number, v in enumerate(value, 1)]

    def refuse_dates(self, value: object, place: str = "") -> None:
        """Which TOML has, and no key takes."""
        if isinstance(value, (datetime.date, datetime.time)):  # a datetime is a date
            raise self.wrong(place, f"is the date or time {value}; give a number, a text, a list or a table of them")
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value, 1) if isinstance(value, list) else ():
            self.refuse_dates(inner, f"{place} {key}".strip())

    def end(self) -> None:
        for key in self.values:
            if key not in self.asked:
                raise self.wrong(key, f"is not a key here; {nearest(key, dict.fromkeys(self.asked))}")
