"""lfdsim.analyze: results equal the program's, in figures, tables, files."""

import json
import math
import os
import pathlib
import pickle
import unittest
from unittest import mock

import numpy as np

import lfdsim
from tiny import TinyTest

LONG = ("directions", "fov", "zone", "mtf")  # seconds each


class Results(TinyTest):
    def test_every_measure_is_that_of_the_program(self) -> None:
        wanted = [m for m in lfdsim.measures() if "LFDSIM_FULL" in os.environ or m.name not in LONG]
        self.program("analyze", ",".join(m.name for m in wanted), "tiny.toml", "-o", "theirs", "--size", "96x54")
        for measure in wanted:
            with self.subTest(measure.name):
                result = lfdsim.analyze(self.display, measure.name, size=(96, 54))
                result.save("ours")
                theirs, ours = (json.loads(pathlib.Path(folder, measure.name + ".json").read_text()) for folder in ("theirs", "ours"))
                for each in theirs, ours:
                    each["report"].pop("seconds")
                self.assertEqual(ours, theirs)
                self.assertEqual(result.notes, theirs["notes"])
                for file in theirs["report"]["files"]:
                    self.assertEqual(pathlib.Path("ours", file).read_bytes(), pathlib.Path("theirs", file).read_bytes(), file)
                self.assertTrue(repr(result).startswith("lfdsim.Result"))
                self.assertIn("<table>", result._repr_html_())
                self.assertEqual({f"{name}.svg" for name in result.plots}, {f for f in theirs["report"]["files"] if f.endswith(".svg")})

    def test_what_was_pickled_has_all_but_files(self) -> None:
        for measure in "spot", "components":
            result = lfdsim.analyze(self.display, measure, size=(96, 54))
            held = pickle.loads(pickle.dumps(result))
            for name in "measure", "figures", "notes", "findings", "remarks", "plots", "seconds":
                self.assertEqual(getattr(held, name), getattr(result, name), name)
            self.assertEqual((repr(held), held._repr_html_()), (repr(result), result._repr_html_()))
            for name, (caption, picture) in result.pictures.items():
                self.assertEqual(held.pictures[name][0], caption)
                np.testing.assert_array_equal(held.pictures[name][1], picture)
            self.assertEqual({name: list(table) for name, table in held.tables.items()}, {name: list(table) for name, table in result.tables.items()})
            with self.assertRaisesRegex(lfdsim.InputError, "save: this result was pickled; save it where it is measured"):
                held.save("ours")

    def test_options_reach_the_measure(self) -> None:
        self.program(
            "analyze", "fov", "tiny.toml", "-o", "theirs", "--angles-deg", "-30,30,5", "--viewing-distance-mm", "500", "--pickup", "traced"
        )
        result = lfdsim.analyze(self.display, "fov", angles_deg=np.arange(-30, 31, 5), viewing_distance_mm=500, pickup="traced")
        result.save("theirs")  # which refuses results of other settings
        with self.assertRaisesRegex(lfdsim.InputError, "theirs: contains results of other settings: fov"):
            lfdsim.analyze(self.display, "spot", eye_distance_mm=60).save("theirs")
        with self.assertRaisesRegex(TypeError, "replace is a str; give True or False"):
            result.save("theirs", replace="no")
        lfdsim.analyze(self.display, "spot", eye_distance_mm=60).save("theirs", replace=True)
        self.assertEqual([p.stem for p in pathlib.Path("theirs").glob("*.json")], ["spot"])

    def test_tables_with_and_without_pandas(self) -> None:
        with mock.patch.dict("sys.modules", pandas=None):
            arrays = lfdsim.analyze(self.display, "spot").tables
        self.assertTrue(all(isinstance(column, np.ndarray) for table in arrays.values() for column in table.values()))
        try:
            import pandas
        except ImportError:
            return
        frames = lfdsim.analyze(self.display, "spot").tables
        for name, table in frames.items():
            self.assertIsInstance(table, pandas.DataFrame)
            np.testing.assert_array_equal(table.to_numpy(), np.column_stack(list(arrays[name].values())))

    def test_infinite_figures_are_numbers(self) -> None:
        result = lfdsim.analyze(self.display.with_({"array.gap_mm": self.at_focus()}), "dof", size=(48, 27), depths_mm=[10, 20, 30])
        self.assertIn(math.inf, list(self.numbers(result.figures)))

    def at_focus(self) -> float:
        return lfdsim.check(self.display)["theory"]["focal_length_mm"]

    def numbers(self, figures: object) -> list[object]:
        if isinstance(figures, dict):
            return [number for each in figures.values() for number in self.numbers(each)]
        return [number for each in figures for number in self.numbers(each)] if isinstance(figures, list) else [figures]

    def test_refusals(self) -> None:
        for words, measure, named in [
            ('measure: "fob" is not a measure; there are: components, .*fov', "fob", {}),
            ('measure: "all" is not a measure; there are: components', "all", {}),
            ("angles_deg: is empty; give a list", "fov", {"angles_deg": []}),
            ("angles_deg: has 1 at place 1; give rising values within -80 to 80", "fov", {"angles_deg": [3, 1]}),
            ("eye_distance_mm: is 0", "fov", {"eye_distance_mm": 0}),
            ("wavelength_nm: is nan", "fov", {"wavelength_nm": math.nan}),
            ("depths_mm: the depth of field needs three depths", "dof", {"depths_mm": [1, 2]}),
        ]:
            with self.assertRaisesRegex(lfdsim.InputError, words):
                lfdsim.analyze(self.display, measure, **named)


if __name__ == "__main__":
    unittest.main()
