"""Where lenses stand and which of them a ray can meet: by search over every lens near its path, so that none is missed at any angle."""
import math
from types import SimpleNamespace

import numpy as np

from surface import EPS


def grid_pitch(lattice, pitch):
    """(2,): mm from lens to lens in a row and from row to row; pitch is one number or two. The one row of strips gets their pitch, too."""
    across, up = np.broadcast_to(np.asarray(pitch, float), 2)
    return np.array([across, up * math.sqrt(3) / 2 if lattice == "hexagon" else up])


def row_shift(lattice, pitch):
    """By how many mm odd rows, counted from 0 at the bottom, stand to the right and even ones to the left; pitch as grid_pitch gives it."""
    return pitch[0] / 4 if lattice in ("brick", "hexagon") else 0.0


def cell_shape(lattice, pitch):
    """The cell about a lens axis, {q: |q . n| <= half for all normals n}, in mm; pitch as grid_pitch gives it.

    normals (k, 2) and half (k,); extent (2,) its half width along x and y, 0 along strips; corner its circumradius, of strips half their
    width; width (2,) from side to side along x and y, of hexagons across opposite sides both times.
    """
    p = pitch[0]
    if lattice == "strips":
        return SimpleNamespace(normals=np.array([[1.0, 0.0]]), half=np.array([p / 2]), extent=np.array([p / 2, 0.0]), corner=p / 2, width=np.full(2, p))
    if lattice == "hexagon":
        turn = np.radians([0, 60, 120])
        corner = p / math.sqrt(3)
        return SimpleNamespace(normals=np.column_stack([np.cos(turn), np.sin(turn)]), half=np.full(3, p / 2), extent=np.array([p / 2, corner]), corner=corner,
                               width=np.full(2, p))
    corner = math.sqrt(np.mean(pitch**2)) / math.sqrt(2)  # of a square p / sqrt(2) to the last bit
    return SimpleNamespace(normals=np.eye(2), half=pitch / 2, extent=pitch / 2, corner=corner, width=pitch)


def turn_matrix(array):
    """(3, 3): a column vector in the array's frame to the display's. The upper ends of slanted strips lean to the right: a clockwise turn."""
    turn = np.radians(-array.slant_deg if hasattr(array, "slant_deg") else array.rotation_deg)
    return np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])


def least_count(array, panel):
    """[nx, ny]: the fewest lenses that cover the panel. array.pitch_mm as grid_pitch gives it."""
    half = np.array(panel.pixels) * panel.pixel_pitch_mm / 2
    corners = np.array([[sx * half[0], sy * half[1]] for sx in (-1, 1) for sy in (-1, 1)]) - array.offset_mm
    h = np.abs(corners @ turn_matrix(array)[:2, :2]).max(axis=0)  # the farthest corner along x' and y' of the array
    up = lambda v: max(math.ceil(v - 1e-9), 1)
    px, py = array.pitch_mm
    nx = up(2 * (h[0] + row_shift(array.lattice, array.pitch_mm)) / px)
    if array.lattice == "strips":
        return [nx, 1]
    if array.lattice == "hexagon":  # rows end in a zigzag: without gaps up to half a side above the uppermost axes
        return [nx, max(1 + math.ceil((2 * h[1] - px / math.sqrt(3)) / py - 1e-9), 1)]
    return [nx, up(2 * h[1] / py)]


class Lattice:
    """nx by ny lenses in the array's own frame: its centre on the z axis, its rows along x. Strips lie along y without end."""

    margin = 0.0  # mm by which a lens may reach farther than where it should stand

    def __init__(self, d):
        self.nx, self.ny = d.array.count
        self.pitch, self.fills_cell = d.array.pitch_mm, d.fills_cell
        self.shift, self.shape = row_shift(d.array.lattice, self.pitch), cell_shape(d.array.lattice, self.pitch)
        self.across = np.array([1.0, 0.0 if d.array.lattice == "strips" else 1.0])  # which of x and y tell lenses apart
        self.turn, self.offset = turn_matrix(d.array), np.array([*d.array.offset_mm, 0.0])
        self.radius = 0.5 * np.hypot(*(self.pitch * d.array.count * self.across)) + max(self.pitch)  # of a circle about all lenses

    def enter(self, o, d):
        """Points and directions (n, 3) of the display's frame in the array's."""
        return (o - self.offset) @ self.turn, d @ self.turn

    def leave(self, o, d):
        """The way back."""
        return o @ self.turn.T + self.offset, d @ self.turn.T

    def axis(self, i, j):
        """The lens axes as points (..., 3) with z = 0."""
        x = (i + 0.5 - self.nx / 2) * self.pitch[0] + np.where(j % 2 == 1, self.shift, -self.shift)
        return np.stack([x, (j + 0.5 - self.ny / 2) * self.pitch[1] * self.across[1], np.zeros_like(x)], axis=-1)

    def into_lens(self, o, d, i, j):
        """Points and directions (n, 3) of the array's frame in those of lenses (i, j)."""
        return o - self.axis(i, j), d

    def _about(self, p, on_array):
        """The nearest lenses of each point's own row and of the rows beside it: i, j (rows, n) and the point from their axes (rows, n, 3).

        on_array: lenses that exist; otherwise those of a lattice without end.
        """
        beside = np.array([[0], [-1], [1]] if self.shift else [[0]])
        j = np.rint(p[:, 1] * self.across[1] / self.pitch[1] + (self.ny - 1) / 2).astype(np.int64) + beside
        j = np.clip(j, 0, self.ny - 1) if on_array else j
        i = np.rint((p[:, 0] - np.where(j % 2 == 1, self.shift, -self.shift)) / self.pitch[0] + (self.nx - 1) / 2).astype(np.int64)
        i = np.clip(i, 0, self.nx - 1) if on_array else i
        return i, j, p - self.axis(i, j)

    def cell(self, p):
        """(i, j, on the array) of the cell that holds each point."""
        i, j, q = self._about(p, on_array=False)
        k = (np.abs(q[:, :, :2] @ self.shape.normals.T) / self.shape.half).max(axis=2).argmin(axis=0)
        i, j = (v[k, np.arange(len(p))] for v in (i, j))
        return i, j, (i >= 0) & (i < self.nx) & (j >= 0) & (j < self.ny)

    def to_nearest_axis(self, p):
        """mm from each point to the nearest lens axis of the array."""
        return np.sqrt((self._about(p, on_array=True)[2][:, :, :2] ** 2 @ self.across).min(axis=0))

    def in_cell(self, q, eps=EPS):
        """Points relative to a lens axis."""
        return (np.abs(q[:, :2] @ self.shape.normals.T) <= self.shape.half + eps).all(axis=1)

    def in_aperture(self, q, semi, eps=EPS):
        """Points relative to a lens axis: inside the circle of radius semi (strips: |x| <= semi) and, where lenses fill their cells, inside the cell."""
        ok = q[:, :2] ** 2 @ self.across <= (semi + eps) ** 2
        return ok & self.in_cell(q, eps) if self.fills_cell else ok

    def in_any_aperture(self, p, semi, eps=0.0):
        """Points of the array's frame: inside the aperture of a lens. A circle lies inside its cell, so one look is enough."""
        i, j, on = self.cell(p)
        return on & self.in_aperture(p - self.axis(i, j), semi, eps)

    def first_hit(self, o, d, t0, t1, reach, hit):
        """The nearest hit of each ray among the lenses it passes for t0 <= t <= t1.

        hit(o, d, i, j) gets ray-lens pairs in the lens's frame and returns (t, normal), t = inf for a miss. A lens can be met only
        within `reach` of its axis in x and in y. Returns (t, normal, i, j). The path is cut into short pieces, so that a flat ray across a
        big array tests few lenses at a time.
        """
        n = len(o)
        best, normal = np.full(n, np.inf), np.zeros((n, 3))
        bi, bj = np.zeros(n, np.int64), np.zeros(n, np.int64)
        flat_o, flat_d = o[:, :2] * self.across, d[:, :2] * self.across
        speed = np.hypot(*flat_d.T)
        with np.errstate(divide="ignore", invalid="ignore"):
            t1 = np.minimum(t1, np.where(speed > 0, (np.hypot(*flat_o.T) + self.radius + self.margin) / speed, np.inf))
            step = np.where(speed > 0, 1.5 * min(self.pitch) / speed, np.inf)
        a, active = t0.copy(), np.flatnonzero(t0 <= t1)
        half, slack = np.array([self.nx, self.ny]) / 2, reach + self.margin + EPS + np.array([self.shift, 0.0])
        while len(active):
            b = np.minimum(a[active] + step[active], t1[active])
            p, q = flat_o[active] + a[active, None] * flat_d[active], flat_o[active] + b[:, None] * flat_d[active]
            low, high = np.minimum(p, q) - slack, np.maximum(p, q) + slack
            first = np.maximum(np.ceil(low / self.pitch - 0.5 + half), 0).astype(np.int64)
            last = np.minimum(np.floor(high / self.pitch - 0.5 + half), [self.nx - 1, self.ny - 1]).astype(np.int64)
            wide = np.maximum(last - first + 1, 0)
            count = wide[:, 0] * wide[:, 1]
            owner = np.repeat(np.arange(len(active)), count)
            if len(owner):
                k = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
                i, j = first[owner, 0] + k % wide[owner, 0], first[owner, 1] + k // wide[owner, 0]
                ray = active[owner]
                t, m = hit(*self.into_lens(o[ray], d[ray], i, j), i, j)
                t = np.where(t <= b[owner] + EPS, t, np.inf)
                order = np.lexsort((t, owner))
                lead = order[np.r_[True, owner[order][1:] != owner[order][:-1]]]  # the nearest pair of each ray
                good = lead[np.isfinite(t[lead])]
                best[ray[good]], normal[ray[good]], bi[ray[good]], bj[ray[good]] = t[good], m[good], i[good], j[good]
            a[active] = b
            active = active[~np.isfinite(best[active]) & (b < t1[active])]
        return best, normal, bi, bj
