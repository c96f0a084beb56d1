"""report.html of a study: one file to send to a colleague."""

from __future__ import annotations

import base64
import html
import pathlib

import numpy as np

from .. import files
from ..planned import Plan
from ..problems import counted
from . import data as reading
from . import effects, kept, plots
from .data import Data
from .extremes import extremes

NAME = kept.NAME
PERCENT = (1, 5, 25, 50, 75, 95, 99)
STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:72em;margin:2em auto;padding:0 1em;color:#1c2733}
h2{margin-top:2em;border-bottom:1px solid #ccd}
table{border-collapse:collapse;font-size:13px;display:block;overflow-x:auto}
td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #e3e7ec}
td:first-child,th:first-child{text-align:left}
svg{max-width:100%;height:auto}.rows{display:flex;gap:1.5em;flex-wrap:wrap}
.rows figure{margin:0;max-width:22em}.rows img{max-width:100%}p.note{color:#55606c}"""


def write(plan: Plan) -> pathlib.Path:
    data = reading.read(plan)
    parts = [_head(data), _failures(data)]
    shown = bool(len(data.rows) and data.figures)
    parts += [_figures(data)] if shown else []
    parts.append(_yield(data))
    parts += [_main_effects(data), _interactions(data), _cost(data), _pareto(data), _extremes(data)] if shown else []
    text = (
        f"<!DOCTYPE html><html lang=en><meta charset=utf-8><meta name=rows content={kept.mark(plan)}>\n"
        f"<title>{_text(plan.name)}</title><style>{STYLE}</style>\n"
        + "\n".join(p for p in parts if p)
        + "\n</html>\n"
    )
    files.write_whole(plan.folder / NAME, text.encode())
    return plan.folder / NAME


def _text(value: object) -> str:
    return html.escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def table(head: list[str], rows: list[list[object]]) -> str:
    lines = ["<tr>" + "".join(f"<th>{_text(h)}</th>" for h in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{_text(v)}</td>" for v in row) + "</tr>" for row in rows]
    return f"<table>{''.join(lines)}</table>"


def _head(data: Data) -> str:
    study = data.plan.study
    how = {
        "grid": "all combinations of the factors' values",
        "lhs": "a Latin hypercube",
        "sobol": "a Sobol sequence",
        "table": "rows of a table",
        "monte_carlo": "random draws",
        "saltelli": "Saltelli's design for Sobol indices",
    }[study.design]
    repeated = f", each {study.replicates} times with other seeds" if study.replicates > 1 else ""
    return (
        f"<h1>{_text(data.plan.name)}</h1><p>{counted(data.plan.rows, 'row')}, {len(data.failed)} of them impossible; {how}{repeated}; display "
        f"{_text(study.display_path.name)}. All rows are in study.parquet; study {data.plan.identity[:12]}.</p>"
    )


def _failures(data: Data) -> str:
    if not len(data.failed):
        return ""
    causes = data.failed.groupby("error")["row"].agg(["count", "min"]).sort_values("count", ascending=False)
    rows = [[str(error)[:300], int(line["count"]), int(line["min"])] for error, line in causes.head(10).iterrows()]
    more = f"<p>{counted(len(causes) - 10, 'more reason')} in study.parquet.</p>" if len(causes) > 10 else ""
    return f"<h2>Impossible rows</h2>{table(['reason', 'rows', 'the first'], rows)}{more}"


def _figures(data: Data) -> str:
    rows = []
    for name in data.figures:
        values = data.rows[name].to_numpy(float)
        known = values[np.isfinite(values)]
        rows.append(
            [name, len(known), known.mean(), known.std(ddof=1) if len(known) > 1 else 0.0, *np.percentile(known, PERCENT).tolist()]
            if len(known)
            else [name, 0] + ["-"] * (2 + len(PERCENT))
        )
    head = ["figure", "rows with it", "mean", "standard deviation", *(f"{p} %" for p in PERCENT)]
    return (
        f"<h2>Figures</h2>{table(head, rows)}<p class=note>Percentiles: so many rows are below. Lines in the plots: 5, 50 and 95 %; "
        f"orange: limits.</p>{plots.histograms(data)}"
    )


def _yield(data: Data) -> str:
    limits = data.plan.study.limits
    if not limits:
        return ""
    all_pass, rows = np.ones(len(data.rows), bool), []
    for limit in limits:
        found = data.rows[limit.figure] if limit.figure in data.rows else np.full(len(data.rows), np.nan)
        passed = effects.passes(np.asarray(found, float), limit)
        all_pass &= passed
        rows.append([limit.figure, "-" if limit.low is None else limit.low, "-" if limit.high is None else limit.high, *_share(data, passed)])
    rows.append(["all limits", "", "", *_share(data, all_pass)])
    alike = " Replicates of one row resemble each other: they narrow the interval only as far as they differ."
    repeated = alike if data.plan.study.replicates > 1 else ""
    if data.plan.study.design == "saltelli":
        repeated += f" The first {_base_rows(data)} rows of the design count: the others repeat their values."
    if data.plan.study.design != "monte_carlo":
        repeated += " The interval is that of independent draws: for rows that are spread evenly it is too wide."
    return (
        f"<h2>Yield</h2>{table(['figure', 'min', 'max', 'rows that pass', 'share', '95 % interval'], rows)}"
        f"<p class=note>Impossible rows, and rows without the figure, do not pass.{repeated}</p>"
    )


def _share(data: Data, passed: np.ndarray) -> list[object]:
    of, rows = data.plan.study.replicates, _base_rows(data)
    of_each = np.bincount(data.rows["row"].to_numpy() // of, passed, minlength=rows)[:rows]
    share, low, high = effects.share_with_interval(of_each, of)
    return [int(of_each.sum()), f"{100 * share:.2f} %", f"{100 * low:.2f} .. {100 * high:.2f} %"]


def _base_rows(data: Data) -> int:
    """How many of the design's rows, from the first on, repeat no other's values: of saltelli those of A and B."""
    study = data.plan.study
    return 2 * study.rows if study.design == "saltelli" else data.plan.rows // study.replicates


def _main_effects(data: Data) -> str:
    if not data.factors:
        return ""
    return (
        "<h2>Main effects</h2><p class=note>Grey: rows. Blue: their mean in groups of the factor's values, over all "
        "values of the others.</p>" + "".join(plots.main_effects(data, name) for name in data.figures)
    )


def _interactions(data: Data) -> str:
    drawn = [(name, pairs) for name in data.figures if (pairs := plots.strongest_pairs(data, name))]
    if not drawn:
        return ""
    return (
        "<h2>Interactions</h2><p class=note>Where lines are not parallel, one factor's effect depends on the other. Their strength "
        "is what the two do together beyond the sum of both, root mean square, in the figure's unit; "
        "chance alone makes some of it in designs other than grids. Pairs of factors are left out if some combination has no row with a finite figure.</p>"
        + "".join(plots.interactions(data, pairs, name) for name, pairs in drawn)
    )


def _cost(data: Data) -> str:
    """Which factor moves a figure most."""
    # Texts and lists have no order: a line through them says nothing, unless they are two.
    names = [n for n in data.factors if n in data.numbers or len(np.unique(data.factors[n])) == 2]
    without = [_text(n) for n in (*data.factors, *data.left_out) if n not in names]
    parts = [f"<p>Left out of the regression, as texts, lists and empty cells have no order: {', '.join(without)}.</p>"] if without else []
    if not data.factors and not data.left_out:
        return ""
    matrix = np.column_stack([data.factors[n] for n in names]) if names else None
    replicates = data.plan.study.replicates
    repeated = "; replicates of one row count by their mean" if replicates > 1 else ""
    row = data.rows["row"].to_numpy() // replicates
    base = row < _base_rows(data)
    for figure in data.figures:
        y = data.rows[figure].to_numpy(float)
        found = None if matrix is None else effects.regression(matrix[base], y[base], row[base])
        if found:
            doubt = (
                "" if found.explained > 0.5 else " That is little: the figure does not follow straight lines, and the bars say little, too."
            )
            parts.append(
                f"<p>{_text(figure)}: what one standard deviation of each factor does, with 95 % intervals, by linear regression, which "
                f"explains {100 * found.explained:.1f} % of the variance{repeated}.{doubt}</p>"
                + plots.bars(names, found.coefficients, found.errors, f"change of {figure}")
            )
        if data.plan.study.design == "saltelli":
            parts.append(_sobol(data, figure, y))
    return "<h2>What costs most</h2>" + "".join(parts) if parts else ""


def _why_no_sobol(data: Data, y: np.ndarray) -> str:
    """Empty where there are Sobol indices."""
    if data.plan.study.replicates > 1:
        return "rows have replicates"
    if len(data.failed):
        return f"{counted(len(data.failed), 'row')} impossible"
    if missing := int((~np.isfinite(y)).sum()):
        return f"{counted(missing, 'row')} without a finite figure"
    return "all rows have the same figure" if np.ptp(y) == 0 else ""


def _sobol(data: Data, figure: str, y: np.ndarray) -> str:
    names = [f.name for f in data.plan.study.factors]
    if why := _why_no_sobol(data, y):
        return f"<p>{_text(figure)}: no Sobol indices: {why}.</p>"
    found = effects.sobol(y, len(names))
    return f"<p>{_text(figure)}: Sobol indices, shares of the variance, with 95 % intervals.</p>" + plots.bars(
        names,
        found.first,
        found.first_error,
        f"share of the variance of {figure}",
        (found.total, found.total_error),
        ("alone", "with interactions"),
    )


def _pareto(data: Data) -> str:
    objectives = data.plan.study.objectives
    if len(objectives) < 2:
        return ""
    names = [o.figure for o in objectives]
    front = effects.pareto(data.rows[names].to_numpy(float), objectives)
    if not front.any():
        return "<h2>Pareto front</h2><p>There is none: no row has finite figures for all objectives.</p>"
    keys = list(data.factors)
    rows = data.rows[front].sort_values(names[0])
    shown = rows.iloc[np.linspace(0, len(rows) - 1, min(len(rows), 30)).astype(int)]
    return (
        f"<h2>Pareto front</h2><p>Rows that none surpasses in all objectives at once: {len(rows)}; {len(shown)} of them below.</p>"
        + plots.pareto(data, front)
        + table(["row", *names, *keys], shown[["row", *names, *keys]].astype(object).values.tolist())
    )


def _extremes(data: Data) -> str:
    if not data.plan.study.objectives:
        return "<h2>Best, middle and worst</h2><p class=note>An [[objective]] in the study's file says which rows these are.</p>"
    objective, blocks = data.plan.study.objectives[0], []
    for title, row, picture in extremes(data):
        shown = (
            f'<img src="data:image/png;base64,{base64.b64encode(picture).decode()}" alt="">'
            if isinstance(picture, bytes)
            else _text(picture)
        )
        values = [[n, data.rows[n].iloc[row]] for n in (*data.figures, *data.factors)]
        blocks.append(
            f"<figure>{shown}<figcaption><b>{title}</b>: row {int(data.rows['row'].iloc[row])}{table(['', ''], values)}"
            "</figcaption></figure>"
        )
    by = f"<p>By {_text(objective.figure)}; {objective.best} is best.</p>"
    return f"<h2>Best, middle and worst</h2>{by}<div class=rows>{''.join(blocks)}</div>"
