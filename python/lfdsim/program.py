"""The command `lfdsim` of an installed package: the program that lies in it."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def path() -> Path:
    """The path of the program `lfdsim`: in the package, or, in a build of the repository, two folders above."""
    here = Path(__file__).absolute().parent
    for place in (here / "bin" / "lfdsim", here.parent.parent / "lfdsim"):
        if place.is_file():
            return place
    raise FileNotFoundError(f"the program lfdsim is not in {here / 'bin'}; install the package again")


def main() -> None:
    if sys.argv[1:2] in (["study"], ["tolerance"]):  # commands in Python
        from lfdsim.study import __main__ as study

        arguments = sys.argv[2:] if sys.argv[1] == "study" else sys.argv[1:]
        sys.exit(study.main(arguments))
    program = str(path())
    os.execv(program, ["lfdsim", *sys.argv[1:]])
