"""Columns of keys' values and of figures, to and from Arrow."""

from __future__ import annotations

import json
from typing import Any

import pyarrow as pa

from .factors import Value

AS_JSON = {b"lfdsim.json": b"1"}  # a column whose values are of several types, or lists: each is a text of JSON


def arrow_of(columns: dict[str, list[Value]]) -> pa.Table:
    fields: list[pa.Field[Any]] = []
    arrays: list[pa.Array[Any]] = []
    for name, values in columns.items():
        kind: pa.DataType
        kinds = {type(v) for v in values if v is not None}
        if kinds <= {int, float} and kinds:
            kind, meta = (pa.int64() if kinds == {int} else pa.float64()), None
        elif kinds in ({bool}, {str}, set()):
            kind, meta = (pa.bool_() if kinds == {bool} else pa.string()), None
        else:
            kind, meta = pa.string(), AS_JSON
            values = [None if v is None else json.dumps(v) for v in values]
        try:
            arrays.append(pa.array(values, kind))
        except (pa.ArrowException, OverflowError):  # an integer beyond 64 bits
            kind, meta = pa.string(), AS_JSON
            arrays.append(pa.array([None if v is None else json.dumps(v) for v in values], kind))
        fields.append(pa.field(name, kind, metadata=meta))
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def values_of(table: pa.Table) -> dict[str, list[Value]]:
    columns = {}
    for field, column in zip(table.schema, table.columns):
        values = column.to_pylist()
        if field.metadata and b"lfdsim.json" in field.metadata:
            values = [None if v is None else json.loads(v) for v in values]
        columns[field.name] = values
    return columns


def figures_arrow(rows: list[dict[str, float | str]]) -> dict[str, pa.Array[Any]]:
    """A column for each figure, in the order in which rows first have it; where a row has none, NaN or no text."""
    names = dict.fromkeys(name for row in rows for name in row)
    columns: dict[str, pa.Array[Any]] = {}
    for name in names:
        values = [row.get(name) for row in rows]
        if any(isinstance(v, str) for v in values):
            columns[name] = pa.array([v if v is None or isinstance(v, str) else None if v != v else repr(v) for v in values], pa.string())
        else:
            columns[name] = pa.array([float("nan") if v is None else float(v) for v in values], pa.float64())
    return columns


def is_uncertainty(name: str) -> bool:
    """Whether a figure only states how uncertain another one is: `zone.horizontal.wrong_50_percent_mm_error.0`."""
    return name.rstrip("0123456789").removesuffix(".").endswith("_error")
