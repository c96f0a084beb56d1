"""Pictures and curves of a study are those of lfdsim.render and lfdsim.analyze, bit for bit, and open in one line."""

import unittest

import numpy as np
import pandas
from common import StudyTest

import lfdsim
from lfdsim import study
from lfdsim.study import StudyFailed

try:
    import xarray
    import zarr  # noqa: F401
except ImportError:
    xarray = None

HEAD = 'schema = 1\ndisplay = "display.toml"\ndesign = "grid"\n'
GAPS = '[[factor]]\nkey = "array.gap_mm"\nvalues = [16.3, -1.0, 16.6]\n'
ZONE = '[[measure]]\nname = "zone"\ntables = ["TABLE"]\n[measure.settings]\nsize = [32, 18]\n'


class Kept(StudyTest):
    def display(self, gap: float) -> "lfdsim.Display":
        return lfdsim.Display.load(self.folder / "display.toml").with_({"array.gap_mm": gap, "camera.resolution": [64, 36]})

    @unittest.skipIf(xarray is None, "xarray and zarr are not installed")
    def test_pictures(self):
        text = HEAD + '[set]\n"camera.resolution" = [64, 36]\n' + GAPS + '[[picture]]\nname = "front"\ncompare = true\n'
        table = study.run(self.write(text), self.folder / "out", workers=2, progress=False)
        kept = xarray.open_zarr(self.folder / "out" / "pictures.zarr", chunks=None)["front"]
        self.assertEqual(kept.dims, ("row", "front_y", "front_x", "channel"))
        for row, gap in ((0, 16.3), (2, 16.6)):
            view = lfdsim.render(self.display(gap), progress=False)
            np.testing.assert_array_equal(kept[row], view)
            truth = lfdsim.photograph(self.display(gap), progress=False)
            self.assertEqual(table["front.ssim"][row], lfdsim.compare(view, truth)["ssim"])
        self.assertTrue(np.isnan(kept[1]).all())
        self.assertIn("array.gap_mm", table["error"][1])

    @unittest.skipIf(xarray is None, "xarray and zarr are not installed")
    def test_pictures_of_several_sizes_are_refused(self):
        text = HEAD + '[[factor]]\nkey = "camera.resolution"\nvalues = [[96, 54], [64, 36]]\n[[picture]]\nname = "front"\n'
        with self.assertRaisesRegex(ValueError, "of row 1 is 64 x 36, others 96 x 54; give the picture a size"):
            study.run(self.write(text), self.folder / "out", workers=1, progress=False)

    def test_curves(self):
        name = next(iter(lfdsim.analyze(self.display(16.3), "zone", size=(32, 18), progress=False).tables))
        study.run(self.write(HEAD + GAPS + ZONE.replace("TABLE", name)), self.folder / "out", workers=1, progress=False)
        curves = pandas.read_parquet(self.folder / "out" / "curves" / f"zone.{name}")
        self.assertEqual(sorted(set(curves["row"])), [0, 2])
        expected = lfdsim.analyze(self.display(16.6), "zone", size=(32, 18), progress=False).tables[name]
        for column in expected:
            np.testing.assert_array_equal(curves[curves["row"] == 2][column], np.asarray(expected[column], float))

    def test_an_unknown_curve_is_told(self):
        with self.assertRaisesRegex(ValueError, '"zoone" is not a table of zone; did you mean zone') as caught:
            study.run(self.write(HEAD + GAPS + ZONE.replace("TABLE", "zoone")), self.folder / "out", workers=1, progress=False)
        self.assertNotIsInstance(caught.exception, StudyFailed)


if __name__ == "__main__":
    unittest.main()
