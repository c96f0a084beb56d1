#!/usr/bin/python3
"""Whether the advice of `check` can be followed, and ends: of displays drawn at random, the first advice with an option is followed until none is left.

Usage: advice.py LFDSIM_PROGRAM [--first N] [--displays N]
Each step must give a valid display, and no advice may come a second time.
"""
import argparse
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import displays
import oracle

MOST_STEPS = 8


def options_of(advice):
    """The KEY=VALUE of the first command in brackets, or none."""
    command = re.search(r"\((--set (?:'[^']*'|[^')])*)\)", advice)
    return [word for word in shlex.split(command[1]) if "=" in word] if command else []


def check(program, path, options):
    """(warnings, error): what `check` says with these options."""
    run = subprocess.run([program, "check", path, "--json", *(["--set", *options] if options else [])], capture_output=True, text=True, check=False)
    return (json.loads(run.stdout)["warnings"], "") if run.returncode == 0 else ([], run.stderr.strip())


def followed(program, path):
    """The advice that is followed, in order, and what is wrong with it, or an empty text."""
    told, options = [], []
    for _ in range(MOST_STEPS):
        warnings, error = check(program, path, options)
        if error:
            return told, f"cannot be followed: {error}" if told else ""  # not all that is drawn can be built
        advice = next((warning for warning in warnings if options_of(warning)), None)
        if advice is None:
            return told, ""
        if advice in told:
            return told, "goes round in a circle"
        told.append(advice)
        given = options_of(advice)
        options = [old for old in options if old.split("=")[0] not in {new.split("=")[0] for new in given}] + given
    return told, f"does not end after {MOST_STEPS} steps"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--displays", type=int, default=40)
    args = parser.parse_args()
    steps = wrong = 0
    with tempfile.TemporaryDirectory(prefix="lfdsim-advice-") as folder:
        for number in range(args.first, args.first + args.displays):
            path = pathlib.Path(folder) / f"{number}.toml"
            path.write_text(oracle.to_toml(displays.draw(number, 4e5)))
            told, fault = followed(args.program, path)
            steps += len(told)
            if fault:
                wrong += 1
                print(f"WRONG: display {number}: the advice {fault}", *told, sep="\n  ")
    print(f"{args.displays} displays, {steps} times advice, {wrong} wrong")
    return 1 if wrong or not steps else 0


if __name__ == "__main__":
    sys.exit(main())
