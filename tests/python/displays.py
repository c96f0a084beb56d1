"""lfdsim.Display: keys, changes, errors, equality, pickles."""

import math
import os
import pathlib
import pickle
import unittest
from typing import Any
from xml.etree import ElementTree

import lfdsim
from tiny import PROGRAM, TINY, TinyTest

SHIPPED = sorted((pathlib.Path(__file__).resolve().parents[2] / "displays").glob("*.toml"))


class Keys(TinyTest):
    def test_values_are_those_of_the_description(self) -> None:
        d = self.display
        self.assertEqual((d["panel.pixels"], d["array.pitch_mm"], d["lens.type"]), ((88, 48), 4.0, "plano_convex"))
        self.assertEqual(d["diffuser"], {"distance_mm": 40.0, "angle_deg": (4.0, 3.0), "profile": "box"})
        self.assertIsNone(d["array.base_z_mm"])
        self.assertIsNone(d["lens.surface"])
        self.assertEqual(d.with_({"content.viewing_distance_mm": math.inf})["content.viewing_distance_mm"], math.inf)

    def test_lists_of_tables(self) -> None:
        layers = [{"thickness_mm": 1.0, "index": 1.5}, {"thickness_mm": 0.5, "glass": "PMMA"}]
        d = self.display.with_({"panel.layer": layers})
        self.assertEqual([layer["thickness_mm"] for layer in d["panel.layer"]], [1.0, 0.5])
        self.assertEqual(d.with_({"panel.layer.1.thickness_mm": 0.25})["panel.layer.1.thickness_mm"], 0.25)
        self.assertEqual(d["panel.layer.1.glass"], "PMMA")

    def test_what_is_absent_is_none(self) -> None:
        d = lfdsim.Display.parse(TINY.replace('name = "tiny"\n', ""))
        for key in ("name", "content.model", "errors.table", "content.inverse.start", "camera.fov_deg"):
            self.assertIsNone(d[key], key)
        self.assertIsNone(d.to_dict()["errors"]["table"])

    def test_an_unknown_key_names_the_one_that_was_meant(self) -> None:
        with self.assertRaisesRegex(KeyError, "array.gap: is unknown; did you mean array.gap_mm"):
            self.display["array.gap"]
        with self.assertRaises(lfdsim.DisplayError):
            self.display["array.gap"]
        with self.assertRaises(TypeError):
            self.display[3]

    def test_all_keys_can_be_asked_for(self) -> None:
        for path in SHIPPED:
            d = lfdsim.Display.load(path)
            for key in d.keys():
                d[key]
                self.assertIn(key, d)
            self.assertEqual(list(d), list(d.keys()))
            self.assertIn("lens", d)
            self.assertNotIn("array.gap", d)
            self.assertEqual(d.to_dict()["panel"]["pixels"], d["panel.pixels"])


class Changes(TinyTest):
    def test_a_change_makes_a_new_display(self) -> None:
        e = self.display.with_({"array.gap_mm": 5.5, "diffuser": None})
        self.assertEqual((e["array.gap_mm"], e["diffuser"], e["diffuser.distance_mm"]), (5.5, None, None))
        self.assertEqual((self.display["array.gap_mm"], self.display["diffuser.distance_mm"]), (5.0, 40.0))
        with self.assertRaises((AttributeError, TypeError)):
            self.display["array.gap_mm"] = 3

    def test_none_restores_the_default_of_a_word(self) -> None:
        d = self.display.with_({"content.model": "pyramid.obj", "panel.subpixels": "rgb_stripe"})
        self.assertEqual(d["content.model"], os.path.abspath("pyramid.obj"))
        self.assertEqual(d.with_({"content.model": None, "panel.subpixels": None}), self.display)
        for key in ("content.model", "errors.table"):
            with self.assertRaisesRegex(lfdsim.DisplayError, f"{key}: has an empty text"):
                d.with_({key: ""})

    def test_values_of_every_kind(self) -> None:
        import numpy as np

        changes = {
            "camera.position_mm": np.array([1, 2, 400.0]),
            "render.seed": np.int64(7),
            "array.gap_mm": np.float32(5.5),
            "name": 'a "name" \\ with\nlines \x7f and é',
            "lens.index": None,
            "lens.glass": {"nd": 1.5, "vd": 60},
        }
        d = self.display.with_(changes)
        self.assertEqual(d["camera.position_mm"], (1.0, 2.0, 400.0))
        self.assertEqual((d["render.seed"], d["array.gap_mm"], d["name"]), (7, 5.5, changes["name"]))
        self.assertEqual(d["lens.glass"], {"nd": 1.5, "vd": 60.0})

    def test_tables_can_be_put_back(self) -> None:
        thirds = [{"channel": c, "pixel": [0, 0], "rect": [k / 3, 0, (k + 1) / 3, 1]} for k, c in enumerate("rgb")]
        pyramid = {"model": "pyramid.obj", "height_mm": 20.0}
        glass = {"name": "mine", "nd": 1.5, "vd": 60, "range_nm": [400, 700]}
        changes: list[dict[str, Any]] = [
            {"content.model": None, "content.object": [pyramid | {"position_mm": [9, 0, 3]}, pyramid], "content.height_mm": None, "content.depth_mm": None},
            {"content.model": "pyramid.obj", "content.depth_mm": None},
            {"panel.layer": [{"thickness_mm": 1.0, "index": 1.5}, {"thickness_mm": 0.5, "glass": "PMMA"}]},
            {"panel.subpixels": "custom", "panel.subpixel_cell": [1, 1], "panel.subpixel": thirds},
            {"diffuser": None, "lens.glass": {"cauchy": [1.5, 0.004, 0]}, "lens.index": None},
            {"lens.glass": glass, "lens.index": None},
            {"content.inverse.eyes_mm": [[-50, 0, 400], [50, 0, 400]]},
        ]
        made = [self.display.with_(change) for change in changes] + [lfdsim.Display.load(path) for path in SHIPPED]
        for d in made:
            again = d.with_(d.to_dict())
            self.assertEqual((again, lfdsim.check(again, warnings=False)), (d, lfdsim.check(d, warnings=False)))
            for table in {key.rpartition(".")[0] for key in d.keys()} | {"content.object", "panel.layer"}:
                self.assertEqual(d.with_({table: d[table]}) if table else d, d, table)
        camera = self.display["camera"]
        camera["resolution"] = (12, 8)
        self.assertEqual(self.display.with_({"camera": camera}), self.display.with_({"camera.resolution": (12, 8)}))

    def test_errors_are_those_of_the_program(self) -> None:
        import subprocess

        wrong = subprocess.run([PROGRAM, "check", "tiny.toml", "--set", "array.gap_mm=-1"], capture_output=True, text=True).stderr
        with self.assertRaises(lfdsim.DisplayError) as caught:
            self.display.with_({"array.gap_mm": -1})
        self.assertIn(str(caught.exception), wrong)
        self.assertEqual((caught.exception.key, caught.exception.remedy), ("array.gap_mm", "allowed is 1e-6 to 1e6"))
        self.assertIsInstance(caught.exception, ValueError)

    def test_all_problems_are_told_at_once(self) -> None:
        with self.assertRaises(lfdsim.DisplayError) as caught:
            self.display.with_({"array.gap_mm": -1, "lens.indx": 2, "panel.pixels": "many"})
        self.assertEqual({p.key for p in caught.exception.problems}, {"array.gap_mm", "lens.indx", "panel.pixels"})

    def test_places_in_a_file(self) -> None:
        pathlib.Path("bad.toml").write_text(TINY.replace("gap_mm = 5.0", "gap_mm = 0"))
        with self.assertRaisesRegex(lfdsim.DisplayError, r"bad.toml:15:10: array.gap_mm: is 0"):
            lfdsim.Display.load("bad.toml")
        with self.assertRaisesRegex(lfdsim.DisplayError, "nowhere.toml: there is no such file"):
            lfdsim.Display.load(pathlib.Path("nowhere.toml"))


class Identity(TinyTest):
    def test_notebooks_show_it_drawn(self) -> None:
        shown = self.display._repr_html_()
        self.assertIn("gap_mm = 5", shown)
        for drawing in self.display.drawings():
            self.assertIn(drawing, shown)
            self.assertTrue(ElementTree.fromstring(drawing).tag.endswith("svg"))

    def test_repr_is_the_description(self) -> None:
        for path in SHIPPED:
            d = lfdsim.Display.load(path)
            self.assertEqual(lfdsim.Display.parse(repr(d)), d)
            self.assertEqual(hash(lfdsim.Display.parse(repr(d))), hash(d))

    def test_a_pickle_is_the_same_display_in_any_folder(self) -> None:
        d = lfdsim.Display.load("tiny.toml").with_({"content.model": "pyramid.obj"})
        held = pickle.dumps(d)
        os.chdir("/")
        self.assertEqual(pickle.loads(held), d)
        self.assertEqual(len({d, pickle.loads(held), self.display}), 2)
        self.assertNotEqual(d, repr(d))

    def test_a_model_without_depth_stands_where_the_description_had_it(self) -> None:
        def depth(display):
            return lfdsim.check(display)["geometry"]["content_depth_mm"]

        gap, none = {"array.gap_mm": 1.01 * self.display["array.gap_mm"]}, {"content.depth_mm": None}
        written = depth(self.display.with_(none))
        both = self.display.with_(gap).with_(none)
        for d in (both, self.display.with_(none).with_(gap), lfdsim.Display.load("tiny.toml", none | gap), pickle.loads(pickle.dumps(both))):
            self.assertEqual(depth(d), written)
            self.assertEqual(depth(pickle.loads(pickle.dumps(d.with_({"content.depth_mm": 1}))).with_(none)), written)
            self.assertIsNone(d["content.depth_mm"])

    def test_errors_survive_a_pickle(self) -> None:
        for wrong in (lambda: self.display["x.y"], lambda: self.display.with_({"array.gap_mm": 0})):
            with self.assertRaises(lfdsim.DisplayError) as caught:
                wrong()
            again = pickle.loads(pickle.dumps(caught.exception))
            self.assertEqual(
                (type(again), str(again), again.problems), (type(caught.exception), str(caught.exception), caught.exception.problems)
            )

    def test_check_is_that_of_the_program(self) -> None:
        def words(value):
            if isinstance(value, dict):
                return {key: words(each) for key, each in value.items()}
            if isinstance(value, list):
                return [words(each) for each in value]
            return {math.inf: "infinite", -math.inf: "-infinite"}.get(value, value) if isinstance(value, float) else value

        for path in [pathlib.Path("tiny.toml"), *SHIPPED]:
            self.assertEqual(words(lfdsim.check(lfdsim.Display.load(path))), self.program_json("check", str(path)))


if __name__ == "__main__":
    unittest.main()
