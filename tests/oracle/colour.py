"""What rays see of the panel in red, green and blue: each channel at its wavelengths, from its own subpixels; edges; Monte Carlo means with their variance."""
import numpy as np

import tracer


def decode(image, encoding):
    """Panel image (rows, columns, 3): uint8 or uint16 codes, or floats, to linear light."""
    value = image / np.iinfo(image.dtype).max if image.dtype.kind == "u" else image.astype(float)
    if encoding == "linear":
        return value
    return np.where(value <= 0.04045, value / 12.92, ((np.maximum(value, 0.04045) + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1


def trace(display, o, d, turn=None):
    """The same rays at each wavelength: a list of (share of each channel (3,), hits as tracer.trace gives them)."""
    return [(share, tracer.trace(at, o, d, turn)) for share, at in display.colours]


def shade(display, traced, linear):
    """Linear colours (n, 3) of traced rays; linear: the decoded panel image."""
    colour = np.zeros((len(traced[0][1].x), 3))
    for share, hits, channel, rays, found in _shining(display, traced):
        on = display.subpixels.shown(*found)
        rays, (_, column, row) = rays[on], found[:, on]
        light = hits.weight[rays] * hits.cosine[rays] ** display.panel.emission_exponent
        colour[rays, channel] += share * display.subpixels.gain[channel] * light * linear[row, column, channel]
    return colour


def met(display, traced):
    """Numbers (k, n, 3) of what each channel's rays meet: a subpixel of a pixel of the panel, or 0; one for each of k wavelengths."""
    out = []
    for share, hits, channel, rays, (number, column, row) in _shining(display, traced):
        place = np.zeros((len(hits.x), 3), np.int64)
        place[rays, channel] = np.where(number >= 0, ((row + 8) * 2**24 + column + 8) * 64 + number + 1, 0)  # a few pixels beside the panel have numbers, too
        out.append(place)
    return np.array(out)


def _shining(display, traced):
    """(share, hits, channel, rays that end on the panel, what they meet there) for each wavelength and each channel that shines at it."""
    for shares, hits in traced:
        rays = np.flatnonzero(hits.column >= 0)
        for channel in np.flatnonzero(shares):
            yield shares[channel], hits, channel, rays, display.subpixels.met(channel, hits.x[rays], hits.y[rays])


def near_edge(display, linear, x, y, radius=0.02, spokes=8, rings=2):
    """(n, 3): whether a channel's exact light changes by more than 1/255, or what it meets at all, within `radius` pixels of the image points."""
    middle = trace(display, *tracer.camera_rays(display, x, y))
    colour, place = shade(display, middle, linear), met(display, middle)
    edge = np.zeros((len(x), 3), bool)
    for r in radius * np.arange(1, rings + 1) / rings:
        for angle in 2 * np.pi * (np.arange(spokes) + 0.137) / spokes:
            away = trace(display, *tracer.camera_rays(display, x + r * np.cos(angle), y + r * np.sin(angle)))
            edge |= (met(display, away) != place).any(axis=0) | (np.abs(shade(display, away, linear) - colour) > 1 / 255)
    return edge


def sampled(display, linear, count, seed):
    """Monte Carlo means over diffuser angles, pupil and pixel area: (mean, variance of one sample), each (pixels, 3)."""
    rng = np.random.default_rng(seed)
    x0, y0 = tracer.centers(display)
    total, squares, done = np.zeros((len(x0), 3)), np.zeros((len(x0), 3)), 0
    while done < count:
        k = min(count - done, max(tracer.BATCH // len(x0), 1))  # samples of every pixel at once
        x, y = np.tile(x0, k), np.tile(y0, k)
        n, lens, turn = len(x), None, None
        if display.camera.pixel_filter == "box":
            x, y = x + rng.random(n) - 0.5, y + rng.random(n) - 0.5
        if getattr(display.camera, "pupil_diameter_mm", 0):
            r, phi = np.sqrt(rng.random(n)), 2 * np.pi * rng.random(n)
            lens = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=1)
        if display.diffuser:
            turn = tracer.diffuser_angles(display.diffuser, rng, n)
        colour = shade(display, trace(display, *tracer.camera_rays(display, x, y, lens), turn), linear).reshape(k, -1, 3)
        total, squares, done = total + colour.sum(axis=0), squares + (colour**2).sum(axis=0), done + k
    mean = total / count
    return mean, np.maximum(squares / count - mean**2, 0) * count / max(count - 1, 1)
