"""Wrong arguments from Python: an exception that names them, never a crash."""

import math
import pathlib
import unittest
import warnings
from unittest import mock
from typing import Any

import numpy as np

import lfdsim
from tiny import TinyTest

class Named(TinyTest):
    def refused(self, kind: type[Exception], words: str, call: Any, *arguments: Any, **named: Any) -> None:
        with self.assertRaisesRegex(kind, words):
            call(*arguments, **named)

    def test_panels(self) -> None:
        d, good = self.display, np.zeros((48, 88, 3), np.float32)
        for kind, words, panel in [
            (lfdsim.InputError, r"panel: has the shape \(48, 88\)", good[:, :, 0]),
            (lfdsim.InputError, r"panel: has the shape \(48, 88, 4\)", np.zeros((48, 88, 4))),
            (lfdsim.InputError, r"panel: is 48 x 88 pixels, the panel has 88 x 48", good.transpose(1, 0, 2)),
            (lfdsim.InputError, r"panel: has the shape \(0, 88, 3\)", good[:0]),
            (TypeError, "panel holds int64", good.astype(np.int64)),
            (TypeError, "panel holds bool", good.astype(bool)),
            (TypeError, "panel holds complex128", good.astype(complex)),
            (TypeError, "panel holds <U", "eia.png"),
            (TypeError, "panel holds object", {"a": 1}),
            (TypeError, "panel", [[1, 2], [3]]),
        ]:
            with self.subTest(words):
                self.refused(kind, words, lfdsim.render, d, panel)
        for value, text in [(np.nan, "nan"), (np.inf, "inf"), (-1, "-1"), (1e300, "inf")]:
            bad = good.astype(float)
            bad[7, 5, 1] = value
            self.refused(lfdsim.InputError, f"panel: holds {text} in channel G at column 5, row 7", lfdsim.render, d, bad)
        hidden = np.ma.masked_array(good.astype(float), mask=np.zeros(good.shape, bool))
        lfdsim.render(d, hidden)  # nothing of it is masked
        hidden[:, 5] = np.ma.masked
        self.refused(lfdsim.InputError, r"panel: has masked values; give panel\.filled", lfdsim.render, d, hidden)
        # Values of 0 to 255 are no light, and are not shown 128 times as bright as white without a word.
        codes = np.full((48, 88, 3), 128, np.uint8)
        for doubtful, remedy in [
            (codes.astype(np.float32), r"panel holds light of up to 128, and white is 1: .*panel\.astype\(numpy\.uint8\)"),
            (codes * 77.0 + 0.25, r"up to 9856.25, .*uint16"),
            (codes / 100.0, r"up to 1.28, .*divide by the greatest"),
        ]:
            for call in (lfdsim.render, lfdsim.Panel, lfdsim.panel_codes):
                with self.assertWarnsRegex(lfdsim.LfdsimWarning, remedy):
                    call(d, doubtful)
        wide = codes.astype(np.uint16)
        for call in (lfdsim.render, lfdsim.Panel, lfdsim.panel_codes):
            with self.assertWarnsRegex(lfdsim.LfdsimWarning, r"panel holds codes of up to 128, and white is 65535: .*panel\.astype\(numpy\.uint8\)"):
                call(d, wide)
        with self.assertWarnsRegex(lfdsim.LfdsimWarning, "its code is that of 1"):
            lfdsim.panel_codes(d, codes / 100.0)
        self.refused(lfdsim.InputError, "panel: holds -0.5 in channel R at column 0, row 0", lfdsim.panel_codes, d, codes * 0.0 - 0.5)
        with self.assertWarnsRegex(lfdsim.LfdsimWarning, "a holds light of up to 128"):
            lfdsim.compare(codes.astype(float), codes)
        with self.assertWarnsRegex(lfdsim.LfdsimWarning, "picture holds light of up to 128"):
            lfdsim.png(codes.astype(float))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            specks = np.zeros_like(wide)
            specks[5, 7] = 200
            for panel in (wide * 0, wide * 257, specks):
                lfdsim.panel_codes(d, panel)
            lfdsim.compare(codes / 100.0, codes)  # what a display shows may be brighter than its mean white
            opaque = np.concatenate([codes, np.full((48, 88, 1), 255, np.uint8)], axis=2)
            np.testing.assert_array_equal(lfdsim.render(d, opaque), lfdsim.render(d, codes))
        opaque[5, 7, 3] = 254
        self.refused(lfdsim.InputError, "its alpha is not full everywhere", lfdsim.render, d, opaque)
        self.refused(TypeError, r"panel holds int64.*panel\.astype\(numpy\.uint8\)", lfdsim.render, d, codes.astype(int))
        huge = np.broadcast_to(np.float32(0), (10**7, 10**6, 3))  # without memory of its own
        self.refused(lfdsim.InputError, "panel: .*10000000.*pixels|memory", lfdsim.render, d, huge)
        self.refused(lfdsim.InputError, "needs .* of memory; .* free|pixels", lfdsim.compare, huge, huge)

        def with_memory(most: int) -> Any:
            def require(where: str, what: str, needed: float) -> None:
                if needed > most:
                    raise lfdsim.InputError([(where, f"{what} is refused")])
            return mock.patch("lfdsim._core.require_memory", require)
        with with_memory(1000):
            self.refused(lfdsim.InputError, r"panel: an array of the shape \(48, 88, 3\) is refused", lfdsim.render, d, good)
        with with_memory(5 * good.size):  # of one picture, but not of what is made of it
            self.refused(lfdsim.InputError, "picture: an array of the shape", lfdsim.png, good)
            self.refused(lfdsim.InputError, "a: an array of the shape", lfdsim.compare, good, good)
        # The program's own words.
        self.refused(lfdsim.InputError, r"a: 3 pictures needs 1000000.0 GB of memory; .* [\d.]+ [GM]B free",
                     lfdsim._core.require_memory, "a", "3 pictures", 1e15)
        self.refused(lfdsim.InputError, "give one of them", lfdsim.render, d, good, model="pyramid.obj")

    def test_warnings_point_to_the_line_that_called(self) -> None:
        d, bright = self.display, np.full((48, 88, 3), 1.5)
        narrow = d.with_({"content.pickup": "inverse", "content.inverse.eyes_mm": [[0, 0, 400], [0.1, 0, 400]], "content.inverse.iterations": 1})
        for call in [
            lambda: lfdsim.render(d, bright),
            lambda: lfdsim.Panel(d, bright),
            lambda: lfdsim.panel_codes(d, bright),
            lambda: lfdsim.png(bright * 100),
            lambda: lfdsim.compare(bright * 20, bright),
            lambda: lfdsim.elemental_images(narrow),
        ]:
            with self.assertWarns(lfdsim.LfdsimWarning) as caught:
                call()
            self.assertEqual(caught.filename, __file__)
        self.assertIn("content.inverse.eyes_mm", str(caught.warning))  # as no argument is called --eyes-mm

    def test_eyes_of_targets(self) -> None:
        targets = [np.full((54, 96, 3), 0.5, np.float32)]
        for kind, words, eyes in [
            (TypeError, r"target_eyes_mm\[0\] is a str; give a number", ["abc"]),
            (TypeError, r"target_eyes_mm\[0\] is 5; give 3 numbers", [5]),
            (TypeError, r"target_eyes_mm is 5; give \(x, y, z\)", 5),
            (lfdsim.InputError, r"target_eyes_mm\[0\]: is \(0, 0\); give 3 numbers", [(0, 0)]),
            (lfdsim.InputError, r"target_eyes_mm\[0\]: is nan", [(0, 0, math.nan)]),
            (lfdsim.InputError, "target_eyes_mm: an eye at .* behind the panel", [(0, 0, -5)]),
        ]:
            with self.subTest(words):
                named = {"pickup": "inverse", "targets": targets, "target_eyes_mm": eyes}
                self.refused(kind, "^" + words, lfdsim.elemental_images, self.display, **named)

    def test_options(self) -> None:
        d = self.display
        for kind, words, named in [
            (lfdsim.DisplayError, "camera_mm: camera.position_mm: has 2 elements; give a list of 3 numbers", {"camera_mm": (1, 2)}),
            (lfdsim.DisplayError, "camera_mm: camera.position_mm: has 1 element;", {"camera_mm": (1,)}),
            (lfdsim.DisplayError, "camera_mm: camera.position_mm: is a string", {"camera_mm": "here"}),
            (lfdsim.DisplayError, r"size: camera.resolution\[0\]: is 0, allowed is 1", {"size": (0, 5)}),
            (lfdsim.DisplayError, "size: camera.resolution", {"size": 7}),
            (lfdsim.DisplayError, "samples: render.samples", {"samples": 2.5}),
            (lfdsim.DisplayError, "estimator: render.estimator", {"estimator": "magic"}),
            (lfdsim.DisplayError, "camera.resolution", {"size": (10**6, 10**6)}),
            (lfdsim.DisplayError, "seed: render.seed: is or holds 9223372036854775808; whole numbers have 64 bits", {"seed": 2**63}),
            (lfdsim.InputError, "threads: is -1", {"threads": -1}),
            (TypeError, "threads is a float", {"threads": 1.0}),
            (lfdsim.InputError, "device: unknown device 'tpu'", {"device": "tpu"}),
            (TypeError, "device is a int", {"device": 0}),
            (lfdsim.InputError, "kernel: unknown kernel 'z80'", {"kernel": "z80"}),
            (lfdsim.InputError, r"crop: is \(0, 0, 97, 1\)", {"crop": (0, 0, 97, 1)}),
            (lfdsim.InputError, "crop", {"crop": (0, 0, 1)}),
            (TypeError, "crop is 'all'|crop is", {"crop": 5}),
            (lfdsim.InputError, "nowhere.glb", {"model": "nowhere.glb"}),
            (lfdsim.InputError, "model: is empty; give a path", {"model": ""}),
            (TypeError, "progress is a str; give True, False, None or a function", {"progress": "no"}),
        ]:
            with self.subTest(words):
                self.refused(kind, words, lfdsim.render, d, **named)
        self.refused(TypeError, "display is a str", lfdsim.render, "tiny.toml")
        with self.assertRaises(lfdsim.DisplayError) as caught:
            lfdsim.render(d, size=7, samples=0)
        self.assertEqual([p.key for p in caught.exception.problems], ["camera.resolution", "render.samples"])
        self.refused(lfdsim.InputError, "path: is empty; give a path", lfdsim.Display.load, "")
        self.refused(lfdsim.DisplayError, "'': is unknown", d.with_, {"": 3})
        self.refused(TypeError, "text is a bytes; give a text", lfdsim.Display.parse, b"schema = 1")
        self.refused(TypeError, "array.gap_mm: a object", d.with_, {"array.gap_mm": object()})
        self.refused(TypeError, "panel.layer: None cannot be in a list; leave it out", d.with_, {"panel.layer": [None]})
        self.refused(lfdsim.DisplayError, "panel.pixels: is or holds 36893488147419103232;", d.with_, {"panel.pixels": [2**65, 3]})
        self.refused(TypeError, "warnings is a int; give True or False", lfdsim.check, d, 0)
        self.refused(TypeError, "key is a int", d.with_, {3: 4})
        self.refused(TypeError, "changes are a dict", d.with_, [("array.gap_mm", 3)])
        self.refused(lfdsim.DisplayError, "is unknown", d.with_, {"array.gap_mm=3 #": 4})
        self.refused(TypeError, "load", lfdsim.Display)

    def test_files(self) -> None:
        pathlib.Path("damaged.obj").write_bytes(b"v 1 nan\nf 1 2 3\n\x00\xff")
        self.refused(lfdsim.InputError, "damaged.obj", lfdsim.photograph, self.display, model="damaged.obj")
        self.refused(lfdsim.DisplayError, ".", lfdsim.Display.load, ".")
        self.refused(lfdsim.DisplayError, "text: is a binary file", lfdsim.Display.parse, "\x00")

    def test_patterns(self) -> None:
        for words, name, named in [
            ("there are checkerboard", "plaid", {}),
            ("view: is .* give 2 numbers", "view", {"view": [3]}),
            (r"^view\[0\]: 0.7 given; .*-0.5 to 0.5", "view", {"view": (0.7, 0)}),
            ("cell_pixels: is 0, allowed is 1", "checkerboard", {"cell_pixels": 0}),
        ]:
            self.refused(lfdsim.InputError, words, lfdsim.pattern, self.display, name, **named)
        self.refused(TypeError, "view is 3; give 2 numbers", lfdsim.pattern, self.display, "view", view=3)

    def test_comparisons(self) -> None:
        a = np.zeros((20, 20, 3))
        self.refused(lfdsim.InputError, r"b: has the shape \(20, 21, 3\), a has", lfdsim.compare, a, np.zeros((20, 21, 3)))
        self.refused(lfdsim.InputError, "encoding", lfdsim.compare, a, a, encoding="gamma")
        self.refused(lfdsim.InputError, "a, b: 5 x 5 pixels are too few", lfdsim.compare, a[:5, :5], a[:5, :5])
        self.refused(lfdsim.InputError, "crop: 5 x 9 pixels are too few", lfdsim.compare, a, a, crop=(0, 0, 5, 9))
        for nan in (np.nan, -np.nan):
            self.refused(lfdsim.InputError, "b: holds nan", lfdsim.compare, a, np.full_like(a, nan))


if __name__ == "__main__":
    unittest.main()
