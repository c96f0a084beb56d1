#!/usr/bin/python3
"""Measures displays drawn at random with lfdsim, and holds every figure against an independent form: run.py LFDSIM_PROGRAM [--displays N] [--only TEXT].

The forms are rays of tests/oracle's tracer and equations of docs/model.md; none shares a line with src/. Prints a table with a row for each measure; the exit
code is 1 if fewer than 95 % of its figures lie within their own stated error, if more than 10 % are null where the form is defined, if the median stated error
of five and more is above 2 % (0.1 degrees for the field of view), or if a null has no reason.
"""
import argparse
import functools
import json
import multiprocessing
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

import contents
import displays
import oracle
import table
from forms import Forms

# One display of as many has the measure. "likeness" is `analyze fov` with all its views. --quick: by turns, and pictures are small.
USUALLY = {"likeness": 3}
EVERY = {"fov": 2, "likeness": 15, "dof": 5, "zone": 10, "crosstalk": 9, "uniformity": 9, "spot": 5, "mtf": 20, "moire": 9}
NO_FIGURE = re.compile(r"[ (-]nan\b|(?<!=)[ (-]inf\b|\de[+-]?\d")  # in what check tells in words; "= inf" is the value of a key
POINTS = "--estimator", "point", "--samples", 256  # default pictures, of which some take 64 times as long, are looked at by pictures.py
TRIES = 20  # drawings for one display, where `check` refuses some


class Harness:
    def __init__(self, program, folder, quick, most_pixels):
        self.program, self.folder, self.quick = program, folder, quick
        self.most_pixels = most_pixels  # of a panel

    def lfdsim(self, *arguments):
        return subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, timeout=3600, cwd=self.folder)

    def drawn(self, number, change=None):
        """The first drawing of this number, changed by change(number, description), that check accepts: (description, its file, check's result, drawings refused)."""
        for refused in range(TRIES):
            description = displays.draw(number + 1000 * refused, self.most_pixels)
            if self.quick:
                description["camera"]["resolution"] = [160, 90]
            if change:
                change(number + 1000 * refused, description)
            path = self.folder / f"{number}.toml"
            path.write_text(oracle.to_toml(description))
            done = self.lfdsim("check", path, "--json")
            if done.returncode == 0:
                checked = json.loads(done.stdout)
                absurd = [w for w in checked["warnings"] if NO_FIGURE.search(w)]
                if absurd:
                    raise RuntimeError(f"lfdsim check {path} says {absurd}")
                return description, path, checked, refused
            if done.returncode != 2:
                raise RuntimeError(f"lfdsim check {path}: {done.stderr}")
        raise RuntimeError(f"display {number}: {TRIES} drawings refused, the last: {done.stderr}")

    def measured(self, path, command, options):
        done = self.lfdsim("analyze", command, path, *options, *POINTS, "--threads", 1, "--progress", "none", "--json", "-o", f"{path.stem}-{command}")
        if done.returncode:
            raise RuntimeError(f"lfdsim analyze {command} {path}: {done.stderr}")
        return json.loads(done.stdout)

    def takes(self, index, measure):
        every = EVERY[measure] if self.quick else USUALLY.get(measure, 1)
        return (index + list(EVERY).index(measure)) % every == 0


def few_pictures(measure, forms):
    """Options that keep views and depths few."""
    if measure == "fov":
        reach = 1.5 * max(forms.hint)
        return "--angles-deg", f"{-reach},{reach},{reach / 6}"
    if measure == "dof":
        return "--depths-mm", f"{0.1 * forms.eye},{0.5 * forms.eye},{0.1 * forms.eye}"
    if measure == "mtf":
        z = min(abs(forms.central_depth), 0.2 * forms.eye)
        return "--depths-mm", f"{0.7 * z},{z},{0.3 * z}"
    return ()


def look_up(result, path):
    """What stands at a path such as spots.2.depth_mm; KeyError if nothing does."""
    for name in path.split("."):
        result = result[int(name) if isinstance(result, list) else name]
    return result


def label(measure, path):
    path = path.replace("_y_", "_").removesuffix("_y")  # along the array's own y: a figure of the same kind
    left_out = ("horizontal", "vertical", "theory", "green")
    names = [p for p in path.replace("horizontal_delta", "angle_delta").replace("vertical_delta", "angle_delta").split(".") if not p.isdigit()]
    alike = {"r": "rgb", "g": "rgb", "b": "rgb", "red": "red_blue", "blue": "red_blue", "red_mm": "red_blue_mm", "blue_mm": "red_blue_mm"}
    return measure + " " + ".".join(alike.get(p, p) for p in names if p not in left_out)


def error_at(result, path):
    """The stated error of a figure, as an object of colours has it; None where there is none."""
    before, _, colour = path.rpartition(".")
    for name in (path + "_error", f"{before}_error.{colour}"):
        try:
            return look_up(result, name)
        except (KeyError, ValueError):  # ValueError: the row of a list
            pass
    return None


def cases_of(measure, display, result, forms):
    for path, form in forms.items():
        name, several = label(measure, path), isinstance(form, list)
        here = form if several else [form]
        try:
            values, errors = look_up(result, path), error_at(result, path)
        except KeyError:
            yield table.Case(name, display, here[0], None, absent=True)
            continue
        if not several:
            values, errors = [values], [errors]
        values, errors = values or [None] * len(here), errors or [0.0] * len(here)
        if measure == "check" and "depth" in path and path.endswith("_mm"):  # told in mm, compared in dioptres: infinitely far is 0
            values = [0.0 if v == "infinite" else v and 1000 / v for v in values]
        scale = max((abs(f[-1] if len(f) == 3 else f[0]) for f in here if isinstance(f, tuple)), default=1.0) or 1.0
        noted = any(path.startswith(key) or key.startswith(path) for key in result.get("notes", {}))
        for f, value, error in zip(here, values, errors):
            yield table.Case(name, display, f, value, error or 0.0, scale, noted)


def display_cases(harness, only, errors, index):
    """All cases of display `index`, how many drawings were refused, and what the program failed at."""
    description, path, checked, refused = harness.drawn(index, displays.misassemble if errors else None)
    forms = Forms(oracle.resolve(description), description, index)
    found, failed = list(cases_of("check", index, checked, forms.check(checked))) if only in "check" else [], []
    measures = [measure for measure in EVERY if only in measure and harness.takes(index, measure) and forms.takes(measure)]

    @functools.cache
    def measured(command):
        return harness.measured(path, command, () if command == "fov" and "likeness" in measures else few_pictures(command, forms))

    for measure in measures:
        try:
            result = measured(measure.replace("likeness", "fov"))
        except (RuntimeError, subprocess.TimeoutExpired) as failure:
            failed.append(str(failure))
            continue
        found += cases_of(measure, index, result, getattr(forms, measure)(result))
    return found, refused, failed


def stop(*_):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # timeout(1) sends it twice
    raise KeyboardInterrupt


def begin_worker():
    """Leaves signals to the parent, which ends its workers itself; one that ends takes the program that it waits for along."""
    os.setpgrp()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())


def measured(harness, options):
    """Cases, refusals and failures of each display; where a signal ends the run, of those that are done."""
    parts = []
    with multiprocessing.Pool(initializer=begin_worker) as pool:
        signal.signal(signal.SIGTERM, stop)  # after the workers' start: they end at once
        try:
            for part in pool.imap(functools.partial(display_cases, harness, options.only, options.errors), range(options.first, options.first + options.displays)):
                parts.append(part)
        except KeyboardInterrupt:
            pool.terminate()
    return parts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--displays", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="number of the first display")
    parser.add_argument("--quick", action="store_true", help="small pictures, and the measures by turns: each display has a few of them")
    parser.add_argument("--panel-pixels", type=float, default=4e5, help="most pixels of a panel")
    parser.add_argument("--only", default="", help="measures whose names contain this")
    parser.add_argument("--errors", action="store_true", help="displays with errors of assembly: fov, zone, crosstalk and luminance")
    parser.add_argument("--wrong", action="store_true", help="print every figure that does not agree")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for descriptions and results")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="lfdsim-property-") as folder:
        folder = options.keep or pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        contents.write(folder)
        harness = Harness(options.program.resolve(), folder.resolve(), options.quick, options.panel_pixels)
        parts = measured(harness, options)
    found = table.rows([case for cases, _, _ in parts for case in cases])
    if options.wrong:
        for row in found:
            for case in row.wrong + [c for c in row.cases if c.null]:
                print(f"{row.measure}: display {case.display}: measured {case.measured} +- {case.error}, form {case.form}")
    failed = [message for _, _, failures in parts for message in failures]
    if len(parts) < options.displays:
        failed.append(f"stopped after {len(parts)} displays")
    print(*failed, sep="\n")
    print(f"{len(parts)} displays; {sum(refused for _, refused, _ in parts)} drawings refused by check; {len(failed)} measures failed\n")
    print(table.text(found))
    faults = [row for row in found if row.faults]
    print(f"\n{len(found) - len(faults)} figures hold, {len(faults)} do not")
    sys.exit(1 if faults or failed or not found else 0)


if __name__ == "__main__":
    main()
