"""The whole way: camera rays, diffuser, lens array, layers, panel, colour; the edge rule; Monte Carlo means with their variance."""
from types import SimpleNamespace

import numpy as np

from glass import trace_glass
from lattice import Lattice
from opaque import trace_ideal, trace_opaque
from path import ALIVE, BLACK, ESCAPED, OFF_PANEL, PANEL, Path

BATCH = 20000  # rays traced at once; bounds the memory


def trace(display, o, d, turn=None):
    """Rays o (n, 3) in mm with directions d (n, 3), and the diffuser's angles turn (n, 2) in radians (default 0), to the panel.

    Returns arrays: status (path.py), column and row of the panel pixel (-1: none), weight (Fresnel), cosine (at the panel, in what lies on it), met (surfaces
    met between the lenses' outsides and the panel; glass only), x and y (on the panel, in pixels from its top left corner), way (a number that
    is the same for rays that meet the same lenses in the same order; 0 is none), lens (n, 2) (the first one met; -1 is none).
    """
    d = d / np.linalg.norm(d, axis=1, keepdims=True)
    turn = np.zeros((len(o), 2)) if turn is None else turn
    parts = [_trace(display, o[k:k + BATCH], d[k:k + BATCH], turn[k:k + BATCH]) for k in range(0, len(o), BATCH)]
    return SimpleNamespace(**{name: np.concatenate([getattr(p, name) for p in parts]) for name in vars(parts[0])})


def _trace(display, o, d, turn):
    lattice = Lattice(display)
    status = np.full(len(o), ALIVE)
    if display.diffuser:
        o, d, status = _diffuse(display.diffuser.z, o, d, turn)
    path = Path(*lattice.enter(o, d))
    path.status[:] = status
    (trace_ideal if display.ideal else trace_opaque if display.array.surround == "opaque" else trace_glass)(path, display, lattice)
    p, d = lattice.leave(path.o, path.d)
    panel = display.panel
    (columns, rows), pitch = panel.pixels, panel.pixel_pitch_mm
    x, y = (p[:, 0] + columns * pitch / 2) / pitch, (rows * pitch / 2 - p[:, 1]) / pitch
    column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    on = (path.status == OFF_PANEL) & (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    return SimpleNamespace(status=np.where(on, PANEL, path.status), column=np.where(on, column, -1), row=np.where(on, row, -1),
                           weight=np.where(on, path.weight, 0.0), cosine=np.where(on, -d[:, 2], 1.0), met=path.met, x=x, y=y, way=path.way, lens=path.lens)


def _diffuse(z, o, d, turn):
    """At the plane z a downward direction i goes on along Rx(b) Ry(a) i, (a, b) = turn."""
    crosses = (o[:, 2] > z) & (d[:, 2] < 0)
    at = np.where(crosses[:, None], o + ((z - o[:, 2]) / np.where(crosses, d[:, 2], 1.0))[:, None] * d, o)
    (ca, sa), (cb, sb) = ((np.cos(turn[:, k]), np.sin(turn[:, k])) for k in (0, 1))
    x, y, w = ca * d[:, 0] + sa * d[:, 2], d[:, 1], -sa * d[:, 0] + ca * d[:, 2]
    turned = np.stack([x, cb * y - sb * w, sb * y + cb * w], axis=1)
    d = np.where(crosses[:, None], turned, d)
    status = np.where(~crosses, ESCAPED, np.where(turned[:, 2] >= 0, BLACK, ALIVE))
    return at, d, status


def decode(image, encoding):
    """Panel image (rows, columns, 3): uint8 or uint16 codes, or floats, to linear light."""
    value = image / np.iinfo(image.dtype).max if image.dtype.kind == "u" else image.astype(float)
    if encoding == "linear":
        return value
    return np.where(value <= 0.04045, value / 12.92, ((np.maximum(value, 0.04045) + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1


def shade(display, hits, linear):
    """Linear colours (n, 3) of traced rays; linear: the decoded panel image."""
    light = hits.weight * hits.cosine**display.panel.emission_exponent
    ratio = display.panel.aperture_ratio
    if ratio < 1:  # a black matrix around a square in the middle of each pixel
        off = np.maximum(np.abs(hits.x % 1 - 0.5), np.abs(hits.y % 1 - 0.5))
        light = light * (off < np.sqrt(ratio) / 2) / ratio
    return linear[hits.row, hits.column] * np.where(hits.column >= 0, light, 0.0)[:, None]


def camera_rays(display, x, y, lens=None):
    """Rays through image points (x, y) in pixels, (0, 0) the image's top left corner; lens (n, 2): point of the unit pupil disk."""
    camera = display.camera
    width, height = camera.resolution
    eye, target = np.array(camera.position_mm, float), np.array(camera.target_mm, float)
    distance = np.linalg.norm(target - eye)
    forward = (target - eye) / distance
    right = np.cross(forward, camera.up)
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    pixel = frame_width(display, distance) / width  # in the plane through the target
    d = forward * distance + ((x - width / 2) * pixel)[:, None] * right - ((y - height / 2) * pixel)[:, None] * up
    o = np.broadcast_to(eye, d.shape)
    if lens is not None:
        focus = getattr(camera, "focus_distance_mm", distance)
        sharp = o + d * (focus / distance)
        o = o + 0.5 * camera.pupil_diameter_mm * (lens[:, :1] * right + lens[:, 1:] * up)
        d = sharp - o
    return o, d / np.linalg.norm(d, axis=1, keepdims=True)


def frame_width(display, distance):
    camera = display.camera
    if hasattr(camera, "frame_width_mm"):
        return camera.frame_width_mm
    if hasattr(camera, "fov_deg"):
        return 2 * distance * np.tan(np.radians(camera.fov_deg) / 2)
    columns, rows = (n * display.panel.pixel_pitch_mm for n in display.panel.pixels)
    return 1.03 * max(columns, 16 / 9 * rows)


def centers(display):
    """x and y of all pixel centres, row by row."""
    width, height = display.camera.resolution
    y, x = np.mgrid[:height, :width] + 0.5
    return x.ravel(), y.ravel()


def near_edge(display, linear, x, y, radius=0.02, spokes=8, rings=2):
    """Whether the exact picture changes by more than 1/255, or the panel pixel at all, within `radius` pixels of the image points."""
    middle = trace(display, *camera_rays(display, x, y))
    colour, edge = shade(display, middle, linear), np.zeros(len(x), bool)
    for r in radius * np.arange(1, rings + 1) / rings:
        for angle in 2 * np.pi * (np.arange(spokes) + 0.137) / spokes:
            away = trace(display, *camera_rays(display, x + r * np.cos(angle), y + r * np.sin(angle)))
            edge |= (away.column != middle.column) | (away.row != middle.row)
            edge |= np.abs(shade(display, away, linear) - colour).max(axis=1) > 1 / 255
    return edge


def sampled(display, linear, count, seed):
    """Monte Carlo means over diffuser angles, pupil and pixel area: (mean, variance of one sample), each (pixels, 3)."""
    rng = np.random.default_rng(seed)
    x0, y0 = centers(display)
    total, squares, done = np.zeros((len(x0), 3)), np.zeros((len(x0), 3)), 0
    while done < count:
        k = min(count - done, max(BATCH // len(x0), 1))  # samples of every pixel at once
        x, y = np.tile(x0, k), np.tile(y0, k)
        n, lens, turn = len(x), None, None
        if display.camera.pixel_filter == "box":
            x, y = x + rng.random(n) - 0.5, y + rng.random(n) - 0.5
        if getattr(display.camera, "pupil_diameter_mm", 0):
            r, phi = np.sqrt(rng.random(n)), 2 * np.pi * rng.random(n)
            lens = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=1)
        if display.diffuser:
            turn = diffuser_angles(display.diffuser, rng, n)
        colour = shade(display, trace(display, *camera_rays(display, x, y, lens), turn), linear).reshape(k, -1, 3)
        total, squares, done = total + colour.sum(axis=0), squares + (colour**2).sum(axis=0), done + k
    mean = total / count
    return mean, np.maximum(squares / count - mean**2, 0) * count / max(count - 1, 1)


def diffuser_angles(diffuser, rng, n):
    """(n, 2) angles (a about y, b about x) in radians."""
    full = np.radians(diffuser.angle_deg)
    if diffuser.profile == "box":
        return (rng.random((n, 2)) - 0.5) * full
    sigma = full / np.sqrt(8 * np.log(2))  # full width at half maximum
    out = rng.standard_normal((n, 2)) * sigma
    while (wide := np.abs(out) > np.radians(89)).any():
        out[wide] = (rng.standard_normal((n, 2)) * sigma)[wide]
    return out
