"""The figures of `lfdsim check` by their closed forms. Exact but for rounding: what rounding of 1/f - 1/g leaves is each figure's own error."""
import numpy as np

import oracle
from table import UNSURE

ROUNDING = 1e-9


def lenses_before_the_panel(display, pitch):
    """Along x' and y': how many of the array's lenses the box about what is both the array's and the panel's is wide."""
    turn, count = oracle.Lattice(display).turn[:2, :2], np.array(display.array.count)
    half_panel = np.abs(turn) @ (np.array(display.panel.pixels) * display.panel.pixel_pitch_mm) / 2
    middle = turn.T @ np.asarray(getattr(display.array, "offset_mm", (0.0, 0.0)))
    half_array = count * pitch / 2
    low, high = np.maximum(middle - half_array, -half_panel), np.minimum(middle + half_array, half_panel)
    return np.minimum(count, np.maximum(np.ceil(np.maximum(high - low, 0) / pitch - 1e-9), 1))


def forms(display, description):
    """Paths with (value, error); along y', where that differs, in paths of their own. Depths in dioptres, also those that are printed in mm."""
    g, f, p, a = display.gap, display.paraxial.f, display.cell.width, display.panel.pixel_pitch_mm
    along_row = np.abs(oracle.Lattice(display).turn[0, 0]) if display.strips else 1.0  # a pixel's step across slanted strips, in pixels
    made_for = description["content"]["viewing_distance_mm"] - display.paraxial.rear
    eye = description["camera"]["position_mm"][2] - display.paraxial.rear
    central, half = 1 / f - 1 / g, a / (g * max(display.clear_aperture))
    images = p * (1 + g / made_for)  # elemental ones: their pitch
    outermost = (lenses_before_the_panel(display, p) - 1) * p / 2  # from the middle to their axes

    def seen(slope):
        return np.degrees(2 * np.arctan(np.maximum(slope, 0)))

    along = {
        "theory.fov_deg": seen(p / (2 * g)),
        "theory.fov_elemental_deg": seen(images / (2 * g)),
        "theory.elemental_pitch_mm": images,
        "theory.views": p / (a * along_row),
        "theory.view_step_deg": seen(p / along_row / (2 * g)) * a * along_row / p,
        "theory.viewing_zone_deg": seen(images / (2 * g) - outermost * abs(1 / eye - 1 / made_for)),
        "theory.viewing_zone_parallel_deg": seen(p / (2 * g) - outermost / eye),
        "theory.eyebox_mm": eye * images / g,
        "theory.lens_sampling_limit_per_mm": 1 / (2 * p),
        "theory.gap_closing_diffuser_deg": seen(p / 2 * abs(central)),
        "geometry.clear_aperture_mm": display.clear_aperture,
    }
    dioptres = {"near": 1000 * (central + half), "far": 1000 * (central - half)}
    dioptres = {f"theory.depth_{end}_{unit}": value for end, value in dioptres.items() for unit in ("diopters", "mm")} | {"theory.central_depth_mm": 1000 * central}

    def told(figure):
        return figure, ROUNDING * abs(figure) + 1e-12

    out = {"theory.focal_length_mm": told(f)}
    for path, pair in along.items():
        figures = oracle.by_axis(display, pair)
        if isinstance(figures, list):
            out[path], out[along_y(path)] = told(figures[0]), told(figures[1])
        else:
            out[path] = told(figures)
    if display.fills_cell:  # without a narrower stop there is no gap to close, and the figure may be null
        joined = np.isclose(display.clear_aperture, p)
        paths = ("theory.gap_closing_diffuser_deg", along_y("theory.gap_closing_diffuser_deg"))
        out |= {path: UNSURE for path, no_gap in zip(paths, joined) if no_gap and path in out}
    if display.lens.type == "pinhole":  # which images nothing
        return {path: form for path, form in out.items() if path != "theory.focal_length_mm" and not path.startswith("theory.gap_closing")}
    if len(display.colours) > 1:
        for name, at in zip("rgb", display.primaries):
            out[f"theory.colour.{name}.focal_length_mm"], out[f"theory.colour.{name}.gap_mm"] = told(at.paraxial.f), told(at.gap)
            dioptres[f"theory.colour.{name}.central_depth_mm"] = 1000 * (1 / at.paraxial.f - 1 / at.gap)
    return out | {path: (value, ROUNDING * 1000 / f) for path, value in dioptres.items()}


def along_y(path):
    """The name of a figure along y': "fov_y_deg" of "fov_deg"."""
    for unit in ("_per_mm", "_mm", "_deg"):
        if path.endswith(unit):
            return path.removesuffix(unit) + "_y" + unit
    return path + "_y"
