"""A white panel: how bright the screen is, how dark the joints of its lenses are, and what share of the light gets through."""
import numpy as np

import oracle
from edges import error_of
from sight import SETS, even_points, per_set

STEPS = 32  # of the place within a pitch


def radiance(display, hits):
    """Against the panel's along its normal."""
    return np.where(hits.column >= 0, hits.weight * hits.cosine**display.panel.emission_exponent, 0.0)


def luminance(sight, eye):
    """(mean radiance over the screen, its error)."""
    counts = sight.on_screen(eye)
    sets = per_set(radiance(sight.display, sight.see(eye)) * counts) / per_set(counts.astype(float))
    return sets.mean(), error_of(sets)


def mean(values):
    sets = values.reshape(SETS, -1).mean(axis=1)
    return sets.mean(), error_of(sets)


def band_contrast(sight, eye, axis):
    """(Michelson's contrast along x' or y' of the radiance averaged along the other, its error); the sight is of the middle half of the lenses."""
    counts = sight.on_screen(eye, 0.75).astype(float)
    light = (radiance(sight.display, sight.see(eye)) * counts).reshape(SETS, -1)
    counts = counts.reshape(SETS, -1)
    step = np.floor(STEPS * sight.in_cell[:, axis]).astype(int).reshape(SETS, -1)
    sets = np.array([np.bincount(s, w, STEPS) / np.bincount(s, c, STEPS) for s, w, c in zip(step, light, counts)])
    profile, noise = sets.mean(axis=0), sets.std(axis=0, ddof=1) / np.sqrt(SETS)
    low, high = profile.argmin(), profile.argmax()
    both = profile[high] + profile[low]
    if not both > 0:
        return None
    return (profile[high] - profile[low]) / both, np.hypot(noise[high], noise[low]) * 2 * max(profile[high], profile[low]) / both**2 + noise.mean() / both


def efficiency(display, n, seed):
    """(light that leaves the lenses over what reaches the array's rectangle at the lenses' lowest point, its error)."""
    u = even_points(n, 6, seed).reshape(-1, 6)
    turn = np.radians(display.array.rotation_deg)
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    count, pitch = np.array(display.array.count), display.array.pitch_mm
    lens, cell = (np.floor(u[:, :2] * count) + 0.5 - count / 2) * pitch, (u[:, 2:4] - 0.5) * pitch
    down = -cosine_directions(u[:, 4:])
    lowest = display.lens_z if display.ideal else min(min(s.z_min, s.z_rim) for s in display.surfaces)
    reaching = on_panel(display, np.column_stack([(lens + cell) @ axes + display.array.offset_mm, np.full(len(u), lowest)]), down)
    rectangle = display.ideal or display.array.surround != "opaque"  # all that leaves through it, not only by caps
    if rectangle:
        height, normal, area = np.full(len(u), display.vertex_plane), np.tile([0.0, 0.0, 1.0], (len(u), 1)), np.ones(len(u))
    else:
        top, s2 = display.surfaces[-1], (cell**2).sum(axis=1)
        inside = s2 <= top.semi**2
        local = np.column_stack([cell, np.zeros(len(u))]) * inside[:, None]
        height, normal = top.height(np.where(inside, s2, 0.0)), top.normal(local)
        area = np.where(inside, 1 / normal[:, 2], 0.0)  # of the cap over each element of the cell
    normal[:, :2] = normal[:, :2] @ axes
    start = np.column_stack([(lens + cell) @ axes + display.array.offset_mm, height])
    out = around(normal, u[:, 4:])
    above = (display.vertex_plane + 1e-6 * max(pitch) - height) / np.maximum(out[:, 2], 1e-9)  # past other caps and a stop before the lenses
    hits = oracle.trace(display, start + above[:, None] * out, -out)
    free = (np.abs((hits.lens + 0.5 - count / 2) * pitch - lens) < 0.5 * pitch).all(axis=1)
    light = np.where(rectangle | free, radiance(display, hits) * area, 0.0)
    if display.ideal:  # it keeps slopes' extent
        light = light * (hits.cosine / out[:, 2]) ** 4
    ratio = light.reshape(SETS, -1).mean(axis=1) / reaching.reshape(SETS, -1).mean(axis=1)
    return ratio.mean(), error_of(ratio)


def cosine_directions(u):
    """Upward unit directions, as many as their cosine with +z."""
    s, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    return np.column_stack([s * np.cos(phi), s * np.sin(phi), np.sqrt(1 - s**2)])


def around(normal, u):
    """The same about each normal."""
    d = cosine_directions(u)
    first = np.cross(normal, [0.0, 1.0, 0.0])
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return d[:, :1] * first + d[:, 1:2] * np.cross(normal, first) + d[:, 2:] * normal


def on_panel(display, start, down):
    """Emission towards each start, 0 beside the panel."""
    at = start[:, :2] - (start[:, 2] / down[:, 2])[:, None] * down[:, :2]
    half = np.array(display.panel.pixels) * display.panel.pixel_pitch_mm / 2
    return np.where((np.abs(at) <= half).all(axis=1), (-down[:, 2]) ** display.panel.emission_exponent, 0.0)
