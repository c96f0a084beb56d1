"""One table of all rows of a study: study.parquet. Made from the chunks alone, so it is the same whoever computed them, and when."""

from __future__ import annotations

from typing import Any

import pyarrow as pa

from . import chunk, files
from .planned import Plan
from .problems import StudyError, counted, listed, nearest

NAME = "study.parquet"


def table_of(plan: Plan) -> pa.Table:
    """The table of a finished study, from its file if it is there and as it was written. Columns: row, what was varied, figures, error."""
    path = plan.folder / NAME
    figures = {m.label: list(m.figures) for m in plan.study.measures}
    about = {"study": plan.identity, "figures": figures, "wished": plan.study.wished}
    if path.exists() and files.note_of(path).get("about") == about:
        return files.read_table(path, about, "remove it (it is made again from rows/), or rename it")[0]
    if path.exists() and files.note_of(path).get("about", {}).get("study") != plan.identity:
        raise StudyError(path, "is another study's; rename it or remove it")
    missing = plan.missing()
    if missing:
        raise StudyError(
            plan.folder,
            f"is not finished: {counted(len(missing), 'chunk')} of {plan.chunks} missing ({listed(map(str, missing))}); run them first",
        )
    table = _joined(plan, [chunk.read(plan, c)[0] for c in range(plan.chunks)])
    files.write_table(path, table, about)
    for left in (*(plan.folder / "rows").glob("*.journal"), *(plan.folder / "rows").glob(".chunk-*")):  # of runs that were killed
        left.unlink(missing_ok=True)
    return table


def _joined(plan: Plan, parts: list[pa.Table]) -> pa.Table:
    measured = pa.concat_tables(_alike(parts), promote_options="default")
    planned = plan.table()
    wanted = wanted_figures(plan, measured)
    columns = {"row": measured["row"]} | {n: planned[n] for n in planned.column_names} | {n: measured[n] for n in wanted}
    return pa.table({name: _whole(column) for name, column in (columns | {"error": measured["error"]}).items()})


def _alike(parts: list[pa.Table]) -> list[pa.Table]:
    """A figure that is a text in one row is a text in all."""
    texts = {f.name for part in parts for f in part.schema if f.type == pa.string()}
    return [part.cast(pa.schema([pa.field(f.name, pa.string() if f.name in texts else f.type) for f in part.schema])) for part in parts]


def _whole(column: pa.ChunkedArray[Any]) -> pa.Array[Any]:
    """In one piece, with NaN where a number is missing, as every chunk has it."""
    whole = column.combine_chunks()
    return whole.fill_null(float("nan")) if pa.types.is_floating(whole.type) else whole


def wanted_figures(plan: Plan, measured: pa.Table) -> list[str]:
    """Of those that were measured, what the study's file asks for; a name stands for all that begin with it and a dot."""
    names = [n for n in measured.column_names if n not in ("row", "error")]
    wanted = []
    for measure in plan.study.measures:
        own = [n for n in names if n.startswith(measure.label + ".")]
        for figure in measure.figures:
            found = [n for n in own if f"{n}.".startswith(f"{measure.label}.{figure}.")]
            if not found and own:  # without own ones no row was possible
                raise StudyError(
                    f"{plan.study.path}: [[measure]] {measure.label}: figures",
                    f'"{figure}" is not a figure of {measure.name}; ' + nearest(figure, [n.removeprefix(measure.label + ".") for n in own]),
                )
            wanted += found
        wanted += own if not measure.figures else []
    labels = tuple(p.name + "." for p in plan.study.pictures)
    wanted += [n for n in names if n.startswith(labels)] if labels else []
    numbers = [n for n in names if pa.types.is_floating(measured.schema.field(n).type)]
    for figure in plan.study.wished:
        stem, _, last = figure.rpartition(".")
        undefined = last.isdigit() and stem in numbers  # a list without values is one NaN under its own name
        if names and figure not in numbers and not undefined:
            what = "is a text here, not a number" if figure in names else "is not a figure"
            raise StudyError(f"{plan.study.path}: [[limit]], [[objective]] or --loss", f'"{figure}" {what}; {nearest(figure, numbers)}')
        wanted += [figure] if figure in names else []
    return list(dict.fromkeys(wanted))


def check_wishes(plan: Plan, number: int) -> None:
    """After the first chunk: that the figures which the file names exist, before a night is spent on the others."""
    wanted_figures(plan, chunk.read(plan, number)[0])
