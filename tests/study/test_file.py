"""What is wrong with a study's file is said with file, table, key and remedy."""

import unittest

from common import LHS, StudyTest

from lfdsim.study import StudyError, plan

GRID = """schema = 1
display = "display.toml"
design = "grid"
[[factor]]
key = "array.gap_mm"
values = [16.0, 16.5]
[[measure]]
name = "check"
"""

# (what is replaced in GRID, by what, what the message must say)
WRONG = [
    ("schema = 1", "schema = 2", ["schema", "is 2", "give 1"]),
    ("schema = 1", "schema = 1\nseeed = 3", ["seeed", "is not a key here", "seed"]),
    ('"grid"', '"gird"', ["design", "gird", "did you mean grid"]),
    ('"grid"', '"lhs"', ["rows", "is missing"]),
    ('"grid"', '"lhs"\nrows = 0', ["rows", "is 0", "from 1"]),
    ('"grid"', '"lhs"\nrows = 2.5', ["rows", "2.5", "whole number"]),
    ('"grid"', '"table"\ntable = "rows.csv"', ["[[factor]]", "no meaning"]),
    ('"grid"', '"grid"\nreplicates = 0', ["replicates", "is 0"]),
    ('"grid"', '"grid"\n[set]\ncamera.resolution = [48, 27]', ["[set] camera", "is a table", '"camera.resolution" = ']),
    ('"grid"', '"grid"\nrows_per_chunk = 0', ["rows_per_chunk", "is 0"]),
    ('"grid"', '"grid"\n[[factor]]\nkey = "array.gap_mm"\nvalues = [1]', ["array.gap_mm", "more than once"]),
    ('"grid"', '"grid"\nset = { "array.gap_mm" = 3 }', ["array.gap_mm", "more than once"]),
    ("values = [16.0, 16.5]", "values = []", ["[[factor]] 1 values", "not an empty one"]),
    ("values = [16.0, 16.5]", "value = [16.0]", ["[[factor]] 1", "no values", "give one of"]),
    ("values = [16.0, 16.5]", "values = [16.0]\nuniform = { from = 1, to = 2 }", ["values and uniform", "give one of"]),
    ("values = [16.0, 16.5]", "values = [16.0]\nsteps = 4", ["[[factor]] 1 steps", "is not a key here"]),
    ("values = [16.0, 16.5]", "from = 16\nto = 17\nsteps = 1", ["steps", "from 2"]),
    ("values = [16.0, 16.5]", "from = 16\nto = 16\nsteps = 3", ["[[factor]] 1 to", "is 16, as from is", "values = [16]"]),
    ("values = [16.0, 16.5]", 'from = 16\nto = "17"\nsteps = 2', ["to", "'17'", "a number"]),
    ("values = [16.0, 16.5]", "normal = { mean = 16, sd = 1 }", ["[[factor]] 1", "is a distribution", "lhs"]),
    ('key = "array.gap_mm"', 'keys = ["array.gap_mm", "array.pitch_mm"]', ["values", "lists of 2"]),
    ('key = "array.gap_mm"', 'key = "array.gap"', ["array.gap", "is not a key of the display"]),
    ('key = "array.gap_mm"', "key = 3", ["[[factor]] 1 key", "is 3", "a text"]),
    ("[[factor]]", "[factor]", ["factor", "write [[factor]]"]),
    ('[[measure]]\nname = "check"', "", ["[[measure]]", "is missing"]),
    ('name = "check"', 'name = "fow"', ["[[measure]] 1 name", "fow", "did you mean fov"]),
    ('name = "check"', 'name = "fov"\n[measure.settings]\nsise = [3, 4]', ["settings", "sise", "did you mean size"]),
    ('name = "check"', 'name = "check"\nlabel = "a/b"', ["a/b", "letters"]),
    ('name = "check"', 'name = "check"\n[[measure]]\nname = "check"', ['two are called "check"', "label"]),
    (
        'name = "check"',
        'name = "check"\n[[picture]]\nname = "front"\nsize = [0, 10]',
        ["[[picture]] 1 size", "[0, 10]", "columns and rows"],
    ),
    ('name = "check"', 'name = "fov"\n[measure.settings]\nsize = [0, 9]', ["[[measure]] 1 settings", "size: camera.resolution[0]: is 0"]),
    ('name = "check"', 'name = "fov"\n[measure.settings]\nmodel = "none.obj"', ["[[measure]] 1 settings", "none.obj: no such model"]),
    (
        'name = "check"',
        'name = "check"\n[[picture]]\nname = "front"\ncamera_mm = [0, 0, -5]',
        ["[[picture]] 1", "camera_mm", "behind the panel"],
    ),
    ('name = "check"', 'name = "check"\n[[picture]]\nname = "front"\ncompare = 1', ["[[picture]] 1 compare", "true or false"]),
    ('name = "check"', 'name = "check"\n[[limit]]\nfigure = "check.theory.fov_deg"', ["[[limit]] 1", "limits nothing"]),
    (
        'name = "check"',
        'name = "check"\n[[limit]]\nfigure = "check.theory.fov_deg"\nmin = 0.9\nmax = 0.7',
        ["[[limit]] 1 min", "is 0.9, above max, which is 0.7"],
    ),
    ('name = "check"', 'name = "check"\n[[limit]]\nfigure = "chek.fov"\nmin = 3', ["chek.fov", "did you mean check"]),
    ('name = "check"', 'name = "check"\n[[objective]]\nfigure = "check.x"\nbest = "higher"', ["best", "did you mean high"]),
    ('"display.toml"', '"other.toml"', ["display", "other.toml", "cannot be read"]),
    ('"display.toml"', '"study.toml"', ["study.toml", "is not a possible display"]),
    ("schema = 1", "schema = = 1", ["is not TOML", "line 1"]),
    ("schema = 1", "schema = 1\nset = 3", ["set", "is 3", "a table"]),
    ("16.5]", "1979-05-27]", ["factor 1 values 2", "is the date or time 1979-05-27"]),
    ("16.5]", "[" * 5000 + "]" * 5001, ["lists or tables are too deep"]),
    ("16.5]", "1" * 5000 + "]", ["is not TOML", "4300 digits"]),
    ('"display.toml"', '"a\\u0000b"', ["display", "null byte"]),
    ('"display.toml"', '"/dev/zero"', ["/dev/zero", "more than 16 MiB"]),
    ('"grid"', '"lhs"\nrows = 1_000_000_000_000', ["rows", "is 1000000000000", "from 1 to 10000000"]),
    (
        '"grid"',
        '"grid"\nreplicates = 1_000_000\n[[factor]]\nkey = "array.pitch_mm"\nfrom = 1\nto = 2\nsteps = 1_000_000',
        ["2000000000000 rows", "at most"],
    ),
    ('"grid"', '"saltelli"\nrows = 8_388_608', ["25165824 rows", "at most"]),
    ('"grid"', '"saltelli"\nrows = 12', ["rows", "is 12; give a power of 2"]),
    (
        '"grid"',
        '"grid"\nset = { "camera.position_mm.0" = 1 }\n[[factor]]\nkey = "camera.position_mm"\nvalues = [[0, 0, 9]]',
        ["all of camera.position_mm"],
    ),
    ('name = "check"', 'name = "check"\n[[picture]]\nname = "row"', ['"row"', "give another name"]),
    ('name = "check"', 'name = "check"\n[[picture]]\nname = "front"\nsize = [true, 10]', ["size", "True"]),
]


class BadFiles(StudyTest):
    def test_each_is_refused_with_its_place_and_a_remedy(self):
        for old, new, expected in WRONG:
            with self.subTest(new=new):
                self.assertIn(old, GRID)
                path = self.write(GRID.replace(old, new))
                with self.assertRaises(StudyError) as caught:
                    plan(path, self.folder / "out")
                for part in (*expected, ".toml"):
                    self.assertIn(part, str(caught.exception))
                self.assertFalse((self.folder / "out").exists())

    def test_distributions(self):
        for wrong, expected in (
            ("normal = { mean = 1, sd = 0 }", "above 0"),
            ("normal = { sd = 1, truncted = 2 }", "did you mean truncated"),
            ("uniform = { from = 2, to = 2 }", "above 2"),
            ("triangular = { from = 1, to = 3, mode = 4 }", "from 1 to 3"),
            ("integers = { from = 0, to = 2.5 }", "whole number"),
            ("uniform = 3", "give a table"),
        ):
            with self.subTest(wrong), self.assertRaisesRegex(StudyError, expected):
                plan(self.write(LHS.replace("ROWS", "8").replace("uniform = { from = 15.6, to = 15.8 }", wrong)), self.folder / "out")

    def test_tables_of_rows(self):
        for text, expected in (
            ("", "has no rows"),
            ("array.gap_mm\n", "has no rows"),
            ("array.gap_mm,array.gap_mm\n1,2\n", "rows.csv:1: names a key twice"),
            ("array.gap_mm\n1\n1,2\n", "rows.csv:3: has 2 cells"),
            ("array.gap\n1\n", "array.gap: is not a key"),
            ("array.gap_mm,replicate\n16,1\n", "rows.csv:1: replicate is what"),
            ("array.gap_mm\n" + "1" * 200_000 + "\n", "rows.csv: cannot be read"),
        ):
            with self.subTest(text):
                (self.folder / "rows.csv").write_text(text)
                with self.assertRaisesRegex(StudyError, expected):
                    plan(
                        self.write(
                            'schema = 1\ndisplay = "display.toml"\ndesign = "table"\ntable = "rows.csv"\n[[measure]]\nname = "check"\n'
                        ),
                        self.folder / "out",
                    )


    def test_a_table_that_is_no_file(self):
        """Reading it would not end."""
        with self.assertRaisesRegex(StudyError, "/dev/zero: is not a file"):
            plan(self.write('schema = 1\ndisplay = "display.toml"\ndesign = "table"\ntable = "/dev/zero"\n[[measure]]\nname = "check"\n'), "out")

    def test_a_table_of_a_spreadsheet(self):
        (self.folder / "rows.csv").write_text("\ufeffarray.gap_mm, lens.focal_length_mm\r\n16.4, 15.7\r\n")
        text = 'schema = 1\ndisplay = "display.toml"\ndesign = "table"\ntable = "rows.csv"\n[[measure]]\nname = "check"\n'
        self.assertEqual(plan(self.write(text), self.folder / "out").table().column_names, ["array.gap_mm", "lens.focal_length_mm"])

    def test_absurd_cells_are_texts(self):
        (self.folder / "rows.csv").write_text(f"array.gap_mm\n{'1' * 5000}\n{'[' * 100_000}\n")
        text = 'schema = 1\ndisplay = "display.toml"\ndesign = "table"\ntable = "rows.csv"\n[[measure]]\nname = "check"\n'
        self.assertEqual(plan(self.write(text), self.folder / "out").rows, 2)


if __name__ == "__main__":
    unittest.main()
