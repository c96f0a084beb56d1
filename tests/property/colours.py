"""A white panel in red, green and blue: each channel seen where it shines, in its own light. And colours' distances."""
import math

import numpy as np

import oracle
from edges import SURE, error_of
from sight import SETS
from white import radiance

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # of linear red, green and blue
XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])  # IEC 61966-2-1
ON_SCREEN = 0.5  # parts of which less is in front of the panel have no figure of their own
DARK = 0.1  # of the mean luminance: parts that are darker have no colour


class White:
    """What an eye, or an eye for each line, sees of it along lines of sight."""

    def __init__(self, sight, eye):
        self.display = sight.display
        self.traced = [(shares, sight.see(eye, display)) for shares, display in self.display.colours]

    def shining(self, channel):
        """(light, column, row) of each wavelength in a channel: light is 0 where the channel does not shine; column and row of the pixel shown."""
        subpixels = self.display.subpixels
        for shares, hits in self.traced:
            if shares[channel]:
                met = subpixels.met(channel, hits.x, hits.y)
                light = shares[channel] * subpixels.gain[channel] * radiance(self.display, hits)
                yield np.where(subpixels.shown(*met), light, 0.0), met[1], met[2]


def has_colours(display):
    """Whether colours have light paths, or places on the panel, of their own."""
    return display.panel.subpixels != "none" or len(display.colours) > 1


def blocks_of_screen(count, most=48):
    """(first lenses (n, 2), their numbers (n, 2)) of blocks of as few whole lenses as make no more than `most` along the longer side."""
    together = -(-count.max() // most)
    parts = np.maximum(count // together, 1)
    parts -= (count % 2 == 1) & (parts % 2 == 0)
    borders = []
    for lenses, blocks in zip(count.tolist(), parts.tolist()):  # symmetric about the middle
        half = [math.floor(k * lenses / blocks + 0.5) for k in range((blocks + 1) // 2)]
        middle = [lenses // 2] if blocks % 2 == 0 else []
        borders.append(np.array(half + middle + [lenses - k for k in reversed(half)]))
    first, end = (np.stack(np.meshgrid(*(ends(b) for b in borders), indexing="ij"), axis=-1).reshape(-1, 2) for ends in (lambda b: b[:-1], lambda b: b[1:]))
    return first, end - first


def middle_block(count, most=48):
    """(first lens, number) of one such block in the middle."""
    together = np.minimum(-(-count.max() // most), count)
    return (count - together) // 2, together


def chromaticity(rgb):
    """(u', v') of linear colours (3, ...)."""
    x, y, z = np.tensordot(XYZ, rgb, 1)
    with np.errstate(invalid="ignore"):
        return np.array([4 * x, 9 * y]) / (x + 15 * y + 3 * z)


def distances(light, weights):
    """({"largest": (distance of a part's colour from that of all light together, error), "mean": ...}); None in place of both where all is dark.

    light (3, SETS, parts). In turn all sets but one find the largest distance and the parts' directions, and that one tells how far they are.
    Parts that may be dark or not, within their noise, make the error larger by what the figures would then change.
    """
    luminance = np.tensordot(LUMINANCE, light, 1)
    above = luminance - DARK * np.average(luminance, weights=weights, axis=1)[:, None]
    if not luminance.any():
        return {"largest": None, "mean": None}
    lit = above.mean(axis=0) >= 0
    unsure = np.flatnonzero(np.abs(above.mean(axis=0)) <= SURE * above.std(axis=0, ddof=1) / np.sqrt(SETS))
    found = distances_of_lit(light[:, :, lit], weights[lit] / weights[lit].sum())
    plain = {name: of_all for name, (_, _, of_all) in found.items()}
    open_error = dict.fromkeys(plain, 0.0)
    for part in unsure:
        other = lit.copy()
        other[part] = not lit[part]
        if other.any():
            length = np.hypot(*off_colours(light[:, :, other].sum(axis=1), weights[other] / weights[other].sum()))
            for name, value in (("largest", length.max()), ("mean", np.average(length, weights=weights[other]))):
                open_error[name] += abs(value - plain[name])
    return {name: (value, error + open_error[name]) for name, (value, error, _) in found.items()}


def off_colours(parts, weights):
    return chromaticity(parts) - chromaticity(parts @ weights)[:, None]


def distances_of_lit(light, weights):
    """{name: (value, error, that of all sets together, which noise raises)}; the weights' sum is 1."""
    whole = light.sum(axis=1)
    of_whole = off_colours(whole, weights)
    length = np.hypot(*of_whole)
    told = {"largest": [], "mean": []}
    for one in range(SETS):
        others = off_colours(whole - light[:, one], weights)
        far = np.hypot(*others)
        own = ((SETS * of_whole - (SETS - 1) * others) * others).sum(axis=0) / np.maximum(far, 1e-300)
        told["largest"].append(own[far.argmax()])
        told["mean"].append(own @ weights)
    of_all = {"largest": length.max(), "mean": length @ weights}
    return {name: (np.mean(found), np.hypot(error_of(np.array(found)), (of_all[name] - np.mean(found)) / 3), of_all[name]) for name, found in told.items()}


def light_of_parts(sight, eye, parts):
    """((3, SETS, parts) light, the mean of what is on the screen; (parts,) the share that is): the lines of each set are as many for each part, one part after the
    other."""
    white, on = White(sight, eye), sight.on_screen(eye).reshape(SETS, parts, -1)
    light = np.array([sum(light for light, _, _ in white.shining(c)).reshape(SETS, parts, -1) for c in range(3)])
    return (light * on).sum(axis=3) / np.maximum(on.sum(axis=2), 1), on.mean(axis=(0, 2))
