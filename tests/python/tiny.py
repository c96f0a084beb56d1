"""The tiny display of the program's tests, for those of the Python package. LFDSIM_PROGRAM is the program lfdsim."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from typing import Any

import lfdsim

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from program import PYRAMID, TINY  # noqa: E402

PROGRAM = os.path.abspath(os.environ["LFDSIM_PROGRAM"])


class TinyTest(unittest.TestCase):
    """Runs in a folder of its own with tiny.toml and pyramid.obj; `display` is that of tiny.toml."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="lfdsim-python-")
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        pathlib.Path("tiny.toml").write_text(TINY)
        pathlib.Path("pyramid.obj").write_text(PYRAMID)
        self.display = lfdsim.Display.load("tiny.toml")

    def program(self, *arguments: str) -> str:
        """Standard output of the program."""
        return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout

    def program_json(self, *arguments: str) -> Any:
        return json.loads(self.program(*arguments, "--json"))
