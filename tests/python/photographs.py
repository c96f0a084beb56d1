"""Photographs of a display over views: figures and pictures are those of `lfdsim compare --corners`."""

import io
import pathlib
import unittest

import numpy as np
from PIL import Image

import lfdsim
from tiny import TinyTest

WIDTH, HEIGHT, BORDER = 192, 108, (30, 20)  # of the view; what the photograph has around it, in columns and rows
GAINS = (0.8, 0.9, 0.7)


class Photographs(TinyTest):
    """The photograph is a finer view on a grey ground: known corners, known gains."""

    def setUp(self) -> None:
        super().setUp()
        colours = np.random.default_rng(2).uniform(0.05, 0.9, (12, 22, 3))
        panel = np.kron(colours, np.ones((4, 4, 1)))
        self.display = self.display.with_({"diffuser.angle_deg": [1.5, 1]})
        self.view = lfdsim.render(self.display, panel, size=(WIDTH, HEIGHT))
        fine = lfdsim.render(self.display, panel, size=(2 * WIDTH, 2 * HEIGHT))
        light = np.pad(fine * GAINS, [(BORDER[1],) * 2, (BORDER[0],) * 2, (0, 0)], constant_values=0.1)
        self.photo = np.frombuffer(Image.open(io.BytesIO(lfdsim.png(light))).tobytes(), np.uint8).reshape(light.shape)
        self.in_view = lfdsim.screen_corners(self.display, size=(WIDTH, HEIGHT))
        self.in_photo = 2 * self.in_view + BORDER

    def same_as_the_program(self, found: lfdsim.PhotographComparison, photo: str, view: str, *options: str) -> None:
        corners = [f"{x!r},{y!r}" for x, y in self.clicked.tolist()]
        wanted = self.program_json(
            "compare", view, photo, "--corners", *corners, *options, "-o", "overlay.npy", "--difference", "difference.npy"
        )
        self.assertEqual(found.figures, wanted)
        np.testing.assert_array_equal(found.overlay, np.load("overlay.npy"))
        np.testing.assert_array_equal(found.difference, np.load("difference.npy"))

    def test_what_was_done_is_found_and_is_what_the_program_finds(self) -> None:
        np.save("view.npy", self.view)
        Image.fromarray(self.photo).save("photo.png")
        self.clicked = self.in_photo + [[1, -2], [-1, 1.5], [2, 1], [-1.5, -1]]
        in_view = ["--view-corners", *(f"{x!r},{y!r}" for x, y in self.in_view.tolist())]
        for options, named in [
            ([], {}),
            (["--fit-corners", "--fit-blur"], {"fit_corners": True, "fit_blur": True}),
            (["--crop", "40,20,150,90"], {"crop": (40, 20, 150, 90)}),
            (["--encoding", "linear"], {"encoding": "linear"}),
        ]:
            with self.subTest(options):
                found = lfdsim.compare_photograph(self.view, self.photo, self.clicked, self.in_view, **named)
                self.same_as_the_program(found, "photo.png", "view.npy", *in_view, *options)
        fitted = lfdsim.compare_photograph(self.view, self.photo, self.clicked, self.in_view, fit_corners=True).figures
        self.assertGreater(fitted["ssim"], 0.98)
        np.testing.assert_allclose(fitted["gains"], GAINS, rtol=0.02)
        np.testing.assert_allclose(fitted["corners"], self.in_photo, atol=0.3)

    def test_floats_are_light_without_a_limit(self) -> None:
        light = 7 * np.repeat(np.repeat(self.view, 2, 0), 2, 1)
        found = lfdsim.compare_photograph(self.view, light, 2 * self.in_view, self.in_view)
        np.testing.assert_allclose(found.figures["gains"], 7, rtol=1e-3)
        self.assertEqual(found.figures["unsaturated_share"], 1)
        self.assertGreater(found.photograph.max(), 0.8 * found.simulated.max())

    def test_the_screen_is_where_the_program_finds_it(self) -> None:
        pathlib.Path("tiny.toml").write_text(repr(self.display))
        where = {"camera_mm": (40, 5, 380), "frame_width_mm": 60}
        options = ["--camera-mm", "40,5,380", "--frame-width-mm", "60", "--size", f"{WIDTH}x{HEIGHT}"]
        self.program("render", "tiny.toml", *options, "-o", "view.png")
        corners = lfdsim.screen_corners(self.display, size=(WIDTH, HEIGHT), **where)
        texts = [f"{x!r},{y!r}" for x, y in corners.tolist()]
        self.assertEqual(self.program_json("compare", "view.png", "view.png", "--corners", *texts)["view_corners"], corners.tolist())
        with self.assertRaisesRegex(lfdsim.InputError, "camera_mm.*whole screen in front"):
            lfdsim.screen_corners(self.display, camera_mm=(0, 0, 60), target_mm=(100, 0, 59))

    def test_notebooks_show_figures_and_overlay(self) -> None:
        found = lfdsim.compare_photograph(self.view, self.photo, self.in_photo, self.in_view)
        shown = found._repr_html_()
        self.assertIn(">ssim</td>", shown)
        self.assertIn("data:image/png;base64,iVBOR", shown)
        self.assertIn(f"ssim: {found.figures['ssim']:.5g}", repr(found))

    def test_png_is_the_program_s(self) -> None:
        self.program("render", "tiny.toml", "-o", "view.png")
        codes = np.asarray(Image.open("view.png"))
        ours = lfdsim.png(lfdsim.render(lfdsim.Display.load("tiny.toml")))
        np.testing.assert_array_equal(np.asarray(Image.open(io.BytesIO(ours))), codes)
        self.assertEqual(lfdsim.png(codes), ours)
        with self.assertWarnsRegex(lfdsim.LfdsimWarning, "^picture: 100 % of the pixels are brighter than white, the brightest 2.5 times, and are cut off"):
            lfdsim.png(np.full((4, 4, 3), 2.5))
        with self.assertWarnsRegex(lfdsim.LfdsimWarning, "^the panel's content: .* is lost; the panel shows no more$"):
            lfdsim.render(lfdsim.Display.load("tiny.toml", {"content.light.strength": 3}))

    def test_refusals(self) -> None:
        good = self.in_photo.tolist()
        for kind, words, change in [
            (TypeError, "view holds int64", {"view": np.ones((20, 20, 3), int)}),
            (lfdsim.InputError, r"photograph: has the shape \(20, 20\)", {"photograph": np.ones((20, 20))}),
            (lfdsim.InputError, "photograph: holds nan", {"photograph": np.full((400, 600, 3), np.nan)}),
            (lfdsim.InputError, "corners_px: is .* give four points", {"corners_px": good[:3]}),
            (TypeError, "corners_px is .* give four points", {"corners_px": [1, 2, 3]}),
            (TypeError, "corners_px is a str", {"corners_px": [("1", "2")] * 4}),
            (lfdsim.InputError, "view_corners_px: is nan", {"view_corners_px": [(0, np.nan)] * 4}),
            (lfdsim.InputError, "corners_px: the corner 0,inf", {"corners_px": [(0, np.inf)] * 4}),
            (lfdsim.InputError, "corners_px: the corner 5000,.* lies far outside of the photograph", {"corners_px": [(5000, 9)] * 4}),
            (lfdsim.InputError, "corners_px: .*top right", {"corners_px": good[::-1]}),
            (TypeError, "fit_blur is a int", {"fit_blur": 1}),
            (lfdsim.InputError, "crop: is", {"crop": (0, 0, 500, 1)}),
            (lfdsim.InputError, 'encoding: is "gamma"', {"encoding": "gamma"}),
            (lfdsim.InputError, "black", {"photograph": np.zeros((400, 600, 3))}),
        ]:
            arguments = {"view": self.view, "photograph": self.photo, "corners_px": good, "view_corners_px": self.in_view, **change}
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                lfdsim.compare_photograph(**arguments)


if __name__ == "__main__":
    unittest.main()
