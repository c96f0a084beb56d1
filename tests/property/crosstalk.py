"""Crosstalk: how much of the light that an eye sees is meant for other views, or for the other eye. Leak over signal; the panel's black is 0.

A panel point P in the elemental image centred at e C is meant for the horizontal slope s = (e C - P)/g. View k is the strip with s within half a step of
k a/g.
"""
import numpy as np

import oracle
from edges import error_of
from sight import per_set
from white import radiance


def slopes(sight, eye):
    """s of each line of sight from an eye, and its light; light on no lens's image does not count."""
    d, hits = sight.display, sight.see(eye)
    meant = oracle.nodal_lines(d, hits.at)
    return (sight.centres(meant.lens) - hits.at)[:, 0] / d.gap, np.where(meant.owned, radiance(d, hits), 0.0)


def over(leak, signal):
    """In per cent, of sets: (value, error); None without signal."""
    leak, signal = per_set(leak), per_set(signal)
    if not signal.sum() > 0:
        return None
    share = leak.sum() / signal.sum()
    return 100 * share, 100 * error_of(leak - share * signal) / signal.mean()


def middle_view_percent(sight, distance):
    """Of an eye before the middle at z = distance: all other light over that of view 0."""
    s, light = slopes(sight, [0.0, 0.0, distance])
    step = sight.display.panel.pixel_pitch_mm / sight.display.gap
    meant = np.abs(s) <= 0.5 * step
    return over(light * ~meant, light * meant)


def eye_percent(sight, distance, side, between):
    """Of one of two eyes `between` mm apart, side -1 (left) or 1: light meant for the other side of the head over that for its own."""
    eye = np.append(0.5 * side * between * np.array([1.0, 0.0]), distance)
    s, light = slopes(sight, eye)
    return over(light * (side * s < 0), light * (side * s > 0))
