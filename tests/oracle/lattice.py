"""Which lenses a ray can meet: brute force over every lens near its path, so that none is missed at any angle."""
import numpy as np

from surface import EPS


class Lattice:
    """nx by ny lenses on a grid of squares or rectangles, in the array's own frame (its centre on the z axis, not rotated)."""

    def __init__(self, d):
        self.nx, self.ny = d.array.count
        self.pitch, self.fills_cell = d.array.pitch_mm, d.fills_cell
        turn, (ox, oy) = np.radians(d.array.rotation_deg), d.array.offset_mm
        self.turn = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])  # array -> display
        self.offset = np.array([ox, oy, 0.0])
        self.radius = 0.5 * np.hypot(*(self.pitch * d.array.count)) + max(self.pitch)  # of a circle about all lenses

    def enter(self, o, d):
        return (o - self.offset) @ self.turn, d @ self.turn

    def leave(self, o, d):
        return o @ self.turn.T + self.offset, d @ self.turn.T

    def axis(self, i, j):
        """The lens axes as (n, 3) points with z = 0."""
        x, y = (i + 0.5 - self.nx / 2) * self.pitch[0], (j + 0.5 - self.ny / 2) * self.pitch[1]
        return np.stack([x, y, np.zeros_like(x)], axis=1)

    def cell(self, p):
        """(i, j, on the array) of the cell that holds each point."""
        i = np.floor(p[:, 0] / self.pitch[0] + self.nx / 2).astype(np.int64)
        j = np.floor(p[:, 1] / self.pitch[1] + self.ny / 2).astype(np.int64)
        return i, j, (i >= 0) & (i < self.nx) & (j >= 0) & (j < self.ny)

    def in_aperture(self, p, semi, eps=EPS):
        """Points relative to a lens axis: inside the circle of radius semi and, where lenses fill their cells, inside the cell."""
        ok = p[:, 0] ** 2 + p[:, 1] ** 2 <= (semi + eps) ** 2
        return ok & (np.abs(p[:, :2]) <= 0.5 * self.pitch + eps).all(axis=1) if self.fills_cell else ok

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
        speed = np.hypot(d[:, 0], d[:, 1])
        with np.errstate(divide="ignore", invalid="ignore"):
            t1 = np.minimum(t1, np.where(speed > 0, (np.hypot(o[:, 0], o[:, 1]) + self.radius) / speed, np.inf))
            step = np.where(speed > 0, 1.5 * min(self.pitch) / speed, np.inf)
        a, active = t0.copy(), np.flatnonzero(t0 <= t1)
        while len(active):
            b = np.minimum(a[active] + step[active], t1[active])
            p, q = o[active] + a[active, None] * d[active], o[active] + b[:, None] * d[active]
            low, high = np.minimum(p, q)[:, :2] - reach - EPS, np.maximum(p, q)[:, :2] + reach + EPS
            half = np.array([self.nx, self.ny]) / 2
            first = np.maximum(np.ceil(low / self.pitch - 0.5 + half), 0).astype(np.int64)
            last = np.minimum(np.floor(high / self.pitch - 0.5 + half), [self.nx - 1, self.ny - 1]).astype(np.int64)
            wide = np.maximum(last - first + 1, 0)
            count = wide[:, 0] * wide[:, 1]
            owner = np.repeat(np.arange(len(active)), count)
            if len(owner):
                k = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
                i, j = first[owner, 0] + k % wide[owner, 0], first[owner, 1] + k // wide[owner, 0]
                ray = active[owner]
                t, m = hit(o[ray] - self.axis(i, j), d[ray], i, j)
                t = np.where(t <= b[owner] + EPS, t, np.inf)
                order = np.lexsort((t, owner))
                lead = order[np.r_[True, owner[order][1:] != owner[order][:-1]]]  # the nearest pair of each ray
                good = lead[np.isfinite(t[lead])]
                best[ray[good]], normal[ray[good]], bi[ray[good]], bj[ray[good]] = t[good], m[good], i[good], j[good]
            a[active] = b
            active = active[~np.isfinite(best[active]) & (b < t1[active])]
        return best, normal, bi, bj
