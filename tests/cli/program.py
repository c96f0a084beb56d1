"""The program under test, in a folder of its own with a tiny display, a panel image and a model."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

# 11 x 6 plano-convex lenses on 88 x 48 panel pixels, seen from 0.4 m: a picture takes milliseconds.
TINY = """schema = 1
name = "tiny"
[panel]
pixels = [88, 48]
pixel_pitch_mm = 0.5
[lens]
type = "plano_convex"
sphere_radius_mm = 2.6
aperture_radius_mm = 1.9
cylinder_height_mm = 1.0
index = 1.4918
[array]
count = [11, 6]
pitch_mm = 4.0
gap_mm = 5.0
[diffuser]
distance_mm = 40.0
angle_deg = [4.0, 3.0]
[camera]
position_mm = [0.0, 0.0, 400.0]
frame_width_mm = 46.0
resolution = [96, 54]
[content]
depth_mm = 20.0
height_mm = 18.0
[render]
samples = 16
"""
# A square pyramid whose top looks at the viewer.
PYRAMID = """v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v 0.3 0.2 1
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
"""


class Program:
    """cwd is a fresh folder with tiny.toml, panel.png (a checkerboard) and pyramid.obj."""

    def __init__(self):
        self.path = os.path.abspath(sys.argv[1])
        self._folder = tempfile.TemporaryDirectory(prefix="lfdsim-cli-")
        self.folder = pathlib.Path(self._folder.name)
        (self.folder / "tiny.toml").write_text(TINY)
        (self.folder / "pyramid.obj").write_text(PYRAMID)
        self.must("eia tiny.toml --pattern checkerboard -o panel.png")

    def start(self, arguments, **options):
        arguments = arguments.split() if isinstance(arguments, str) else arguments
        return subprocess.Popen([self.path, *arguments], cwd=self.folder, text=True, stdin=subprocess.DEVNULL,
                                stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE, **options)

    def run(self, arguments, timeout=120, **options):
        """(exit code, standard output, standard error). A hang fails the test."""
        process = self.start(arguments, **options)
        try:
            out, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            raise AssertionError(f"lfdsim {arguments}: still running after {timeout} s")
        return process.returncode, out, err

    def must(self, arguments, **options):
        """Standard output of a run that has to succeed."""
        code, out, err = self.run(arguments, **options)
        assert code == 0, f"lfdsim {arguments}: exit code {code}, wanted 0\n{err}"
        return out

    def files(self):
        return {p.relative_to(self.folder): p.stat().st_mtime_ns for p in self.folder.rglob("*") if p.is_file()}


class Checks:
    """Counts what is wrong; leaves with exit code 1 if anything is."""

    def __init__(self):
        self.wrong, self.done, self.begun = 0, 0, time.monotonic()

    def that(self, condition, what):
        self.done += 1
        if not condition:
            self.wrong += 1
            print("WRONG:", what)

    def refused(self, program, name, arguments, *fragments, code=2, **options):
        """The run must end with the exit code, say the fragments, each in lines of our form, print no result and write nothing."""
        before = program.files()
        try:
            got, out, err = program.run(arguments, **options)
        except AssertionError as hang:
            return self.that(False, f"{name}: {hang}")
        self.that(got == code, f"{name}: exit code {got}, wanted {code}; it said: {err}")
        self.that(not out, f"{name}: printed {out!r}")
        errors = [line for line in err.splitlines() if line.startswith("lfdsim: error: ")]
        for fragment in fragments:
            self.that(any(fragment in line for line in errors), f"{name}: said {err!r}, wanted {fragment!r}")
        self.that(not re.search("Sanitizer|runtime error|terminate|Assertion", err), f"{name}: {err}")
        self.that(program.files() == before, f"{name}: left {set(program.files()) ^ set(before) or 'a changed file'}")

    def finish(self):
        print(f"{self.done} checks, {self.wrong} wrong, {time.monotonic() - self.begun:.1f} s")
        assert self.done > 0
        sys.exit(1 if self.wrong else 0)


def skip(why):
    print("SKIPPED:", why)
    sys.exit(77)
