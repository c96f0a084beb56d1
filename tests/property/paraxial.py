"""The figures of `lfdsim check` by their closed forms. Exact but for rounding: what rounding of 1/f - 1/g leaves is each figure's own error."""
import math

ROUNDING = 1e-9


def forms(display, description):
    """Paths below `theory` with (value, error). Depths in dioptres, also those that are printed in mm."""
    g, f, p = display.paraxial.front, display.paraxial.f, display.array.pitch_mm
    distance = description["content"]["viewing_distance_mm"]
    stretch = 1 + g / (distance - display.paraxial.rear)
    central, half = 1 / f - 1 / g, display.panel.pixel_pitch_mm / (g * display.clear_aperture)
    exact = {
        "fov_deg": math.degrees(2 * math.atan(p / (2 * g))),
        "fov_elemental_deg": math.degrees(2 * math.atan(p * stretch / (2 * g))),
        "focal_length_mm": f,
        "elemental_pitch_mm": p * stretch,
        "views": p / display.panel.pixel_pitch_mm,
    }
    dioptres = {"depth_near_diopters": 1000 * (central + half), "depth_far_diopters": 1000 * (central - half)}
    dioptres |= {"depth_near_mm": dioptres["depth_near_diopters"], "depth_far_mm": dioptres["depth_far_diopters"], "central_depth_mm": 1000 * central}
    return {path: (value, ROUNDING * abs(value)) for path, value in exact.items()} | {path: (value, ROUNDING * 1000 / f) for path, value in dioptres.items()}
