"""Rows that would change nothing, or fail one and all, are refused before they are planned."""

import os
import pathlib
import unittest
import warnings

from common import StudyTest, call

import lfdsim
from lfdsim.study import StudyError, plan

GRID = 'schema = 1\ndisplay = "display.toml"\ndesign = "grid"\n'
CAMERA = '[[factor]]\nkey = "camera.position_mm.2"\nvalues = [900, 1000]\n'
SIZE = '[[factor]]\nkey = "camera.resolution"\nvalues = [[96, 54], [48, 27]]\n'
MODEL = '[[factor]]\nkey = "content.object.0.tilt_deg"\nvalues = [0, 10]\n'
FRONT = '[[picture]]\nname = "front"\n'
FOV = '[[measure]]\nname = "fov"\n[measure.settings]\n'
CHECK = '[[measure]]\nname = "check"\n'


class Effects(StudyTest):
    def planned(self, text: str, name: str = "out"):
        return plan(self.write(GRID + text), self.folder / name)

    def test_a_key_that_changes_nothing_is_refused(self):
        for text, key, said in (
            (CAMERA + FRONT + "camera_mm = [0, 0, 600]\n", "camera.position_mm.2", r"camera_mm of \[\[picture\]\] front overrides it"),
            (SIZE + FRONT + "size = [48, 27]\n", "camera.resolution", "size of .* overrides it"),
            (SIZE + FOV + "size = [48, 27]\n" + FRONT + "size = [8, 4]\n", "camera.resolution", "fov, size of .* front override it"),
            (MODEL + FOV + 'model = "built-in:spheres"\n', "content.object.0.tilt_deg", "model of .* overrides it; leave out one or the other"),
            ("replicates = 2\n" + CAMERA + FOV + "seed = 3\n", "render.seed", "seed of .* overrides it; leave that out, or give other replicate_keys"),
        ):
            with self.subTest(key), self.assertRaisesRegex(StudyError, f"study.toml: {key}: changes nothing: .*{said}"):
                self.planned(text)
            self.assertFalse((self.folder / "out").exists())

    def test_a_column_of_a_table_too(self):
        (self.folder / "rows.csv").write_text("camera.position_mm.2\n900\n")
        text = GRID.replace('"grid"', '"table"\ntable = "rows.csv"') + FRONT + "camera_mm = [0, 0, 600]\n"
        with self.assertRaisesRegex(StudyError, "rows.csv: camera.position_mm.2: changes nothing"):
            plan(self.write(text), self.folder / "out")

    def test_columns_that_change_the_same_value(self):
        text = GRID.replace('"grid"', '"table"\ntable = "rows.csv"') + CHECK
        (self.folder / "rows.csv").write_text('camera.position_mm.0,camera.position_mm\n50,"[0, 0, 900]"\n')
        with self.assertRaisesRegex(StudyError, "rows.csv: camera.position_mm.0 and all of camera.position_mm are given"):
            plan(self.write(text), self.folder / "out")

    def test_components_that_are_not_there(self):
        for key, said in (("array.offset_mm.2", "array.offset_mm has 2 components"), ("array.gap_mm.0", "array.gap_mm is not a vector")):
            with self.subTest(key), self.assertRaisesRegex(StudyError, f"{key}: names no component: {said}"):
                self.planned(f'[[factor]]\nkey = "{key}"\nvalues = [0, 1]\n' + CHECK)

    def test_replicates_vary_the_errors_wherever_they_come_from(self):
        for number, (fixed, keys) in enumerate((
            ("", ["render.seed"]),
            ('[set]\n"errors.decenter_sd_mm" = 0.05\n', ["errors.seed", "render.seed"]),
            ('[set]\n"errors.decenter_sd_mm" = 0.05\n"errors.seed" = 3\n', ["render.seed"]),
        )):
            made = self.planned("replicates = 2\n" + fixed + CAMERA + CHECK, f"out{number}")
            self.assertEqual(made.table().column_names, ["replicate", "camera.position_mm.2", *keys])

    def test_models_lie_beside_the_display_wherever_it_is_planned(self):
        here = pathlib.Path.cwd()
        self.addCleanup(os.chdir, here)
        (self.folder / "elsewhere").mkdir()
        (self.folder / "elsewhere" / "m.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n")
        os.chdir(self.folder / "elsewhere")
        with self.assertRaisesRegex(StudyError, "m.obj: no such model file"):
            self.planned(CAMERA + FRONT + 'model = "m.obj"\n')

    def test_a_key_that_changes_a_part_is_warned_of(self):
        text = CAMERA + CHECK + FRONT + "camera_mm = [0, 0, 600]\n"
        with self.assertWarnsRegex(lfdsim.LfdsimWarning, "camera.position_mm.2 changes only a part of the figures: camera_mm of") as caught:
            self.planned(text)
        self.assertEqual(caught.filename, __file__)
        done = call("plan", self.folder / "study.toml", "-o", self.folder / "other")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, "^lfdsim: warning: .*study.toml: camera.position_mm.2 changes only a part")

    def test_a_key_of_set_that_changes_nothing_is_warned_of(self):
        fixed = '[set]\n"camera.resolution" = [9, 6]\n'
        with self.assertWarnsRegex(lfdsim.LfdsimWarning, r"\[set\] camera.resolution changes nothing: size of \[\[picture\]\] front overrides it"):
            self.planned(fixed + CAMERA + FRONT + "size = [8, 4]\n")

    def test_what_acts_everywhere_is_not_warned_of(self):
        samples = '[[factor]]\nkey = "render.samples"\nvalues = [1, 4]\n'
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for number, text in enumerate((
                CAMERA + CHECK + FRONT,
                CAMERA + FRONT + "size = [8, 4]\n",
                '[set]\n"camera.resolution" = [9, 6]\n' + CAMERA + CHECK + FRONT + "size = [8, 4]\n",
                samples + FRONT + "samples = 4\ncompare = true\n",  # the scene has those of the display
            )):
                self.planned(text, f"out{number}")


class WholeNumbers(StudyTest):
    def test_fractions_are_refused_with_what_is_whole(self):
        for factor, design, said in (
            ('key = "panel.pixels.0"\nfrom = 300\nto = 385\nsteps = 4', "grid", "328.333 is none; all are whole with steps = 6"),
            ('key = "panel.pixels.0"\nfrom = 300\nto = 385\nsteps = 5', "grid", "321.25 is none; all are whole with steps = 6"),
            ('key = "panel.pixels.0"\nfrom = 300.5\nto = 302\nsteps = 4', "grid", "300.5 is none; give from and to that are whole"),
            ('key = "render.samples"\nvalues = [1, 2.5]', "grid", "2.5 is none; give whole ones"),
            ('key = "content.inverse.rays"\nvalues = [4, 4.5]', "grid", "4.5 is none; give whole ones"),  # which the display does not state
            ('key = "render.seed"\nuniform = { from = 1, to = 9 }', "lhs\"\nrows = 4 #", "is none; give integers = { from, to }, or values"),
        ):
            text = GRID.replace('"grid"', f'"{design}"') + f"[[factor]]\n{factor}\n" + CHECK
            with self.subTest(factor), self.assertRaisesRegex(StudyError, f"takes whole numbers, and .*{said}"):
                plan(self.write(text), self.folder / "out")

    def test_whole_numbers_stay_whole(self):
        for number, factor in enumerate((
            'key = "panel.pixels.0"\nfrom = 300.0\nto = 400.0\nsteps = 3',
            'keys = ["panel.pixels.0", "array.gap_mm"]\ntimes = [100, 5.5]\nfrom = 3.0\nto = 4.0\nsteps = 2',
            'key = "panel.pixels.0"\nvalues = [300, 400.0]',
        )):
            made = plan(self.write(GRID + f"[[factor]]\n{factor}\n" + CHECK), self.folder / f"out{number}")
            values = made.values_of(0)["panel.pixels.0"]
            self.assertTrue(all(type(v) is int for v in values) and values[0] == 300, values)
        gap = '[[factor]]\nkey = "array.gap_mm"\nfrom = 16\nto = 17\nsteps = 3\n'
        self.assertEqual(plan(self.write(GRID + gap + CHECK), self.folder / "gap").table()["array.gap_mm"].to_pylist(), [16, 16.5, 17])


if __name__ == "__main__":
    unittest.main()
