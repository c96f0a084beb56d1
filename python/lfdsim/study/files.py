"""Files that are whole or absent: written beside their place and renamed.

Tables of columns in Parquet, with checksums of what they hold.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import json
import os
import pathlib
import time
import tomllib
import uuid
from collections.abc import Iterator
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from .. import _core
from ..errors import InputError
from .problems import StudyError, StudyFailed

MOST_TEXT = 1 << 24  # bytes of a file that people write
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
NOTE = b"lfdsim"  # of a Parquet file's metadata: what it belongs to, and its checksum


def read_text(path: pathlib.Path) -> str:
    """Of a file that people write."""
    try:
        with open(path, "rb") as file:
            content = file.read(MOST_TEXT + 1)
        if len(content) > MOST_TEXT:
            raise StudyError(path, f"has more than {MOST_TEXT >> 20} MiB, which no description has; give another file")
        return content.decode("utf-8-sig")
    except OSError as error:
        raise StudyError(path, f"cannot be read: {error.strerror}") from error
    except ValueError as error:  # not UTF-8, or a name with a zero in it
        if isinstance(error, StudyError):
            raise
        raise StudyError(path, f"cannot be read: {error}") from error


def parse_toml(text: str, path: object) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise StudyError(path, "is not TOML that can be read: its lists or tables are too deep") from error
    except ValueError as error:  # TOMLDecodeError is one; so is a number of thousands of digits
        raise StudyError(path, f"is not TOML: {error}") from error


@contextlib.contextmanager
def full_disk_told(path: pathlib.Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        if error.errno not in FULL:
            raise
        raise StudyFailed(
            path, f"cannot be written: {error.strerror}. Finished rows are kept; make room and run the same command again"
        ) from error


_held: set[pathlib.Path] = set()  # by this process


@contextlib.contextmanager
def held(folder: pathlib.Path, seconds: float = 60) -> Iterator[None]:
    """The folder, made if it is missing, for this process alone, as the program's own commands hold theirs: while a study is planned there.

    Of several that start at once on a cluster the first one plans, and the others wait.
    """
    place, deadline, fresh = folder.resolve(), time.monotonic() + seconds, not folder.exists()
    if place in _held:
        yield
        return
    while True:
        try:
            lock = _core.FolderLock(str(folder))
            break
        except InputError as error:
            if "another run" not in str(error) or time.monotonic() > deadline:
                raise StudyError("", str(error)) from None
            time.sleep(0.1)
    _held.add(place)
    try:
        yield
    finally:
        _held.discard(place)
        with contextlib.suppress(OSError):
            if fresh:  # a study that was refused leaves nothing: a folder with files in it stays
                folder.rmdir()
        del lock


def refuse_foreign(path: pathlib.Path, text: str | None = None) -> None:
    """Before a study is planned its folder has no such file, unless it has just this text: nothing that nobody named is written over."""
    if os.path.lexists(path) and (text is None or path.is_dir() or path.read_bytes() != text.encode()):
        raise StudyError(path, "exists and is no file of this study, which would write over it; give another folder, or remove it")


def write_whole(path: pathlib.Path, content: bytes | memoryview) -> None:
    """On the disk before it has its name: neither a kill nor a power cut leaves a part of it."""
    beside = path.with_name(f".{path.name}.{uuid.uuid4().hex[:12]}")
    with full_disk_told(path):
        try:
            with open(beside, "wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            os.replace(beside, path)
        except BaseException:
            beside.unlink(missing_ok=True)
            raise
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)


def write_json(path: pathlib.Path, value: object) -> None:
    write_whole(path, (json.dumps(value, indent=1) + "\n").encode())


def digest(value: object) -> str:
    return hashlib.sha256(json.dumps(value, sort_keys=True, separators=(",", ":"), default=str).encode()).hexdigest()


def checksum(table: pa.Table, about: dict[str, Any]) -> str:
    """Of names, types and values, and of what the table belongs to; not of how a version of a library lays them out in a file."""
    sum_ = hashlib.sha256(digest(about).encode())
    for name, column in zip(table.column_names, table.columns):
        sum_.update(f"{name}:{column.type}:{len(column)}:".encode())
        if pa.types.is_floating(column.type) or pa.types.is_integer(column.type):
            values = column.to_numpy()
            sum_.update(np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes())
            if column.null_count:
                sum_.update(np.asarray(column.is_null()).tobytes())
        else:
            sum_.update(json.dumps(column.to_pylist()).encode())
    return sum_.hexdigest()


def write_table(
    path: pathlib.Path, table: pa.Table, about: dict[str, Any], more: dict[str, Any] | None = None, rows_per_group: int | None = None
) -> None:
    """`about` is covered by the checksum; `more` (times that things took) is not."""
    note = {"about": about, "checksum": checksum(table, about), **(more or {})}
    sink = pa.BufferOutputStream()
    kept = table.schema.metadata or {}
    pq.write_table(table.replace_schema_metadata(kept | {NOTE: json.dumps(note).encode()}), sink, row_group_size=rows_per_group)
    write_whole(path, memoryview(sink.getvalue()))


def note_of(path: pathlib.Path) -> dict[str, Any]:
    try:
        note: dict[str, Any] = json.loads((pq.read_schema(path).metadata or {})[NOTE])
        return note
    except (KeyError, ValueError, OSError, pa.ArrowException) as error:
        raise StudyError(
            path, f"is not a table that this study wrote ({type(error).__name__}); remove it (it is made again from rows/), or rename it"
        ) from error


def is_of(path: pathlib.Path, identity: str) -> bool:
    """Whether a table is there that belongs to the study of this identity."""
    try:
        return bool(path.exists() and note_of(path).get("about", {}).get("study") == identity)
    except StudyError:
        return False


def read_table(path: pathlib.Path, about: dict[str, Any], remedy: str) -> tuple[pa.Table, dict[str, Any]]:
    """The table and its note, if it is as it was written."""
    try:
        table = pq.read_table(path, partitioning=None)
        note = json.loads((table.schema.metadata or {})[NOTE])
        kept = {k: v for k, v in table.schema.metadata.items() if k != NOTE}
        table = table.replace_schema_metadata(kept)
        if note["about"] == about and note["checksum"] == checksum(table, about):
            return table, note
    except (KeyError, TypeError, ValueError, OSError, pa.ArrowException):
        pass
    raise StudyError(path, f"was changed by hand, damaged, or comes from another study; {remedy}")
