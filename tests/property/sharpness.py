"""Modulation transfer in a plane at a depth: how far what is seen along a line of sight lies from where that line meets the plane.

A panel pixel, or subpixel, shows what its lens's nodal line meets in the plane. The distances between that and the line of sight are the line spread function; its
Fourier transform is the modulation transfer function.
"""
import math

import numpy as np

import oracle
from colours import LUMINANCE
from edges import SURE, Unsure, error_of
from sight import SETS

STEPS = 400        # frequencies tried between 0 and the greatest, at least,
STEPS_A_TURN = 20  # and in the frequency that turns once over the line spread: the transform bends no faster


def differences(sight, white, eye, depth, channel):
    """(SETS, n, 2) mm by which what a channel shows lies from lines of sight in the plane `depth` before the vertex plane, and the light (SETS, n) there.

    What a subpixel shows is what the nodal line of its pixel's middle in that channel meets. Pixels of no elemental image are black whatever is shown.
    """
    d, plane, off, lit = sight.display, sight.display.vertex_plane + depth, [], []
    seen = eye[:2] + (sight.aim[:, :2] - eye[:2]) * ((eye[2] - plane) / (eye[2] - d.vertex_plane))
    for light, column, row in white.shining(channel):
        points, shows = oracle.subpixel_points(d, channel, column, row)
        line = oracle.nodal_lines(d, points)
        shown = line.start[:, :2] + line.slope * (plane - d.paraxial.rear) - seen
        off.append((shown @ sight.axes.T if d.strips else shown).reshape(SETS, -1, 2))
        lit.append(np.where(line.owned & shows, light, 0.0).reshape(SETS, -1))
    return np.concatenate(off, axis=1), np.concatenate(lit, axis=1)


def together(spreads):
    """The line spread of the luminance, of those of red, green and blue."""
    return np.concatenate([off for off, _ in spreads], axis=1), np.concatenate([w * light for w, (_, light) in zip(LUMINANCE, spreads)], axis=1)


def from_green(spread, green, axis):
    """(how far a channel's line spread lies from green's in the mean, error)."""
    (by, light), (green_by, green_light) = ((off[:, :, axis], light) for off, light in (spread, green))
    sets = (light * by).sum(axis=1) / light.sum(axis=1) - (green_light * green_by).sum(axis=1) / green_light.sum(axis=1)
    return sets.mean(), error_of(sets)


MOST_OF_SCREEN = 0.2  # that a line may be spread over for its edges to stand clear of each other


def mtf50(sight, spread, eye, depth, axis, greatest):
    """(the least frequency per mm at which modulation falls below a half, its error), None if it does not up to `greatest`.

    Along the display's x (axis 0) or y (1), of strips along their x'.
    """
    by, light = spread[0][:, :, axis], spread[1]
    low, high = np.quantile(by[light > 0], [0.05, 0.95]) if light.any() else (0.0, math.inf)
    if high - low > MOST_OF_SCREEN * sight.display.array.count[axis] * sight.pitch[axis] * (1 - depth / eye[2]):
        raise Unsure
    if not light.any(axis=1).all():  # a set that meets no light tells nothing, and neither does what they differ by
        raise Unsure

    step = min(greatest / STEPS, 1 / (STEPS_A_TURN * max(high - low, 1e-300)))
    turn, wave, whole = np.exp(2j * np.pi * step * by), light.astype(complex), light.sum(axis=1)
    curves = []  # modulation at each step: its mean, the least and the most that it may be
    for _ in range(math.ceil(greatest / step)):
        wave *= turn
        sets = np.abs(wave.sum(axis=1)) / whole
        curves.append([sets.mean() + k * error_of(sets) for k in (0, -SURE, SURE)])
        if curves[-1][-1] < 0.5:
            break
    value, least, most = (falls_below_half(step, curve) for curve in np.array(curves).T)
    if value is None:
        return None
    if least is None or most is None:  # it may touch a half and rise again
        raise Unsure
    return value, max(value - least, most - value) / SURE + 0.02 * step


def falls_below_half(step, curve):
    """The frequency where a curve, at step, 2 step and so on, first does so, after its first value; None if it never does."""
    below = curve < 0.5
    if below[0] or not below.any():
        return None
    k = below.argmax()
    return step * (k + (curve[k - 1] - 0.5) / (curve[k - 1] - curve[k]))
