#!/usr/bin/python3
"""Measures displays drawn at random with lfdsim, and holds every figure against an independent form: run.py LFDSIM_PROGRAM [--displays N] [--only TEXT].

The forms are rays of tests/oracle's tracer and equations of docs/model.md; none shares a line with src/. Prints a table with a row for each measure; the exit
code is 1 if fewer than 95 % of its figures lie within their own stated error, if more than 10 % are null where the form is defined, if the median stated error
is above 2 % (0.1 degrees for the field of view), or if a null has no reason.
"""
import argparse
import json
import multiprocessing
import pathlib
import subprocess
import sys
import tempfile

import contents
import displays
import oracle
import table
from forms import Forms

MEASURES = ("fov", "dof", "zone", "uniformity")
TRIES = 20  # drawings for one display, where `check` refuses some


class Harness:
    def __init__(self, program, folder, most_pixels, keep):
        self.program, self.folder, self.most_pixels, self.keep = program, pathlib.Path(folder), most_pixels, keep

    def lfdsim(self, *arguments):
        return subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, timeout=600, cwd=self.folder)

    def drawn(self, number):
        """The first drawing of this number that check accepts: (description, its file, check's result, drawings refused)."""
        for refused in range(TRIES):
            description = displays.draw(number + 1000 * refused, self.most_pixels)
            path = self.folder / f"{number}.toml"
            path.write_text(oracle.to_toml(description))
            done = self.lfdsim("check", path, "--json")
            if done.returncode == 0:
                return description, path, json.loads(done.stdout), refused
            if done.returncode != 2:
                raise RuntimeError(f"lfdsim check {path}: {done.stderr}")
        raise RuntimeError(f"display {number}: {TRIES} drawings refused, the last: {done.stderr}")

    def measured(self, path, measure, forms):
        reach = round(1.5 * forms.hint, 2)
        views = ["--angles-deg", f"{-reach},{reach},{reach / 6}"] if measure == "fov" else []
        done = self.lfdsim("analyze", measure, path, *views, "--threads", 1, "--progress", "none", "--json", "-o", self.folder / f"{path.stem}-{measure}")
        if done.returncode:
            raise RuntimeError(f"lfdsim analyze {measure} {path}: {done.stderr}")
        return json.loads(done.stdout)


def look_up(result, path):
    """What stands at a path such as horizontal.own_lens_deg; KeyError if nothing does."""
    for name in path.split("."):
        result = result[name]
    return result


def number(value):
    return 0.0 if value == "infinite" else value


def cases_of(measure, display, result, forms):
    for path, form in forms.items():
        label = f"{measure} {path.removeprefix('horizontal.').removeprefix('vertical.').removeprefix('theory.')}"
        several = isinstance(form, list)
        try:
            values = look_up(result, path)
        except KeyError:
            yield table.Case(label, display, form[0] if several else form, None, absent=True)
            continue
        try:
            errors = look_up(result, path + "_error")
        except KeyError:
            errors = [0.0, 0.0] if several else 0.0
        forms_here, values, errors = (form, values or [None, None], errors or [0.0, 0.0]) if several else ([form], [values], [errors])
        if measure == "check" and path.endswith("_mm") and "depth" in path:  # told in mm, compared in dioptres: infinitely far is 0
            values = [v and (0.0 if v == "infinite" else 1000 / v) for v in values]
        scale = max((abs(f[0]) for f in forms_here if isinstance(f, tuple)), default=1.0)
        noted = any(path.startswith(key) or key.startswith(path) for key in result.get("notes", {}))
        for f, value, error in zip(forms_here, values, errors):
            yield table.Case(label, display, f, value, error or 0.0, scale, noted)


def display_cases(harness, index, only):
    """All cases of display `index`, and how many drawings were refused."""
    description, path, checked, refused = harness.drawn(index)
    forms = Forms(oracle.resolve(description), description, index)
    found = list(cases_of("check", index, checked, forms.check())) if only in "check" else []
    for measure in MEASURES:
        if only in measure:
            found += cases_of(measure, index, harness.measured(path, measure, forms), getattr(forms, measure)())
    return found, refused


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--displays", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="number of the first display")
    parser.add_argument("--most-pixels", type=float, default=4e6, help="of a panel")
    parser.add_argument("--only", default="", help="measures whose names contain this")
    parser.add_argument("--wrong", action="store_true", help="print every figure that does not agree")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for descriptions and results")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="lfdsim-property-") as folder:
        folder = options.keep or pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        contents.write(folder)
        harness = Harness(options.program.resolve(), folder.resolve(), options.most_pixels, options.keep)
        with multiprocessing.Pool() as pool:
            parts = pool.starmap(display_cases, [(harness, k, options.only) for k in range(options.first, options.first + options.displays)], chunksize=1)
    found = table.rows([case for cases, _ in parts for case in cases])
    if options.wrong:
        for row in found:
            for case in row.wrong + [c for c in row.cases if c.null]:
                print(f"{row.measure}: display {case.display}: measured {case.measured} +- {case.error}, form {case.form}")
    print(f"{options.displays} displays; {sum(refused for _, refused in parts)} drawings refused by check")
    print(table.text(found))
    faults = [row for row in found if row.faults]
    print(f"{len(found) - len(faults)} measures hold, {len(faults)} do not")
    sys.exit(1 if faults or not found else 0)


if __name__ == "__main__":
    main()
