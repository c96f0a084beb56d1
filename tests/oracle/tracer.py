"""The whole way of rays of one wavelength: camera, diffuser, lens array, layers, panel."""
from types import SimpleNamespace

import numpy as np

import errors_trace
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
    status = np.full(len(o), ALIVE)
    if display.diffuser:
        o, d, status = _diffuse(display.diffuser.z, o, d, turn)
    if display.errors:
        path = errors_trace.trace(display, o, d, status)
        p, d = path.o, path.d
    else:
        lattice = Lattice(display)
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
