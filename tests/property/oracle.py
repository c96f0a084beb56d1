"""The independent tracer of tests/oracle, as the forms take it: displays resolved to lengths, and rays to the panel."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "oracle"))
import display as _display  # noqa: E402
import tracer as _tracer  # noqa: E402
from errors import MovedLattice  # noqa: E402, F401
from lattice import Lattice  # noqa: E402, F401
from pickup import nodal_lines, pixel_centres, subpixel_points  # noqa: E402, F401
from cases import to_toml  # noqa: E402, F401
from path import OFF_PANEL, PANEL  # noqa: E402, F401
from surface import Surface  # noqa: E402

by_axis, focus, trace = _display.by_axis, _display.focus, _tracer.trace


class SmoothSurface(Surface):
    """An asphere that differs little from its conic: Newton's steps from there are a fortieth of the work of a search for every root."""

    def _asphere_roots(self, o, d):
        conic = Surface(self.z, self.c, self.k, [], 1.2 * self.semi, self.n_below, self.n_above, self.across[1] == 0)
        return [self._polished(t, o, d) for t in conic.roots(o, d)]

    def _polished(self, t, o, d):
        on = np.isfinite(t)
        t = np.where(on, t, 0.0)
        for _ in range(8):
            p = o + t[:, None] * d
            with np.errstate(divide="ignore", invalid="ignore"):
                n = self.normal(p)
                t = t - (p[:, 2] - self.height(self.squared(p))) * n[:, 2] / np.sum(n * d, axis=1)
        p = o + t[:, None] * d
        s2 = self.squared(p)
        met = on & (np.abs(p[:, 2] - self.height(s2)) < 1e-9) & (s2 <= self.semi**2)
        return np.where(met, t, np.inf)


def resolve(description):
    """tests/oracle's display of a description: lengths in mm, z from the panel."""
    trial = {} if "panel" in description else {"count": [1, 1]}  # of a lens alone; else as many as cover the panel
    panel = {"pixels": [1, 1], "pixel_pitch_mm": 1.0}
    d = _display.resolve({"panel": panel, **description, "array": {**trial, **description["array"]}})
    for at in [d, *d.primaries, *(at for _, at in d.colours)]:
        for surface in at.surfaces:
            surface.__class__ = SmoothSurface
    return d


def covering_count(description):
    """How many lenses, across and up, cover the panel."""
    array = {key: value for key, value in description["array"].items() if key != "count"}
    return np.array(resolve({**description, "array": array}).array.count)
