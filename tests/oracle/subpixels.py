"""Which part of a panel shines in which colour: rectangles of a cell of pixels that repeats. Lengths in pixels, x to the right, y down, from the top left."""
import math

import numpy as np

CHANNELS = "rgb"
THIRDS = (0.0, 1 / 3, 2 / 3, 1.0)


def rectangle(channel, pixel, x0, y0, x1, y1):
    return {"channel": channel, "pixel": list(pixel), "rect": [x0, y0, x1, y1]}


def _stripes(order, j=0, shift=0.0):
    return [rectangle(channel, (0, j), THIRDS[k] + shift, j, THIRDS[k + 1] + shift, j + 1) for k, channel in enumerate(order)]


PRESETS = {  # cell, rectangles
    "rgb_stripe": ([1, 1], _stripes("rgb")),
    "bgr_stripe": ([1, 1], _stripes("bgr")),
    "rgb_rows": ([1, 1], [rectangle(channel, (0, 0), 0, THIRDS[k], 1, THIRDS[k + 1]) for k, channel in enumerate("rgb")]),
    "pentile_rgbg": ([2, 2], [rectangle(channel, (k // 2, j), k / 2, j, k / 2 + 0.5, j + 1) for j, order in enumerate(("rgbg", "bgrg")) for k, channel in enumerate(order)]),
    "delta": ([1, 2], _stripes("rgb") + _stripes("rgb", 1, 0.5)),
}


class Subpixels:
    """The panel's rectangles. Without subpixels each pixel is one for each of the three channels, all in the same place."""

    def __init__(self, panel):
        kind = panel.subpixels
        if kind == "none":
            size, rows = [1, 1], [rectangle(channel, (0, 0), 0, 0, 1, 1) for channel in CHANNELS]
        else:
            size, rows = (panel.subpixel_cell, panel.subpixel) if kind == "custom" else PRESETS[kind]
        self.panel_size, self.size = np.array(panel.pixels), np.array(size)
        self.channel = np.array([CHANNELS.index(row["channel"]) for row in rows])
        self.pixel = np.array([row["pixel"] for row in rows])
        whole = np.array([row["rect"] for row in rows], float)
        if kind == "custom":
            _refuse_overlaps(self.size, whole)
        middle, half = (whole[:, :2] + whole[:, 2:]) / 2, (whole[:, 2:] - whole[:, :2]) / 2
        self.low, self.high = middle - half * math.sqrt(panel.aperture_ratio), middle + half * math.sqrt(panel.aperture_ratio)
        area = (self.high - self.low).prod(axis=1)
        self.gain = np.array([self.size.prod() / area[self.channel == c].sum() for c in range(3)])

    def met(self, channel, x, y):
        """The rectangle of a channel at points of the panel's plane: (its number, column, row of the pixel that it shows), all -1 where there is none.

        Columns and rows are those of the lattice of pixels without end: shown() tells which are the panel's.
        """
        at = np.column_stack([x, y])
        found = np.full((3, len(at)), -1)
        for k in np.flatnonzero(self.channel == channel):
            cell = np.floor((at - self.low[k]) / self.size)
            inside = (at - cell * self.size < self.high[k]).all(axis=1)
            pixel = (cell[inside] * self.size + self.pixel[k]).astype(np.int64)
            found[:, inside] = np.full(inside.sum(), k), *pixel.T
        return found

    def shown(self, number, column, row):
        """Whether what met() found shows a pixel of the panel."""
        columns, rows = self.panel_size
        return (number >= 0) & (column >= 0) & (column < columns) & (row >= 0) & (row < rows)

    def centroids(self, channel, columns, rows):
        """(points (n, 2), shows (n,)): the centres of gravity of a channel's rectangles that show these pixels, and whether there is any."""
        pixel = np.column_stack([columns, rows])
        mine, area = self.channel == channel, (self.high - self.low).prod(axis=1)
        weight = np.where(mine & (self.pixel == (pixel % self.size)[:, None]).all(axis=2), area, 0.0)  # (n, rectangles)
        total = weight.sum(axis=1)
        middle = weight @ ((self.low + self.high) / 2) / np.where(total > 0, total, 1.0)[:, None]
        return pixel - pixel % self.size + middle, total > 0


def _refuse_overlaps(size, rects):
    """No rectangle may overlap another one or a repetition of any."""
    for k, a in enumerate(rects):
        for b in rects[k:]:
            reach = np.ceil((np.abs(a).max() + np.abs(b).max()) / size).astype(int)
            steps = np.array(list(np.ndindex(*(2 * reach + 1)))) - reach
            moved = b + np.tile(steps * size, 2)
            shared = (np.minimum(a[2:], moved[:, 2:]) - np.maximum(a[:2], moved[:, :2]) > 1e-9).all(axis=1).sum()
            if shared > np.shares_memory(a, b):  # once with itself
                raise ValueError(f"subpixels overlap: {a} and {b}")
