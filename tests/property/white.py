"""A white panel: how bright the array's rectangle is from before its middle."""
import numpy as np

from edges import error_of
from sight import SETS


def luminance(sight, eye):
    """(mean radiance over the rectangle against the panel's along its normal, its error)."""
    hits = sight.see(eye)
    light = np.where(hits.column >= 0, hits.weight * hits.cosine**sight.display.panel.emission_exponent, 0.0)
    sets = light.reshape(SETS, -1).mean(axis=1)
    return sets.mean(), error_of(sets)
