"""A display description (TOML) resolved to lengths, and its paraxial theory. Lengths in mm, z from the panel to the viewer."""
import math
import pathlib
import tomllib
from types import SimpleNamespace

import numpy as np

import errors
from dispersion import has_glass, index_of, wavelengths
from lattice import cell_shape, grid_pitch, least_count, turn_matrix
from subpixels import Subpixels
from surface import Surface

DEFAULTS = {
    "panel": {"encoding": "srgb", "emission_exponent": 0.0, "aperture_ratio": 1.0, "subpixels": "none", "layer": [],
              "wavelengths_nm": [611.4, 549.1, 464.2]},
    "lens": {"facing": "viewer"},
    "array": {"lattice": "square", "surround": "opaque", "aperture": "circle", "offset_mm": [0.0, 0.0], "rotation_deg": 0.0},
    "camera": {"position_mm": [0.0, 0.0, 2000.0], "target_mm": [0.0, 0.0, 0.0], "up": [0.0, 1.0, 0.0], "resolution": [3840, 2160],
               "pixel_filter": "center"},
    "content": {"viewing_distance_mm": 2000.0},
    "render": {"samples": 100, "fresnel": "exact", "wavelength_samples": 1},
}
TOUCHES = 1e-6  # mm: a flat face this close to what lies under it is glued on


def read(path):
    """The display in a TOML file, resolved; a table of errors lies where the file names it."""
    with open(path, "rb") as file:
        text = tomllib.load(file)
    if "table" in text.get("errors", {}):
        text["errors"]["table"] = errors.read_table(pathlib.Path(path).parent / text["errors"]["table"])
    return resolve(text)


def resolve(text):
    """A parsed description in green light. Of other light it holds two lists.

    primaries: the display in the light of each channel's middle wavelength. colours: (share of each channel (3,), the display in the light of one
    wavelength). Heights follow from green's indices. Without glasses the display itself serves all channels.
    """
    panel = SimpleNamespace(**{**DEFAULTS["panel"], **text["panel"]})
    d = _resolve(text, panel.wavelengths_nm[1])
    d.primaries, d.colours = [d] * 3, [(np.ones(3), d)]
    if has_glass(text):
        array = {key: value for key, value in text["array"].items() if key != "gap_mm"}
        in_place = {**text, "array": {**array, "base_z_mm": d.lowest}}
        d.primaries = [_resolve(in_place, nm) for nm in panel.wavelengths_nm]
        samples, widths = d.render.wavelength_samples, getattr(panel, "primary_widths_nm", [0.0] * 3)
        d.colours = [(share * np.eye(3)[channel], _resolve(in_place, nm)) for channel in range(3)
                     for nm, share in wavelengths(panel.wavelengths_nm[channel], widths[channel], samples)]
    return d


def _resolve(text, nm):
    """A parsed description with defaults filled in: surfaces and layers in place, aperture, stop, diffuser and camera figures. nm: the light's wavelength."""
    d = SimpleNamespace(**{name: SimpleNamespace(**{**default, **text.get(name, {})}) for name, default in DEFAULTS.items()})
    if d.array.aperture not in ("circle", "cell"):
        raise ValueError(f"aperture is {d.array.aperture}, not circle or cell")
    pitch = d.array.pitch_mm = grid_pitch(d.array.lattice, d.array.pitch_mm)
    if not hasattr(d.array, "count"):
        d.array.count = least_count(d.array, d.panel)
    d.strips, d.fills_cell = d.array.lattice == "strips", d.array.aperture == "cell"
    d.cell = cell_shape(d.array.lattice, pitch)
    d.subpixels = Subpixels(d.panel)
    d.layers = [(layer["thickness_mm"], index_of(layer, nm)) for layer in d.panel.layer]  # from the panel upwards
    d.layer_top = sum(thickness for thickness, _ in d.layers)
    reduced = sum(thickness / index for thickness, index in d.layers)
    d.ideal = d.lens.type in ("ideal", "pinhole")  # a pinhole is an ideal lens without power
    d.power = 1 / d.lens.focal_length_mm if d.lens.type == "ideal" else 0.0
    d.surfaces = [] if d.ideal else _prescription(d, nm)
    d.paraxial = paraxial(d)
    low = 0.0 if d.ideal else min(s.z_min for s in d.surfaces)  # still about the first vertex as z = 0
    # Light from the panel reaches a height z in air as if it came through z - layer_top + reduced of air.
    shift = d.array.base_z_mm - low if hasattr(d.array, "base_z_mm") else d.array.gap_mm + d.layer_top - reduced - d.paraxial.front
    d.lowest = low + shift
    for s in d.surfaces:
        for name in ("z", "z_min", "z_max", "z_rim"):
            setattr(s, name, getattr(s, name) + shift)
    d.paraxial.front += shift
    d.paraxial.rear += shift
    d.gap = d.paraxial.front - d.layer_top + reduced
    d.glued = bool(d.surfaces) and d.surfaces[0].flat and abs(d.lowest - d.layer_top) <= TOUCHES
    if d.glued:  # on the bare panel nothing refracts: as if the panel were of the lens's glass
        d.surfaces[0].n_below = d.layers[-1][1] if d.layers else d.surfaces[0].n_above
    d.lens_z = shift  # of an ideal lens
    d.vertex_plane = shift if d.ideal else d.surfaces[-1].z
    curved_is_last = d.ideal or d.lens.type == "surfaces" or d.lens.facing == "viewer"
    d.stop_z = d.vertex_plane if curved_is_last else d.surfaces[0].z
    d.stop_radius = getattr(d.lens, "stop_radius_mm", None)
    d.pupil = pupil(d)
    cells = d.pupil.cells * np.asarray(d.cell.width) if d.fills_cell else np.inf
    d.clear_aperture = np.minimum(np.full(2, 2 * d.pupil.radius), cells)  # along x' and y'
    d.errors = errors.of_display(text.get("errors"), d)
    diffuser = text.get("diffuser")
    d.diffuser = SimpleNamespace(**{"profile": "box", **diffuser}, z=d.vertex_plane + diffuser["distance_mm"]) if diffuser else None
    return d


def _prescription(d, nm):
    """The lens's surfaces, panel side first, with the first vertex at z = 0 and air on both sides."""
    lens = d.lens
    if lens.type == "surfaces":
        out, z, below = [], 0.0, 1.0
        for number, s in enumerate(lens.surface):
            above = 1.0 if number == len(lens.surface) - 1 else index_of(s, nm)
            out.append(Surface(z, s["curvature_per_mm"], s.get("conic", 0.0), s.get("even_asphere", []), s["semi_aperture_mm"], below, above, d.strips))
            z, below = z + s.get("distance_mm", 0.0), above
        return out
    radius, height = lens.sphere_radius_mm, lens.cylinder_height_mm
    r = max(getattr(lens, "aperture_radius_mm", 0.0), d.cell.corner) if d.fills_cell else lens.aperture_radius_mm
    index, thickness = index_of(vars(lens), nm), height + radius - math.sqrt(radius**2 - r**2)
    lower, upper = (0.0, -1 / radius) if lens.facing == "viewer" else (1 / radius, 0.0)  # curvatures
    return [Surface(0.0, lower, 0.0, [], r, 1.0, index, d.strips), Surface(thickness, upper, 0.0, [], r, index, 1.0, d.strips)]


def paraxial(d):
    """Focal length f (inf for a pinhole) and the z of the principal planes: front (panel side) and rear (viewer's), from the paraxial matrix.

    All of it for air on both sides: to glue a flat face on moves the front plane as it moves the panel's image, and nothing else.
    """
    if d.ideal:
        return SimpleNamespace(f=1 / d.power if d.power else math.inf, front=0.0, rear=0.0)
    m = np.eye(2)  # acts on (height, index times angle) of light that runs towards the viewer
    for s, after in zip(d.surfaces, d.surfaces[1:] + [None]):
        m = np.array([[1, 0], [-(s.n_above - s.n_below) * s.c, 1]]) @ m
        if after:
            m = np.array([[1, (after.z - s.z) / s.n_above], [0, 1]]) @ m
    (a, _), (c, e) = m
    return SimpleNamespace(f=-1 / c, front=d.surfaces[0].z + (e - 1) / c, rear=d.surfaces[-1].z + (1 - a) / c)


def pupil(d):
    """What the viewer sees, far away, of a lens's apertures by paraxial optics: the radius of the narrowest image of a round one, and of cells the least scale.

    From an aperture to the viewer's side a matrix of (height, index times angle) is [[A, B], [C, D]], its determinant 1: the image is 1/D as large.
    """
    stop = d.stop_radius or math.inf
    if d.ideal:
        return SimpleNamespace(radius=min(math.inf if d.fills_cell else d.lens.aperture_radius_mm, stop), cells=1.0)
    radius, cells, m = math.inf, 1.0, np.eye(2)
    for k in reversed(range(len(d.surfaces))):
        s = d.surfaces[k]
        if k + 1 < len(d.surfaces):
            above = d.surfaces[k + 1]
            m = m @ np.array([[1, 0], [-(above.n_above - above.n_below) * above.c, 1]]) @ np.array([[1, (above.z - s.z) / s.n_above], [0, 1]])
        scale = 1 / max(abs(m[1, 1]), 1e-300)
        radius, cells = min(radius, scale * min(s.semi, stop if s.z == d.stop_z else math.inf)), min(cells, scale)
    return SimpleNamespace(radius=radius, cells=cells)


def by_axis(d, along):
    """A figure along x' and y' as lfdsim tells it: two numbers where cells have sides of their own along both, else one."""
    return [float(v) for v in along] if d.array.lattice in ("rectangle", "brick") else float(along[0])


def theory(d):
    """The paraxial figures that `lfdsim check --json` names, under the same names; None where there is no such figure."""
    width, pixel, g = d.cell.width, d.panel.pixel_pitch_mm, d.gap
    slant = turned_by(d) if d.strips else 0.0
    lie_flat = abs(np.cos(slant)) < np.cos(np.radians(75))  # eyes of such strips are one above the other
    across = abs(np.sin(slant) if lie_flat else np.cos(slant))
    whole_field = lambda half: np.degrees(2 * np.arctan(half / g))
    figures = {"gap_mm": g, "fov_deg": by_axis(d, whole_field(width / 2)), "views": by_axis(d, width / (pixel * across)),
               "fov_exact_deg": by_axis(d, exact_field(d)) if d.ideal else None}
    if d.strips:
        figures["fov_horizontal_deg"] = None if lie_flat else float(whole_field(width[0] / (2 * across)))
    if not d.power and d.ideal:
        return {**figures, "focal_length_mm": None, "central_depth_mm": None, "pixel_image_mm": None, "depth_of_field_mm": None}
    depth = 1 / (1 / d.paraxial.f - 1 / g)  # 1/L = 1/f - 1/g
    image = pixel * abs(depth) / g
    return {**figures, "focal_length_mm": d.paraxial.f, "central_depth_mm": depth, "pixel_image_mm": image,
            # as published, of a range that does not reach the lenses
            "depth_of_field_mm": 2 * abs(depth) * image / max(d.clear_aperture) if image < max(d.clear_aperture) else None}


def focus(d):
    """(focal length, central depth) in mm for red, green and blue, each with its own colour's reduced gap. Not for pinholes."""
    return [(at.paraxial.f, 1 / (1 / at.paraxial.f - 1 / at.gap)) for at in d.primaries]


def turned_by(d):
    """The turn of the array in radians, counter-clockwise as the viewer sees it."""
    turn = turn_matrix(d.array)
    return math.atan2(turn[1, 0], turn[0, 0])


def elemental_stretch(d):
    """Pitch of the elemental images against that of the lenses, for the viewer at content.viewing_distance_mm (may be inf)."""
    return 1 + d.gap / (d.content.viewing_distance_mm - d.paraxial.rear)


def exact_field(d):
    """(2,): full angles in degrees between the rays that go from the ends of a whole elemental image, by Snell, to a thin lens's centre."""
    media = d.layers + [(d.lens_z - d.layer_top, 1.0)] * (d.lens_z > d.layer_top)
    return np.array([np.degrees(2 * _angle_in_air(half, media)) for half in d.cell.width * elemental_stretch(d) / 2])


def _angle_in_air(aside, media):
    """The angle, in radians and in air, of the ray that is moved aside by this many mm on its way through (thickness, index) pairs. Bisection."""
    low, high = 0.0, 1.0  # of its sine
    for _ in range(60):
        sine = (low + high) / 2
        moved = sum(t * (sine / n) / math.sqrt(1 - (sine / n) ** 2) for t, n in media)
        low, high = (sine, high) if moved < aside else (low, sine)
    return math.asin(low)
