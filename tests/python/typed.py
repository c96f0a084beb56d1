"""mypy finds nothing to complain of in the package, and users get the types that it states."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import lfdsim

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
PACKAGES = pathlib.Path(lfdsim.__file__).parent.parent
USE = """
from typing import Any, assert_type

import numpy as np
import pandas
from numpy.typing import NDArray

import lfdsim
import lfdsim.study

d = lfdsim.Display.load("tablet.toml").with_({"array.gap_mm": 3.3})
view = lfdsim.render(d, camera_mm=(40, 0, 599), size=(640, 360))
assert_type(view, NDArray[np.float32])
assert_type(lfdsim.compare(view, view)["ssim"], float)
assert_type(lfdsim.panel_codes(d, view), NDArray[np.uint8])
assert_type(lfdsim.check(d), dict[str, Any])
assert_type(lfdsim.analyze(d, "fov").plots, dict[str, str])
assert_type([problem.remedy for problem in lfdsim.DisplayError([]).problems], list[str])
assert_type(lfdsim.study.run("study.toml", "folder"), pandas.DataFrame)
assert_type(lfdsim.study.tolerance("display.toml", "folder", losses=(lfdsim.study.Loss.parse("fov=1"),)).budget, pandas.DataFrame)
"""
WRONG = """
import lfdsim
d = lfdsim.Display.load("tablet.toml")
lfdsim.render(d, size="large")
lfdsim.analyse(d, "fov")
"""


def mypy(*words: str) -> tuple[int, str]:
    configuration = ["--config-file", str(REPOSITORY / "pyproject.toml"), "--cache-dir", str(PACKAGES.parent / "mypy")]
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *configuration, *words], capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(PACKAGES)}
    )
    return done.returncode, done.stdout + done.stderr


def mypy_of(text: str) -> tuple[int, str]:
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "use.py")
        script.write_text(text)
        return mypy(str(script))


class Types(unittest.TestCase):
    def test_the_package(self) -> None:
        code, said = mypy("-p", "lfdsim")
        self.assertEqual(code, 0, said)

    def test_its_users(self) -> None:
        code, said = mypy_of(USE)
        self.assertEqual(code, 0, said)

    def test_wrong_use_is_told(self) -> None:
        code, said = mypy_of(WRONG)
        self.assertEqual(code, 1, said)
        self.assertIn('"size"', said)
        self.assertIn('"analyse"', said)


if __name__ == "__main__":
    if not importlib.util.find_spec("mypy"):
        print("mypy is not installed")
        sys.exit(77)
    unittest.main()
