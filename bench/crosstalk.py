#!/usr/bin/python3
"""Crosstalk between two eyes before a lenticular out of focus: what is left where content by inversion subtracts it. Run with the Python package:
PYTHONPATH=build/release/python bench/crosstalk.py

A picture that is white for one eye and black for the other (Woods 2012): (leak - B)/(signal - B), from the mean luma of the views over that of a white
panel, three elements inside the border; B is the content's black.
"""
import pathlib

import numpy as np

import lfdsim

ROOT = pathlib.Path(__file__).resolve().parents[1]
LUMA = np.array([0.2126, 0.7152, 0.0722])
EYES = (-17.7, 17.7)
BORDER = 3


def view(display, panel, x, samples=1024, seed=9):
    return lfdsim.render(display, panel, camera_mm=(x, 0, 450), estimator="point", samples=samples, seed=seed)


def light(display, panel, x, white):
    """Mean luma of a view, where the white panel is seen, over the gain."""
    seen = view(display, panel, x)
    mask = view(display, white, x).mean(axis=2) > 0.6 * light.gain
    for _ in range(BORDER):
        padded = np.pad(mask, 1)
        mask = np.min([np.roll(np.roll(padded, i, 0), j, 1)[1:-1, 1:-1] for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)
    return (seen @ LUMA)[mask].mean() / light.gain


def main():
    display = lfdsim.Display.load(ROOT / "displays/tablet-lenticular.toml").with_(
        {"panel.pixels": [340, 190], "lens.sphere_radius_mm": 0.95, "camera.frame_width_mm": 29.0, "camera.resolution": [76, 44], "camera.pixel_filter": "box",
         "camera.pupil_diameter_mm": 4.0, "content.inverse.weighting": "light", "content.inverse.prior": 0.01, "content.inverse.iterations": 40,
         "content.inverse.rays": 144})
    white = np.ones((190, 340, 3), np.float32)
    on_axis = view(display, white, 0).mean(axis=2)
    light.gain = np.median(on_axis[on_axis > 0.3 * on_axis.max()])

    def told(name, panel, black):
        for aside, where in ((0, "head in place"), (3, "3 mm to the right"), (-3, "3 mm to the left")):
            signal, leak = (light(display, panel, x + aside, white) for x in EYES)
            print(f"{name:24} {where:17}: {100 * (leak - black) / (signal - black):5.1f} %, contrast {signal / leak:.1f}", flush=True)

    for levels in ((0.0, 1.0), (0.10, 0.90), (0.14, 0.86), (0.18, 0.82)):
        d = display.with_({"content.inverse.levels": list(levels)})
        places = [(x + aside, 0, 450) for x in EYES for aside in (-2, 0, 2)]
        targets = [np.full((44, 76, 3), 1.0 if x < 0 else 0.0, np.float32) for x, _, _ in places]
        panel = lfdsim.elemental_images(d, pickup="inverse", targets=targets, target_eyes_mm=places)
        told(f"inverse, levels {levels[0]:.2f}, {levels[1]:.2f}", lfdsim.panel_codes(d, panel), levels[0])


if __name__ == "__main__":
    main()
