"""Pictures of the package equal the program's to the bit; arrays of all layouts; calls cost little."""

import pathlib
import subprocess
import sys
import time
import unittest
import warnings

import numpy as np

import lfdsim
from lfdsim import _core
from tiny import TINY, TinyTest

SEEN = {"camera_mm": (30, 10, 380), "size": (64, 40), "samples": 9, "seed": 3}
SEEN_OPTIONS = ["--camera-mm", "30,10,380", "--size", "64x40", "--samples", "9", "--seed", "3"]


class SameBits(TinyTest):
    def same(self, picture: np.ndarray, file: str) -> None:
        self.assertEqual(picture.dtype, np.float32)
        np.testing.assert_array_equal(picture, np.load(file))

    def test_elemental_images_and_their_codes(self) -> None:
        from PIL import Image

        self.program("eia", "tiny.toml", "--model", "pyramid.obj", "-o", "eia.npy")
        self.program("eia", "tiny.toml", "--model", "pyramid.obj", "-o", "eia.png")
        panel = lfdsim.elemental_images(self.display, model=pathlib.Path("pyramid.obj"))
        self.assertGreater(panel.max(), 0.1)
        self.same(panel, "eia.npy")
        np.testing.assert_array_equal(lfdsim.panel_codes(self.display, panel), np.asarray(Image.open("eia.png")))
        self.program("eia", "tiny.toml", "--pickup", "traced", "-o", "traced.npy")
        self.same(lfdsim.elemental_images(self.display, pickup="traced"), "traced.npy")

    def test_content_by_inversion(self) -> None:
        d = self.display.with_({"content.inverse.rays": 8, "content.inverse.iterations": 3, "content.inverse.places": 20})
        keys = ["--set", "content.inverse.rays=8", "content.inverse.iterations=3", "content.inverse.places=20"]
        self.program("eia", "tiny.toml", "--pickup", "inverse", "-o", "inverse.npy", *keys)
        self.same(lfdsim.elemental_images(d, pickup="inverse"), "inverse.npy")
        eyes = [(x, 0, 400) for x in (-20, 0, 20)]
        targets = [np.full((54, 96, 3), light, np.float32) for light in (0.2, 0.4, 0.6)]
        panel = lfdsim.elemental_images(d, pickup="inverse", targets=targets, target_eyes_mm=eyes)
        light = [lfdsim.render(d, panel, camera_mm=eye)[20:34, 40:56].mean() for eye in eyes]
        self.assertLess(light[0], light[1])
        self.assertLess(light[1], light[2])
        for named in ({"targets": targets}, {"targets": targets[:2], "target_eyes_mm": eyes}, {"target_eyes_mm": eyes}):
            with self.assertRaises(lfdsim.InputError):
                lfdsim.elemental_images(d, pickup="inverse", **named)
        codes = [np.full((54, 96, 3), code, np.uint8) for code in (124, 170, 203)]  # 0.2, 0.4, 0.6 of light
        by_codes = lfdsim.elemental_images(d, pickup="inverse", targets=codes, target_eyes_mm=np.array(eyes))
        self.assertLess(np.abs(by_codes - panel).mean(), 0.01)
        with self.assertRaisesRegex(lfdsim.InputError, "targets"):
            lfdsim.elemental_images(d, pickup="traced", targets=targets, target_eyes_mm=eyes)
        for wrong in (targets[0][::2], targets[0] - 1, targets[0][..., 0]):  # another form, below 0, grey
            with self.assertRaisesRegex(lfdsim.InputError, r"targets\[1\]"):
                lfdsim.elemental_images(d, pickup="inverse", targets=[targets[0], wrong, targets[2]], target_eyes_mm=eyes)
        with self.assertRaisesRegex(lfdsim.InputError, "target_eyes_mm"):
            lfdsim.elemental_images(d, pickup="inverse", targets=targets, target_eyes_mm=[(0, 400)] * 3)

    def test_render(self) -> None:
        self.program("eia", "tiny.toml", "-o", "eia.npy")
        self.program("eia", "tiny.toml", "-o", "eia.png")
        panel = lfdsim.elemental_images(self.display)
        for name, shown, options in [
            ("light", panel, ["--panel-image", "eia.npy"]),
            ("codes", lfdsim.panel_codes(self.display, panel), ["--panel-image", "eia.png"]),
            ("model", None, []),
        ]:
            for estimator in ("filtered", "point"):
                with self.subTest(name, estimator=estimator):
                    self.program("render", "tiny.toml", *options, *SEEN_OPTIONS, "--estimator", estimator, "-o", "view.npy")
                    self.same(lfdsim.render(self.display, shown, **SEEN, estimator=estimator), "view.npy")
        self.program("render", "tiny.toml", "--model", "pyramid.obj", "--crop", "10,5,50,30", "--frame-width-mm", "40", "-o", "view.npy")
        self.same(lfdsim.render(self.display, model="pyramid.obj", crop=(10, 5, 50, 30), frame_width_mm=40), "view.npy")

    def test_patterns(self) -> None:
        for name, options, named in [
            ("white", [], {}),
            ("view", ["--view", "0.2,-0.1"], {"view": (0.2, -0.1)}),
            ("edge", ["--edge-deg", "8", "--edge-depth-mm", "5"], {"edge_deg": 8, "depth_mm": 5}),
            ("checkerboard", ["--cell-pixels", "3"], {"cell_pixels": 3}),
        ]:
            self.program("eia", "tiny.toml", "--pattern", name, *options, "-o", "pattern.npy")
            self.same(lfdsim.pattern(self.display, name, **named), "pattern.npy")

    def test_a_prepared_panel(self) -> None:
        array = lfdsim.elemental_images(self.display)
        panel = lfdsim.Panel(self.display, array)
        for named in ({}, {"estimator": "point"}, {"camera_mm": (30, 10, 380)}):
            np.testing.assert_array_equal(lfdsim.render(self.display, panel, **named), lfdsim.render(self.display, array, **named))
        with self.assertRaisesRegex(lfdsim.InputError, "panel: is 88 x 48 pixels, the panel has 80 x 48"):
            lfdsim.render(self.display.with_({"panel.pixels": [80, 48]}), panel)
        with self.assertRaisesRegex(lfdsim.InputError, "panel: holds nan"):
            lfdsim.Panel(self.display, np.full_like(array, np.nan))

    def test_codes_of_16_bits(self) -> None:
        d = self.display.with_({"panel.encoding": "linear"})
        codes = np.arange(88 * 48 * 3, dtype=np.uint16).reshape(48, 88, 3)
        np.testing.assert_array_equal(lfdsim.render(d, codes), lfdsim.render(d, (codes / 65535.0).astype(np.float32)))

    def test_photograph_and_comparison(self) -> None:
        self.program("photo", "tiny.toml", "--model", "pyramid.obj", "--camera-mm", "30,10,380", "--size", "64x40", "-o", "photo.npy")
        self.program("render", "tiny.toml", "--model", "pyramid.obj", *SEEN_OPTIONS, "-o", "view.npy")
        truth = lfdsim.photograph(self.display, model="pyramid.obj", camera_mm=(30, 10, 380), size=(64, 40))
        self.same(truth, "photo.npy")
        view = lfdsim.render(self.display, model="pyramid.obj", **SEEN)
        self.assertEqual(lfdsim.compare(view, truth), self.program_json("compare", "view.npy", "photo.npy"))
        self.assertEqual(
            lfdsim.compare(view, truth, crop=(5, 5, 60, 30)),
            self.program_json("compare", "view.npy", "photo.npy", "--crop", "5,5,60,30"),
        )
        self.assertEqual(lfdsim.compare(view, view)["psnr_db"], np.inf)


class Arrays(TinyTest):
    def setUp(self) -> None:
        super().setUp()
        self.panel = np.random.default_rng(1).random((48, 88, 3), dtype=np.float32)
        self.view = lfdsim.render(self.display, self.panel)

    def test_all_layouts_are_the_same_picture(self) -> None:
        wide = np.zeros((48, 176, 4), np.float32)
        wide[:, ::2, :3] = self.panel
        readonly = self.panel.copy()
        readonly.flags.writeable = False
        layouts = {
            "float64": self.panel.astype(np.float64),
            "strided": wide[:, ::2, :3],
            "reversed": self.panel[::-1, ::-1][::-1, ::-1],
            "Fortran": np.asfortranarray(self.panel),
            "big-endian": self.panel.astype(">f4"),
            "read-only": readonly,
            "list": self.panel.tolist(),
        }
        for name, layout in layouts.items():
            with self.subTest(name):
                np.testing.assert_array_equal(lfdsim.render(self.display, layout), self.view)

    def test_pictures_are_writable_and_own_their_memory(self) -> None:
        before = self.view.copy()
        other = lfdsim.render(self.display, self.panel)
        other[:] = 0
        del other
        np.testing.assert_array_equal(lfdsim.render(self.display, self.panel), before)

    def test_repairs_are_warned_of(self) -> None:
        pathlib.Path("lost.mtl").write_text("newmtl m\nmap_Kd lost.png\n")
        pathlib.Path("lost.obj").write_text("mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            lfdsim.render(self.display, model="lost.obj")
        self.assertEqual({w.category for w in caught}, {lfdsim.LfdsimWarning})
        self.assertIn("lost.obj: texture", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)


class Cost(TinyTest):
    def test_a_call_costs_less_than_ten_milliseconds(self) -> None:
        """Arrays in and out, a thread, signals, keys: with work of a thousandth of that."""
        picture = np.zeros((16, 16, 3), np.float32)

        def call() -> None:
            lfdsim.compare(picture, picture)
            self.display.with_({"camera.position_mm": (1, 2, 400), "render.seed": 3})

        times = []
        for _ in range(100):
            start = time.perf_counter()
            call()
            times.append(time.perf_counter() - start)
        print(f"a call costs {sorted(times)[50] * 1e3:.2f} ms")
        self.assertLess(sorted(times)[20], 1e-2)

    def test_a_large_picture_costs_little_more_than_its_rendering(self) -> None:
        """What a caller in C++ would not wait for: arrays, threads, checks; the least of three, as others may use the machine."""
        panel, display = np.zeros((48, 88, 3), np.float32), self.display.with_({"camera.resolution": (3840, 2160), "render.samples": 4})
        shares = []
        for _ in range(3):
            start = time.perf_counter()
            _, _, rendering = _core.render(display._handle, panel, None, None, 0, "cpu", "", None)
            shares.append((time.perf_counter() - start) / rendering - 1)
        print(f"{100 * min(shares):.2f} % is what Python adds to the time of a 4K picture")
        self.assertLess(min(shares), 0.02)

    def test_a_large_picture_is_in_memory_once(self) -> None:
        script = f"""
import lfdsim, numpy
def peak(): return next(int(line.split()[1]) * 1024 for line in open("/proc/self/status") if line.startswith("VmHWM"))
d = lfdsim.Display.parse({TINY!r})
panel = numpy.zeros((48, 88, 3), numpy.float32)
lfdsim.render(d, panel, threads=1, device="cpu")
before = peak()
view = lfdsim.render(d, panel, size=(3840, 2160), samples=1, threads=1, device="cpu")
print((peak() - before) / view.nbytes)
"""
        copies = float(subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout)
        print(f"a 4K picture takes the memory of {copies:.2f} of it")
        self.assertLess(copies, 1.15)


if __name__ == "__main__":
    unittest.main()
