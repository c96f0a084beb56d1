"""Lines of sight: from an eye through points spread over the array's rectangle to the panel, and whose elemental image each ends on.

Lengths in mm in the display's frame; x', y' are the array's axes. Points lie evenly but shifted at random, several sets of them: what the sets differ by
is the error of their mean.
"""
import copy

import numpy as np

import oracle

SETS = 16
_ROOT = {2: 1.32471795724, 4: 1.16730397826, 6: 1.11277568428}  # positive roots of x^(d+1) = x + 1: lattices that fill d dimensions evenly


def even_points(n, dimensions, seed):
    """(SETS, n, dimensions) numbers in [0, 1)."""
    steps = _ROOT[dimensions] ** -np.arange(1.0, dimensions + 1)
    shift = np.random.default_rng([7, seed]).random((SETS, 1, dimensions))
    return (shift + np.arange(n)[:, None] * steps) % 1


class Sight:
    """What eyes see of a display through n lines in each set; with_diffuser: turned by its angles, too. middle_half: of the lenses across and up alone."""

    def __init__(self, display, viewing_distance, n, seed, with_diffuser=False, middle_half=False):
        self.display = display if with_diffuser else without_diffuser(display)
        d = self.display
        u = even_points(n, 6, seed).reshape(-1, 6)
        turn = np.radians(d.array.rotation_deg)
        self.axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])  # rows: x' and y' in x and y
        count, self.pitch = np.array(d.array.count), d.array.pitch_mm
        first = count // 4 if middle_half else np.zeros(2)
        self.in_cell = u[:, 2:4]  # places within a cell, from its corner, in pitches
        places = (first + np.floor(u[:, :2] * (count - 2 * first)) + self.in_cell - count / 2) * self.pitch
        self.aim = np.column_stack([places @ self.axes + d.array.offset_mm, np.full(len(u), d.vertex_plane)])
        self.turns = diffuser_turns(d.diffuser, u[:, 4:]) if d.diffuser else None
        self.stretch = 1 + d.paraxial.front / (viewing_distance - d.paraxial.rear)  # of elemental images against lenses
        self.half_panel = np.array(d.panel.pixels) * d.panel.pixel_pitch_mm / 2

    def centres(self, lens):
        """(n, 2) centres of the elemental images of lenses (n, 2), counted from 0, on the panel."""
        places = (lens + 0.5 - np.array(self.display.array.count) / 2) * self.pitch
        return self.stretch * (places @ self.axes + self.display.array.offset_mm)

    def whole(self, lens):
        """Whether the elemental images of these lenses lie on the panel as a whole."""
        half = 0.5 * self.stretch * self.pitch @ np.abs(self.axes)  # of the box about the turned image
        return (lens[:, 0] >= 0) & (np.abs(self.centres(lens)) + half <= self.half_panel * (1 + 1e-12)).all(axis=1)

    def see(self, eye):
        """The rays from an eye (x, y, z): the tracer's hits with `at`, where they end on the panel (n, 2), and `off`, at from the centre along x' and y'."""
        hits = oracle.trace(self.display, np.broadcast_to(np.asarray(eye, float), self.aim.shape), self.aim - eye, self.turns)
        pitch = self.display.panel.pixel_pitch_mm
        hits.at = np.column_stack([hits.x, -hits.y]) * pitch + [-self.half_panel[0], self.half_panel[1]]
        hits.off = (hits.at - self.centres(hits.lens)) @ self.axes.T
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
