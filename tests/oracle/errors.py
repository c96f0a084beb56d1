"""Errors of an array and of each lens: what a description says of them, and where each lens then is. Lengths in mm.

Three frames: the display's; the array's, in which its centre is on the z axis and a perfect lens stands upright at its place;
the lens's own, in which every lens is the perfect one about x = y = 0. z = 0 is the perfect panel plane in all of them.
"""
import copy
import csv
from types import SimpleNamespace

import numpy as np

from lattice import Lattice, turn_matrix

COLUMNS = ("dx_mm", "dy_mm", "dz_mm", "tilt_x_deg", "tilt_y_deg", "curvature")
DRAWN = ("decenter_sd_mm", "height_sd_mm", "tilt_sd_deg", "curvature_sd")
OF_ARRAY = {"shift_mm": [0.0, 0.0], "gap_mm": 0.0, "rotation_deg": 0.0, "pitch_ppm": 0.0, "wedge_deg": [0.0, 0.0], "bow_mm": 0.0}


def read_table(path):
    """The rows of a table of lenses (CSV, columns in any order), as dicts of numbers."""
    with open(path, newline="", encoding="utf-8") as file:
        return [{name: int(value) if name in "ij" else float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def write_table(path, rows):
    """Rows as `read_table` gives them; what a row does not name is 0."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ("i", "j", *COLUMNS), restval=0.0)
        writer.writeheader()
        writer.writerows(rows)


def of_display(given, d):
    """The errors of a resolved display d; None for a perfect one. given: the table `[errors]`, or None, with rows in
    place of the name of a file in `table`.

    Errors of the array have their keys' names; those of each lens are move (nx, ny, 3), tilt (nx, ny, 2) in radians about x' and y',
    bend (nx, ny).
    """
    if given is None or (d.array.surround == "clear" and not d.ideal and not any(map(np.any, given.values()))):
        return None
    if any(given.get(key) for key in DRAWN):
        raise ValueError("errors that are drawn come as a table from `lfdsim errors DISPLAY -o lenses.csv`")
    out = SimpleNamespace(**{key: given.get(key, default) for key, default in OF_ARRAY.items()})
    nx, ny = d.array.count
    table, seen = np.zeros((nx, ny, len(COLUMNS))), np.zeros((nx, ny), bool)
    for row in given.get("table", []):
        i, j = row["i"], row["j"]
        if not (0 <= i < nx and 0 <= j < ny) or seen[i, j]:
            raise ValueError(f"lens {i}, {j} is not one of {nx} by {ny}, or has two rows")
        table[i, j], seen[i, j] = [row.get(name, 0.0) for name in COLUMNS], True
    out.move, out.tilt, out.bend = table[:, :, :3], np.radians(table[:, :, 3:5]), table[:, :, 5]
    _refuse(out, d)
    return out


def _refuse(e, d):
    """What no display of this kind can have."""
    level = not any((e.gap_mm, e.bow_mm, np.any(e.wedge_deg), e.move[:, :, 2].any(), e.tilt.any()))
    plate = d.array.surround == "plate" and not d.ideal
    for wrong, what in ((d.strips and (e.move[:, :, 1].any() or e.tilt[:, :, 0].any()), "strips: dy_mm, tilt_x_deg"),
                        (d.glued and not level, "glued lenses: height, tilt"), (plate and e.tilt.any(), "plate: tilt"), (d.lens.type == "pinhole" and e.bend.any(), "pinhole: curvature"),
                        (d.array.surround == "clear" and not d.ideal, "clear: any error")):
        if wrong:
            raise ValueError(f"no such errors here: {what}")


def about_x(v, angle):
    """Vectors (n, 3) turned about x by an angle in radians, or by one each."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([v[:, 0], c * v[:, 1] - s * v[:, 2], s * v[:, 1] + c * v[:, 2]], axis=1)


def about_y(v, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * v[:, 0] + s * v[:, 2], v[:, 1], c * v[:, 2] - s * v[:, 0]], axis=1)


class MovedLattice(Lattice):
    """A lattice whose lenses and whose own frame are moved by the display's errors.

    Pitch, staggered rows and cells are the stretched ones; what a lens is made of does not stretch.
    """

    def __init__(self, display):
        e = display.errors
        stretched = copy.copy(display)
        stretched.array = copy.copy(display.array)
        stretched.array.pitch_mm = display.array.pitch_mm * (1 + 1e-6 * e.pitch_ppm)
        super().__init__(stretched)
        self.errors, self.vertex = e, np.array([0.0, 0.0, display.vertex_plane])
        self.turn = turn_matrix(display.array) @ turn_matrix(SimpleNamespace(rotation_deg=e.rotation_deg))
        self.turn = about_y(about_x(self.turn.T, np.radians(e.wedge_deg[0])), np.radians(e.wedge_deg[1])).T
        self.centre = np.array([*np.add(display.array.offset_mm, e.shift_mm), display.vertex_plane + e.gap_mm])
        i, j = np.meshgrid(np.arange(self.nx), np.arange(self.ny), indexing="ij")
        half = 0.5 * np.hypot(*(self.pitch * [self.nx, self.ny] * self.across))
        from_centre = np.hypot(*np.moveaxis(self.axis(i, j)[:, :, :2], 2, 0))
        self.move = e.move.copy()  # of each lens's vertex in the array's frame, from where the stretched lattice has it
        self.move[:, :, 2] += e.bow_mm * (1 - (from_centre / half) ** 2)
        self._bound(display)

    def _bound(self, display):
        """How far a lens may reach beyond its place: to the sides (margin), and heights (low, high) between which all lenses are."""
        e, parts = self.errors, [s.bent(1 + np.array([self.errors.bend.min(), self.errors.bend.max()])) for s in display.surfaces]
        low, high = (min([s.z_min for s in parts], default=display.lens_z), max([s.z_max for s in parts], default=display.lens_z))
        semi = max([s.semi for s in parts], default=0.0) if not display.ideal else getattr(display.lens, "aperture_radius_mm", 0.0)
        across = max(semi, self.shape.corner if self.fills_cell else 0.0, display.stop_radius or 0.0)
        # The radius of a ball about the vertex, or of a cylinder about a strip's, that holds the lens:
        size = np.hypot(across, max(self.vertex[2] - low, high - self.vertex[2]))
        spread = 2 * size * min(np.hypot(*np.abs(e.tilt).max(axis=(0, 1))), 1.0)
        self.margin = np.hypot(*np.abs(self.move[:, :, :2]).max(axis=(0, 1))) + spread + 1e-6
        self.low, self.high = low + self.move[:, :, 2].min() - spread, high + self.move[:, :, 2].max() + spread

    def enter(self, o, d):
        return (o - self.centre) @ self.turn + self.vertex, d @ self.turn

    def leave(self, o, d):
        return (o - self.vertex) @ self.turn.T + self.centre, d @ self.turn.T

    def into_lens(self, o, d, i, j):
        """Points and directions of the array's frame in that of lenses (i, j)."""
        (tx, ty), q = self.errors.tilt[i, j].T, o - self.axis(i, j) - self.move[i, j] - self.vertex
        return about_x(about_y(q, -ty), -tx) + self.vertex, about_x(about_y(d, -ty), -tx)

    def upright(self):
        """The same lenses without their tilts, as a stop's holes stand."""
        out = copy.copy(self)
        out.errors = copy.copy(self.errors)
        out.errors.tilt = np.zeros_like(self.errors.tilt)
        return out

    def out_of_lens(self, v, i, j):
        """Directions (n, 3) in the frame of lenses (i, j) in the display's."""
        tx, ty = self.errors.tilt[i, j].T
        return about_y(about_x(v, tx), ty) @ self.turn.T

    def bent(self, surface, i, j):
        """A surface as each of the lenses (i, j) has it."""
        return surface.bent(1 + self.errors.bend[i, j])
