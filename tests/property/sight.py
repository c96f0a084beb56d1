"""Lines of sight: from an eye through points spread over the array's rectangle to the panel, and whose elemental image each ends on.

Lengths in mm in the display's frame; x', y' are the array's axes. Points lie evenly but shifted at random, several sets of them: what the sets differ by
is the error of their mean.
"""
import copy

import numpy as np

import oracle

SETS = 16
BORDER = 1e-9  # of a lens pitch
_ROOT = {2: 1.32471795724, 4: 1.16730397826, 6: 1.11277568428}  # positive roots of x^(d+1) = x + 1: lattices that fill d dimensions evenly


def even_points(n, dimensions, seed):
    """(SETS, n, dimensions) numbers in [0, 1)."""
    steps = _ROOT[dimensions] ** -np.arange(1.0, dimensions + 1)
    shift = np.random.default_rng([7, seed]).random((SETS, 1, dimensions))
    return (shift + np.arange(n)[:, None] * steps) % 1


class Sight:
    """What eyes see of a display through n lines in each set; with_diffuser: turned by its angles, too. middle_half: of the lenses across and up alone.

    blocks: for each line of a set the first lens, across and up, of those that it may go through, and their number: two arrays (n, 2). Strips are cut into squares,
    which count as lenses here.
    """

    def __init__(self, display, viewing_distance, n, seed, with_diffuser=False, middle_half=False, blocks=None):
        self.display = display if with_diffuser else without_diffuser(display)
        d = self.display
        u = even_points(n, 6, seed).reshape(-1, 6)
        self.half_panel = np.array(d.panel.pixels) * d.panel.pixel_pitch_mm / 2
        self.lattice = oracle.Lattice(d)
        self.axes = self.lattice.turn[:2, :2].T  # rows: x' and y' in x and y
        count, self.pitch = np.array(d.array.count), np.array(d.array.pitch_mm)
        if d.strips:  # one row, as long as the panel reaches along it
            self.pitch[1] = 2 * np.abs(self.axes[1]) @ self.half_panel
        self.lenses = count  # of blocks
        if d.strips:
            self.lenses = np.array([count[0], max(round(self.pitch[1] / self.pitch[0]), 1)])
        first = count // 4 if middle_half else np.zeros(2)
        first, number = (np.tile(part, (SETS, 1)) for part in blocks) if blocks else (first, count - 2 * first)
        self.in_cell = u[:, 2:4]  # places within a cell's box, from its corner, in pitches
        lens = (first + np.floor(u[:, :2] * number)).astype(np.int64)
        if blocks and d.strips:
            self.in_cell[:, 1] = (lens[:, 1] + self.in_cell[:, 1]) / self.lenses[1]
            lens[:, 1] = 0
        axis, within = self.lattice.axis(lens[:, 0], lens[:, 1]), np.column_stack([(self.in_cell - 0.5) * self.pitch, np.zeros(len(u))])
        if d.array.lattice == "hexagon" and not middle_half:  # the box's corners are other hexagons': the same place in this one
            i, j, _ = self.lattice.cell(axis + within)
            within = axis + within - self.lattice.axis(i, j)
        self.aim = self.lattice.leave(axis + within, np.zeros_like(within))[0]
        if d.errors:  # over the array as it is built
            built = oracle.MovedLattice(d)
            self.aim = built.leave(built.axis(lens[:, 0], lens[:, 1]) + within + [0.0, 0.0, d.vertex_plane], np.zeros_like(within))[0]
        self.aim[:, 2] = d.vertex_plane
        self.turns = diffuser_turns(d.diffuser, u[:, 4:]) if d.diffuser else None
        self.stretch = 1 + d.gap / (viewing_distance - d.paraxial.rear)  # of elemental images against lenses

    def on_screen(self, eye, share=1.0):
        """Whether the straight lines from the eye to the points aimed at go on to the panel's rectangle, or to this share of its width and height."""
        eye = np.broadcast_to(np.asarray(eye, float), self.aim.shape)
        on = self.aim[:, 2:] / (eye[:, 2:] - self.aim[:, 2:])
        return (np.abs(self.aim[:, :2] + on * (self.aim[:, :2] - eye[:, :2])) <= share * self.half_panel).all(axis=1)

    def centres(self, lens):
        """(n, 2) centres of the elemental images of lenses (n, 2), counted from 0, on the panel."""
        axis = self.lattice.axis(lens[:, 0], lens[:, 1])
        return self.stretch * self.lattice.leave(axis, np.zeros_like(axis))[0][:, :2]

    def whole(self, hits):
        """Whether the elemental images of the lenses met lie on the panel as a whole; of strips the part beside the place that is seen."""
        centre = self.centres(hits.lens) if not self.display.strips else hits.at - hits.off[:, :1] * self.axes[0]
        half = self.stretch * self.display.cell.extent @ np.abs(self.axes)  # of the box about the turned image
        return (hits.lens[:, 0] >= 0) & (np.abs(centre) + half <= self.half_panel * (1 + 1e-12)).all(axis=1)

    def between_lenses(self, points):
        """Whether panel points (n, 2) lie, within rounding, on the border of two elemental images: which has them is not known."""
        low, high = (oracle.nodal_lines(self.display, points + side * BORDER * self.pitch[0]) for side in (-1, 1))
        return (low.lens != high.lens).any(axis=1) | (low.owned != high.owned)

    def holds(self, off):
        """Whether places (n, 2), along x' and y' from the centre of an elemental image, lie in that image."""
        return self.lattice.in_cell(off / self.stretch, 0.0)

    def see(self, eye, display=None):
        """The rays from an eye (x, y, z): the tracer's hits with `at`, where they end on the panel (n, 2), and `off`, at from the centre along x' and y'.

        eye: one for all lines, or (n, 3). display: in light of another colour.
        """
        hits = oracle.trace(display or self.display, np.broadcast_to(np.asarray(eye, float), self.aim.shape), self.aim - eye, self.turns)
        pitch = self.display.panel.pixel_pitch_mm
        hits.at = np.column_stack([hits.x, -hits.y]) * pitch + [-self.half_panel[0], self.half_panel[1]]
        hits.off = (hits.at - self.centres(hits.lens)) @ self.axes.T * self.lattice.across
        return hits

    def on_arc(self, angle, axis, radius):
        """The eye that the panel's normal turned by `angle` (radians) towards x' (axis 0) or y' (axis 1) points at."""
        return np.append(radius * np.sin(angle) * self.axes[axis], radius * np.cos(angle))


def without_diffuser(display):
    bare = copy.copy(display)
    bare.diffuser = None
    return bare


def diffuser_turns(diffuser, u):
    """Angles (about y, about x) in radians of numbers u in [0, 1)."""
    full = np.radians(diffuser.angle_deg)
    if diffuser.profile == "box":
        return (u - 0.5) * full
    return normal_quantile(u) * full / np.sqrt(8 * np.log(2))  # the cut at 89 degrees is beyond 3.7 full widths of all that is drawn


def normal_quantile(u):
    """The inverse of the normal distribution's integral, by a table of the integral (Simpson's rule) between -7 and 7."""
    return np.interp(u, _INTEGRAL, _QUANTILES)


_QUANTILES = np.linspace(-7, 7, 14001)
_DENSITY = np.exp(-_QUANTILES**2 / 2) / np.sqrt(2 * np.pi)
_INTEGRAL = np.concatenate([[0.0], np.cumsum((_DENSITY[1:] + _DENSITY[:-1]) / 2 * 1e-3)])


def per_set(values):
    """Sums over each set."""
    return values.reshape(SETS, -1).sum(axis=1)
