"""The field of view by own lenses, and the eyebox: how much of what is seen of whole elemental images is each lens's own, and where that is a half."""
import math

import numpy as np

from edges import both_edges
from sight import Sight, per_set


def own_share(sight, eye):
    """For each set the share, by transmitted light, of rays that end on their own lens's image: of those that end on the panel through lenses whose images are whole."""
    hits = sight.see(eye)
    light = np.where((hits.column >= 0) & sight.whole(hits), hits.weight, 0.0)
    own = sight.holds(hits.off)
    with np.errstate(invalid="ignore"):
        return per_set(light * own) / per_set(light)


def own_lens_deg(sight, axis, radius, hint):
    """((low, error), (high, error)) in degrees along x' or y'; the eye goes round the panel's centre at `radius`."""
    lowest = max(sight.display.vertex_plane, sight.display.diffuser.z if sight.display.diffuser else 0)
    limit = min(math.degrees(math.acos(lowest / radius)), 85)
    return both_edges(lambda deg: own_share(sight, sight.on_arc(math.radians(deg), axis, radius)), 0.5, hint / 4, limit)


def eyebox_mm(sight, axis, distance, hint):
    """(width, error) in the plane z = distance, or None."""
    step = distance * math.tan(math.radians(hint)) / 4
    edges = both_edges(lambda x: own_share(sight, np.append(x * sight.axes[axis], distance)), 0.5, step, 60 * step)
    if not all(edges):
        return None
    (low, low_error), (high, high_error) = edges
    return high - low, math.hypot(low_error, high_error)
