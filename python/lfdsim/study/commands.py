"""What `lfdsim study` and `lfdsim tolerance` do with their words. Exit codes are those of the program: see __main__."""

from __future__ import annotations

import argparse
import contextlib
import datetime
import pathlib
import signal
import sys
import tomllib
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TextIO, cast

from .. import _core
from ..errors import LfdsimWarning
from . import api
from .file import MOST_ROWS
from .problems import StudyError, StudyFailed, counted, most_often
from .runs import MOST_AT_ONCE
from .tolerances import MEASURES, Loss, tolerance

if TYPE_CHECKING:
    import pandas

COMMANDS = ("run", "plan", "collect", "report", "tolerance")


class _Harmless:
    """A stream whose text is not obeyed by a terminal; what is written to `stream` itself is."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def write(self, text: str) -> int:
        self.stream.write(_core.harmless(text.encode(errors="backslashreplace").decode()))
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.stream, name)


def main(words: list[str]) -> int:
    with contextlib.redirect_stdout(cast(TextIO, _Harmless(sys.stdout))), contextlib.redirect_stderr(cast(TextIO, _Harmless(sys.stderr))):
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning
            return _main(words)


def _show_warning(
    message: Warning | str, category: type[Warning], filename: str, lineno: int, file: TextIO | None = None, line: str | None = None
) -> None:
    """Of this package as the program's own; of others as Python does."""
    own = issubclass(category, LfdsimWarning)
    sys.stderr.write(f"lfdsim: warning: {message}\n" if own else warnings.formatwarning(message, category, filename, lineno, line))


def _main(words: list[str]) -> int:
    short = words and words[0] not in (*COMMANDS, "-h", "--help")
    arguments = _parser().parse_args(["run", *words] if short else words)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as the program's other commands: a batch system's end is a user's
    try:
        code: int = arguments.command(arguments)
        return code
    except StudyError as error:
        print(f"lfdsim: error: {error}", file=sys.stderr)
        return 1 if isinstance(error, StudyFailed) else 2
    except MemoryError:
        print("lfdsim: error: out of memory; take fewer rows, figures or workers", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("lfdsim: stopped; finished rows are kept, the same command continues", file=sys.stderr)
        return 130
    except BrokenPipeError:
        return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="lfdsim study",
        description="Measures many variants of a display.",
        epilog="lfdsim study FILE.toml -o FOLDER is short for lfdsim study run FILE.toml -o FOLDER",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    run = commands.add_parser("run", help="compute what is missing, write study.parquet and report.html; or one part of the chunks")
    run.add_argument("file", help="the study's FILE.toml; with --chunk, the planned FOLDER")
    run.add_argument("-o", "--output", metavar="FOLDER", help="of the study: made if missing, continued if it is there")
    run.add_argument("--dask", metavar="ADDRESS", help="of a Dask scheduler, as in tcp://HOST:8786; its workers compute")
    run.add_argument("--workers", type=_up_to(MOST_AT_ONCE), metavar="N", help="processes on this machine, up to 1024; default: one for each core")
    run.add_argument("--threads", type=_up_to(MOST_AT_ONCE), default=1, metavar="N", help="of each process; default: 1")
    run.add_argument(
        "--chunk", type=int, metavar="I", help="compute the I-th of N parts of the chunks, I from 0, here and now: for array jobs"
    )
    run.add_argument("--of", type=_up_to(MOST_ROWS), metavar="N", help="see --chunk")
    run.add_argument("--no-report", action="store_true", help="leave report.html out")
    run.set_defaults(command=_run)

    plan = commands.add_parser("plan", help="choose all rows, compute none: the first step of array jobs")
    plan.add_argument("file", help="the study's FILE.toml")
    plan.add_argument("-o", "--output", metavar="FOLDER", required=True)
    plan.set_defaults(command=_plan)

    for name, help_ in (
        ("collect", "the last step of array jobs: write study.parquet"),
        ("report", "write report.html of a finished study"),
    ):
        command = commands.add_parser(name, help=help_)
        command.add_argument("folder")
        command.set_defaults(command=_collect if name == "collect" else _report)
    tolerance = commands.add_parser(
        "tolerance", help="draw the errors that a display's [errors] states; percentiles and a budget of the errors"
    )
    tolerance.add_argument("display", help="DISPLAY.toml, with the sizes of its errors")
    tolerance.add_argument("-o", "--output", metavar="FOLDER", required=True)
    tolerance.add_argument("--draws", type=_up_to(MOST_ROWS), default=200, metavar="N", help="of all errors together; default: 200")
    tolerance.add_argument(
        "--alone",
        type=int,
        metavar="N",
        help="of each error by itself at half, once and twice its size; 0: no budget; default: three tenths of --draws",
    )
    tolerance.add_argument(
        "--measure",
        default=",".join(MEASURES),
        metavar="NAME,...",
        help=f"picture (its likeness to the scene), check, or measures of lfdsim analyze; default: {','.join(MEASURES)}",
    )
    tolerance.add_argument(
        "--loss",
        action="append",
        default=[],
        metavar="FIGURE=AMOUNT",
        help="what may be lost: with + it may only rise by as much, with - fall; without, either. May be repeated",
    )
    tolerance.add_argument("--percent", type=float, default=95.0, metavar="P", help="of displays that must keep within --loss; default: 95")
    tolerance.add_argument("--seed", type=int, default=0, help="of the draws")
    tolerance.add_argument(
        "--set",
        action="append",
        nargs="+",
        default=[],
        metavar="KEY=VALUE",
        help="another value of the description's key, as of the other commands; sizes of errors, too: errors.gap_mm=0.02",
    )
    tolerance.add_argument("--dask", metavar="ADDRESS", help="as of run")
    tolerance.add_argument("--workers", type=_up_to(MOST_AT_ONCE), metavar="N", help="as of run")
    tolerance.add_argument("--threads", type=_up_to(MOST_AT_ONCE), default=1, metavar="N", help="as of run")
    tolerance.set_defaults(command=_tolerance)
    return parser


def _up_to(most: int) -> Callable[[str], int]:
    def read(text: str) -> int:
        number = int(text) if text.isdecimal() and len(text) < 20 else 0
        if not 1 <= number <= most:
            raise argparse.ArgumentTypeError(f"is {text}; give a whole number from 1 to {most}")
        return number

    return read


def _run(a: argparse.Namespace) -> int:
    if (a.chunk is None) != (a.of is None):
        raise StudyError("--chunk and --of", "belong together; give both, as in --chunk 3 --of 100")
    if a.chunk is not None:
        if a.output or a.dask or a.workers:
            raise StudyError("--chunk", "computes in this process: -o, --dask and --workers have no meaning with it; leave them out")
        rows = api.run_part(a.file, a.chunk, a.of, a.threads)
        print(f"{a.file}: part {a.chunk} of {a.of}: {counted(rows, 'row')} finished")
        return 0
    if not a.output:
        raise StudyError("-o", "is missing; give the folder for the study")
    table = api.run(a.file, a.output, a.dask, workers=a.workers, threads=a.threads)
    _tell(a.output, table)
    if a.no_report:
        return 0
    from .planned import load
    from .reports import kept

    if kept.is_there(load(a.output)):
        print(f"{pathlib.Path(a.output) / kept.NAME}: the report")
        return 0
    return _report(argparse.Namespace(folder=a.output))


def _tell(folder: str, table: "pandas.DataFrame") -> None:
    reasons = table["error"].dropna()
    print(f"{pathlib.Path(folder) / 'study.parquet'}: {counted(len(table), 'row')}, {len(reasons)} of them impossible{most_often(reasons)}")


def _plan(a: argparse.Namespace) -> int:
    plan = api.plan(a.file, a.output)
    print(f"{plan.folder}: {counted(plan.rows, 'row')} in {counted(plan.chunks, 'chunk')} of {plan.rows_per_chunk}")
    return 0


def _collect(a: argparse.Namespace) -> int:
    table = api.collect(a.folder)
    _tell(a.folder, table)
    return 0


def _report(a: argparse.Namespace) -> int:
    print(f"{api.report(a.folder)}: the report")
    return 0


def _tolerance(a: argparse.Namespace) -> int:
    found = tolerance(
        a.display,
        a.output,
        a.draws,
        alone=a.alone,
        measures=tuple(a.measure.split(",")),
        losses=tuple(map(Loss.parse, a.loss)),
        percent=a.percent,
        seed=a.seed,
        set=dict(_override(text) for texts in a.set for text in texts),
        dask=a.dask,
        workers=a.workers,
        threads=a.threads,
    )
    from .reports import tolerance_page

    for line in tolerance_page.summary(found, a.percent):
        print(line)
    print(f"{tolerance_page.write(found, a.percent)}: the report, with all figures")
    return 0


def _override(text: str) -> tuple[str, object]:
    """KEY=VALUE, the value as a description has it; what is no value there is a word, as of the program's --set."""
    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise StudyError(f"--set {text}", "is not KEY=VALUE, as in errors.gap_mm=0.02")
    try:
        parsed = tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key.strip(), value
    each = parsed if isinstance(parsed, list) else [parsed]
    if any(isinstance(one, (datetime.date, datetime.time)) for one in each):  # a datetime is a date
        raise StudyError(f"--set {text}", 'has a date or a time, which no key takes; write a text in quotes: KEY="..."')
    return key.strip(), parsed
