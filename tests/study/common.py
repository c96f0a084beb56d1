"""For the tests of studies: a display, files of studies, the command line, and folders that go away."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

DISPLAY = """
schema = 1
[panel]
pixels = [960, 540]
pixel_pitch_mm = 0.13636
[lens]
type = "ideal"
focal_length_mm = 15.7
[array]
pitch_mm = 12.0
gap_mm = 16.485
aperture = "cell"
[camera]
position_mm = [0.0, 0.0, 1000.0]
resolution = [96, 54]
[content]
viewing_distance_mm = 1000.0
"""

LHS = """
schema = 1
display = "display.toml"
design = "lhs"
rows = ROWS
seed = 5
rows_per_chunk = 3
[[factor]]
key = "array.gap_mm"
normal = { mean = 16.485, sd = 0.05 }
[[factor]]
key = "lens.focal_length_mm"
uniform = { from = 15.6, to = 15.8 }
[[measure]]
name = "check"
figures = ["theory.central_depth_mm", "theory.fov_exact_deg"]
"""


class StudyTest(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)
        (self.folder / "display.toml").write_text(DISPLAY)

    def write(self, text: str, name: str = "study.toml") -> pathlib.Path:
        (self.folder / name).write_text(text)
        return self.folder / name

    def lhs(self, rows: int) -> pathlib.Path:
        return self.write(LHS.replace("ROWS", str(rows)))


def skip_all(why: str) -> None:
    """Of a script, where the machine cannot do it."""
    print(f"SKIPPED: {why}")
    sys.exit(77)


def command(*words: object) -> list[str]:
    return [sys.executable, "-m", "lfdsim.study", *map(str, words)]


def call(*words: object, **more) -> subprocess.CompletedProcess:
    return subprocess.run(command(*words), capture_output=True, text=True, **more)


def start(*words: object) -> subprocess.Popen:
    return subprocess.Popen(command(*words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def children(pid: int) -> list[int]:
    """Processes that a process has started, by the kernel's own list."""
    try:
        threads = os.listdir(f"/proc/{pid}/task")
        return [int(c) for t in threads for c in pathlib.Path(f"/proc/{pid}/task/{t}/children").read_text().split()]
    except FileNotFoundError:
        return []


def alive(pid: int) -> bool:
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False
