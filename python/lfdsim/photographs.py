"""Photographs of a real display, compared with views of the simulated one; pictures as PNG."""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lfdsim import _core
from lfdsim.arguments import Corners, Model, corners, encoding_of, flag, number, pixels, seen, warn
from lfdsim.display import Display
from lfdsim.errors import InputError
from lfdsim.pictures import Picture


class PhotographComparison:
    """A photograph of a display, mapped onto a view of it. In a notebook it shows figures and overlay."""

    def __init__(self, overlay: _core.Overlay, figures: dict[str, Any]) -> None:
        self._overlay = overlay
        self.figures = figures

    @cached_property
    def simulated(self) -> Picture:
        """The view, blurred as the photograph is, where that was asked for, and clipped at its white."""
        return self._overlay.simulated()

    @cached_property
    def photograph(self) -> Picture:
        """The photograph on the view's pixels, in the view's light; black where it does not show the screen."""
        return self._overlay.photograph()

    @cached_property
    def overlay(self) -> Picture:
        """Both side by side, as a checkerboard and half of each: `lfdsim compare --overlay`."""
        return self._overlay.sheet()

    @cached_property
    def difference(self) -> Picture:
        """Where the photograph is brighter (red) or darker (blue): `lfdsim compare --difference`."""
        return self._overlay.difference()

    def __repr__(self) -> str:
        return "\n".join(["lfdsim.PhotographComparison", *(f"  {name}: {_words(value)}" for name, value in self.figures.items())])

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td style='text-align:left'>{name}</td><td>{html.escape(_words(value))}</td></tr>" for name, value in self.figures.items()
        )
        data = base64.b64encode(png(self.overlay)).decode()
        return f"<table>{rows}</table><img src='data:image/png;base64,{data}' style='max-width:100%'>"


def compare_photograph(
    view: ArrayLike,
    photograph: ArrayLike,
    corners_px: ArrayLike,
    view_corners_px: ArrayLike,
    *,
    fit_corners: bool = False,
    fit_blur: bool = False,
    crop: Corners | None = None,
    encoding: str = "srgb",
) -> PhotographComparison:
    """The similarity of a view and a photograph of the real display: `lfdsim compare --corners`. The real camera was at the position of the view's.

    view: as render() returns it. photograph: (height, width, 3), uint8 or uint16 codes in `encoding` ("srgb" or "linear"), upright;
        or floats, linear light that no white limits.
    corners_px: the outer corners of the lens array (of its part before the panel) in the photograph, (x, y) in pixels from the picture's
        upper left corner: top left, top right, bottom right, bottom left of the screen as its viewer sees it. view_corners_px: in the
        view; see screen_corners().
    fit_corners: move each corner by up to 5 pixels of the photograph to where both agree best. fit_blur: blur the view by the Gaussian
        that makes it most similar to the photograph.
    crop: (x0, y0, x1, y1): these columns and rows of the view only.
    """
    first, second = pixels(view, "view", white=16), pixels(photograph, "photograph", white=16)
    places = _points(corners_px, "corners_px"), _points(view_corners_px, "view_corners_px")
    fits = flag(fit_corners, "fit_corners"), flag(fit_blur, "fit_blur")
    part = corners(crop, first.shape[1], first.shape[0])
    made = _core.overlay(first, second, *places, part, encoding_of(encoding) == "linear", *fits)
    figures = made.figures()
    if not fit_blur:
        figures["blur_px"] = None
    figures["view_corners"] = np.array(places[1]).tolist()
    return PhotographComparison(made, figures)


def screen_corners(
    display: Display,
    *,
    camera_mm: Sequence[float] | None = None,
    target_mm: Sequence[float] | None = None,
    frame_width_mm: float | None = None,
    size: Sequence[int] | None = None,
) -> NDArray[np.float64]:
    """Where a view by render() shows the outer corners of the lens array, or of its part before the panel where it reaches over that:
    top left, top right, bottom right, bottom left; (x, y) in pixels from the frame's upper left corner. Arguments as those of render()."""
    view = seen(display, None, camera_mm=camera_mm, target_mm=target_mm, frame_width_mm=frame_width_mm, size=size)
    return np.array(_core.screen_corners(view._handle))


def png(picture: ArrayLike) -> bytes:
    """A PNG file, 8 bits in sRGB, with the pixels that the program would write, without the description of a display that its files hold:
    for files, and for pictures in notebooks. Light above white is cut off, with a warning."""
    made, cut_off = _core.png(pixels(picture, "picture", 6, white=16))  # and the file
    if cut_off:
        warn([f"picture: {cut_off}; divide it by its greatest value, or numpy.save keeps its light"])
    return made


def _points(points: Any, name: str) -> list[list[float]]:
    try:
        pairs = [list(pair) for pair in points]
    except TypeError:
        raise TypeError(f"{name} is {points!r}; give four points (x, y)") from None
    if [len(pair) for pair in pairs] != [2, 2, 2, 2]:
        raise InputError([(name, f"is {points!r}; give four points (x, y): top left, top right, bottom right, bottom left")])
    return [[number(value, name) for value in pair] for pair in pairs]


def _words(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(_words(each) for each in value) if isinstance(value[0], float) else "; ".join(map(_words, value))
    return f"{value:.5g}" if isinstance(value, float) else str(value)
