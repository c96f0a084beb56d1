"""A display description (TOML) resolved to lengths, and its paraxial theory. Lengths in mm, z from the panel to the viewer."""
import math
import tomllib
from types import SimpleNamespace

import numpy as np

from surface import Surface

DEFAULTS = {
    "panel": {"encoding": "srgb", "emission_exponent": 0.0},
    "lens": {"facing": "viewer"},
    "array": {"lattice": "square", "surround": "opaque", "aperture": "circle", "offset_mm": [0.0, 0.0], "rotation_deg": 0.0},
    "camera": {"position_mm": [0.0, 0.0, 2000.0], "target_mm": [0.0, 0.0, 0.0], "up": [0.0, 1.0, 0.0], "resolution": [3840, 2160],
               "pixel_filter": "center"},
    "render": {"samples": 100, "fresnel": "exact"},
}


def read(path):
    """The display in a TOML file, resolved."""
    with open(path, "rb") as file:
        return resolve(tomllib.load(file))


def resolve(text):
    """A parsed description with defaults filled in: surfaces in place, aperture, stop, diffuser and camera figures."""
    part = {name: SimpleNamespace(**{**DEFAULTS.get(name, {}), **text.get(name, {})}) for name in ("panel", "lens", "array", "camera", "render")}
    d = SimpleNamespace(**part)
    pitch = d.array.pitch_mm = np.full(2, d.array.pitch_mm, float)  # along x' and y' of the array; one number stands for both
    d.fills_cell = d.array.aperture == "square"
    d.ideal = d.lens.type == "ideal"
    d.surfaces = [] if d.ideal else _prescription(d, pitch)
    d.paraxial = paraxial(d)
    low = 0.0 if d.ideal else min(s.z_min for s in d.surfaces)  # still about the first vertex as z = 0
    shift = d.array.base_z_mm - low if hasattr(d.array, "base_z_mm") else d.array.gap_mm - d.paraxial.front
    for s in d.surfaces:
        for name in ("z", "z_min", "z_max", "z_rim"):
            setattr(s, name, getattr(s, name) + shift)
    d.paraxial.front += shift
    d.paraxial.rear += shift
    d.lens_z = shift  # of an ideal lens
    d.vertex_plane = shift if d.ideal else d.surfaces[-1].z
    curved_is_last = d.ideal or d.lens.type == "surfaces" or d.lens.facing == "viewer"
    d.stop_z = d.vertex_plane if curved_is_last else d.surfaces[0].z
    d.stop_radius = getattr(d.lens, "stop_radius_mm", None)
    wide = 2 * d.stop_radius if d.stop_radius else pitch if d.fills_cell else 2 * (d.lens.aperture_radius_mm if d.ideal else d.surfaces[-1].semi)
    d.clear_aperture = np.full(2, wide)  # along x' and y', too
    diffuser = text.get("diffuser")
    d.diffuser = SimpleNamespace(**{"profile": "box", **diffuser}, z=d.vertex_plane + diffuser["distance_mm"]) if diffuser else None
    return d


def _prescription(d, pitch):
    """The lens's surfaces, panel side first, with the first vertex at z = 0."""
    lens = d.lens
    if lens.type == "surfaces":
        out, z, below = [], 0.0, 1.0
        for number, s in enumerate(lens.surface):
            above = 1.0 if number == len(lens.surface) - 1 else s["index"]
            out.append(Surface(z, s["curvature_per_mm"], s.get("conic", 0.0), s.get("even_asphere", []), s["semi_aperture_mm"], below, above))
            z, below = z + s.get("distance_mm", 0.0), above
        return out
    radius, height = lens.sphere_radius_mm, lens.cylinder_height_mm
    corner = math.sqrt(np.mean(pitch**2)) / math.sqrt(2)  # half a cell's diagonal; of a square p / sqrt(2) to the last bit
    r = max(getattr(lens, "aperture_radius_mm", 0.0), corner) if d.fills_cell else lens.aperture_radius_mm
    thickness = height + radius - math.sqrt(radius**2 - r**2)
    if lens.facing == "viewer":
        return [Surface(0.0, 0.0, 0.0, [], r, 1.0, lens.index), Surface(thickness, -1 / radius, 0.0, [], r, lens.index, 1.0)]
    return [Surface(0.0, 1 / radius, 0.0, [], r, 1.0, lens.index), Surface(thickness, 0.0, 0.0, [], r, lens.index, 1.0)]


def paraxial(d):
    """Focal length f and the z of the principal planes: front (panel side) and rear (viewer's), from the paraxial matrix."""
    if d.ideal:
        return SimpleNamespace(f=d.lens.focal_length_mm, front=0.0, rear=0.0)
    m = np.eye(2)  # acts on (height, index times angle) of light that runs towards the viewer
    for s, after in zip(d.surfaces, d.surfaces[1:] + [None]):
        m = np.array([[1, 0], [-(s.n_above - s.n_below) * s.c, 1]]) @ m
        if after:
            m = np.array([[1, (after.z - s.z) / s.n_above], [0, 1]]) @ m
    (a, _), (c, e) = m
    return SimpleNamespace(f=-1 / c, front=d.surfaces[0].z + (e - 1) / c, rear=d.surfaces[-1].z + (1 - a) / c)


def by_axis(d, along):
    """A figure along x' and y' as lfdsim tells it: for square cells, where both are equal, one number."""
    return [float(v) for v in along] if d.array.lattice == "rectangle" else float(along[0])


def theory(d):
    """The paraxial figures that `lfdsim check --json` names, under the same names."""
    pitch, pixel, g, f = d.array.pitch_mm, d.panel.pixel_pitch_mm, d.paraxial.front, d.paraxial.f
    depth = 1 / (1 / f - 1 / g)  # 1/L = 1/f - 1/g
    image = pixel * abs(depth) / g
    return {"fov_deg": by_axis(d, np.degrees(2 * np.arctan(pitch / (2 * g)))), "focal_length_mm": f, "central_depth_mm": depth, "pixel_image_mm": image,
            "depth_of_field_mm": 2 * abs(depth) * image / max(d.clear_aperture)}
