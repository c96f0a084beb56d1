"""Modulation transfer in a plane at a depth: how far what is seen along a line of sight lies from where that line meets the plane.

A panel pixel shows what its lens's nodal line meets in the plane. The distances between that and the line of sight are the line spread function; its
Fourier transform is the modulation transfer function.
"""
import math

import numpy as np

import oracle
from edges import Unsure, error_of
from sight import SETS

STEPS = 400  # frequencies tried between 0 and the greatest


def differences(sight, eye, depth):
    """(n, 2) mm by which the nodal lines of the pixels seen pass the lines of sight in the plane `depth` before the vertex plane, and their light.

    Pixels of no elemental image have none: they are black whatever is shown.
    """
    d, hits = sight.display, sight.see(eye)
    pixel = np.column_stack([hits.column + 0.5, -(hits.row + 0.5)]) * d.panel.pixel_pitch_mm + [-sight.half_panel[0], sight.half_panel[1]]
    line, plane = oracle.nodal_lines(d, pixel), d.vertex_plane + depth
    owned = (hits.column >= 0) & line.owned
    shown = line.start[:, :2] + line.slope * (plane - d.paraxial.rear)
    seen = eye[:2] + (sight.aim[:, :2] - eye[:2]) * ((eye[2] - plane) / (eye[2] - d.vertex_plane))
    return shown - seen, np.where(owned, hits.weight * hits.cosine**d.panel.emission_exponent, 0.0)


MOST_OF_SCREEN = 0.2  # that a line may be spread over for its edges to stand clear of each other


def mtf50(sight, eye, depth, axis, greatest):
    """(the least frequency per mm at which modulation falls below a half, its error), None if it does not up to `greatest`.

    Along the display's x (axis 0) or y (1), of strips along their x'.
    """
    by, light = differences(sight, np.asarray(eye, float), depth)
    by = by @ sight.axes.T if sight.display.strips else by
    low, high = np.quantile(by[light > 0][:, axis], [0.05, 0.95]) if light.any() else (0.0, math.inf)
    if high - low > MOST_OF_SCREEN * sight.display.array.count[axis] * sight.pitch[axis] * (1 - depth / eye[2]):
        raise Unsure
    by, light = (v.reshape(SETS, -1) for v in (by[:, axis], light))

    def modulation(frequency):
        return np.abs((light * np.exp(2j * np.pi * frequency * by)).sum(axis=1)) / light.sum(axis=1)

    frequencies = np.linspace(0, greatest, STEPS)[1:]
    before = None
    for frequency in frequencies:
        now = modulation(frequency)
        if now.mean() < 0.5:
            break
        before = now
    else:
        return None
    if before is None:
        return None
    step = frequencies[1] - frequencies[0]
    fall = before.mean() - now.mean()
    return frequency - step * (0.5 - now.mean()) / fall, step * max(error_of(now), error_of(before)) / fall + 0.02 * step
