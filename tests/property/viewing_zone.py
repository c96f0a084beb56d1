"""The viewing zone: of the lines of sight that get through a lens, how many end on a pixel of that lens's own elemental image; where fewer than a share do."""
import math

import numpy as np

import oracle
from edges import Unsure, both_edges
from sight import per_set


OF_TWO_LENSES = 1e-4  # share of lines that end on pixels with centres on the border of two images: with more the form does not tell


def right_share(sight, eye):
    """For each set the share of lines through lenses whose image has its middle on the panel that end on a pixel whose centre lies in their own elemental images."""
    hits = sight.see(eye)
    passed = ((hits.status == oracle.PANEL) | (hits.status == oracle.OFF_PANEL)) & (hits.lens[:, 0] >= 0)
    middle = sight.centres(hits.lens) if not sight.display.strips else hits.at - hits.off[:, :1] * sight.axes[0]
    passed &= sight.on_screen(eye) & (np.abs(middle) <= sight.half_panel).all(axis=1)
    centre = oracle.pixel_centres(sight.display, hits.column, hits.row)
    if (sight.between_lenses(centre) & passed).sum() > OF_TWO_LENSES * passed.sum():
        raise Unsure
    off = (centre - sight.centres(hits.lens)) @ sight.axes.T
    own = (hits.column >= 0) & sight.holds(off)
    with np.errstate(invalid="ignore"):
        return per_set((passed & own).astype(float)) / per_set(passed.astype(float))


def zone_deg(sight, axis, distance, wrong, hint):
    """((low, error), (high, error)) in degrees from the rear principal plane for eyes in the plane z = distance; at most a share `wrong` is wrong."""
    above = distance - sight.display.paraxial.rear
    step = above * math.tan(math.radians(hint)) / 12  # few lenses make steps and dips of the share

    def degrees(edge):
        return edge and (math.degrees(math.atan(edge[0] / above)), math.degrees(edge[1] * above / (above**2 + edge[0] ** 2)))

    towards = np.eye(3)[axis]  # the display's x or y
    edges = both_edges(lambda x: right_share(sight, x * towards + [0.0, 0.0, distance]), 1 - wrong, step, 60 * step)
    return tuple(degrees(e) for e in edges)
