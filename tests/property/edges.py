"""Where a share of lines of sight, about 1 in the middle, falls to a level: the nearest such place on either side."""
import math

import numpy as np

AT_LEVEL = 2  # as many steps may lie near the level before an edge
SURE = 3  # standard errors: what lies nearer to the level than these is not known to be on either side


class Unsure(Exception):
    """The form's own error is too large to say whether there is an edge."""


def edge(share, level, step, limit):
    """The least x > 0 at which the mean of share(x), an array over sets of lines, falls below `level`: (x, its error), or None if it is below it at 0.

    Searched outwards in steps, to `limit`; share may contain nan where there is nothing to see. None, too, if no edge is found. A share that stays near the level
    over several steps leaves the edge unsure.
    """
    here, before = share(0.0), 0.0
    middle = here.mean()
    if np.isnan(here).all():
        return None
    if math.isnan(middle):  # sets that see nothing tell nothing
        raise Unsure
    if abs(middle - level) < SURE * error_of(here) + 1e-9:
        raise Unsure
    if middle < level:
        return None
    x, near = step, 0  # steps in a row
    while x < limit:
        now = share(x)
        if not now.mean() >= level:
            if near > AT_LEVEL or is_near(now, level) and is_near(share(x + step), level):
                raise Unsure
            return refine(share, level, before, here, x, now)
        near = near + 1 if is_near(now, level) else 0
        before, here, x = x, now, x + step
    return None


def is_near(share, level):
    return abs(share.mean() - level) < SURE * error_of(share)


def refine(share, level, low, at_low, high, at_high):
    """Narrows [low, high] by false position and halving in turn."""
    for turn in range(12):
        a, b = at_low.mean() - level, level - at_high.mean()
        part = 0.5 if turn % 2 or not b > 0 else min(max(a / (a + b), 0.05), 0.95)
        x = low + part * (high - low)
        now = share(x)
        if now.mean() >= level:
            low, at_low = x, now
        else:
            high, at_high = x, now
        if high - low < 1e-3 * high:
            break
    x = (low + high) / 2
    wide = 0.02 * x
    below, above = share(x - wide), share(x + wide)
    slope = (below.mean() - above.mean()) / (2 * wide)
    if not slope > 0:
        raise Unsure
    spread = 0.5 * (error_of(below) + error_of(above))
    return x, spread / slope + (high - low) / 2


def error_of(sets):
    """Standard error of the mean over sets."""
    return sets.std(ddof=1) / np.sqrt(len(sets))


def both_edges(share, level, step, limit):
    """((low, error), (high, error)) about 0, each None where there is none."""
    low, high = edge(lambda x: share(-x), level, step, limit), edge(share, level, step, limit)
    return low and (-low[0], low[1]), high
