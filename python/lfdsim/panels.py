"""What a panel shows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lfdsim import _core
from lfdsim.arguments import display_of, number, numbers, pixels, threads_of, whole
from lfdsim.display import Display
from lfdsim.errors import InputError
from lfdsim.texts import text


class Panel:
    """A picture on the display's panel, prepared once for many views: render() takes it in place of the array.

    picture: as the `panel` of render(); codes become light here, by this display's encoding. Other displays with as many pixels may
    show it, too.
    """

    __slots__ = ("_handle",)
    _handle: _core.Panel

    def __init__(self, display: Display, picture: ArrayLike, *, threads: int = 0) -> None:
        self._handle = _core.prepare(display_of(display)._handle, pixels(picture, "panel"), threads_of(threads), None)


def panel_of(panel: Any) -> tuple[NDArray[Any] | None, _core.Panel | None]:
    """Pixels, or a prepared panel, or neither."""
    if isinstance(panel, Panel):
        return None, panel._handle
    return (None if panel is None else pixels(panel, "panel")), None


def pattern(
    display: Display,
    name: str,
    *,
    cell_pixels: int = 11,
    view: Sequence[float] = (0.0, 0.0),
    edge_deg: float = 5.0,
    depth_mm: float = 0.0,
) -> NDArray[np.float32]:
    """A test pattern of the panel's size, as `lfdsim eia --pattern` writes it: linear light.

    name: "checkerboard" (of squares of cell_pixels), "white", "view" (the one at `view`, -0.5 to 0.5 of the elemental image from its
        centre), "edge" (edge_deg from the vertical, depth_mm in front of the lenses' vertex plane) or "address".
    """
    place = numbers(view, 2, "view")
    cell = whole(cell_pixels, "cell_pixels", 1, 2**30)
    edge, depth = number(edge_deg, "edge_deg"), number(depth_mm, "depth_mm")
    try:
        return _core.pattern(display_of(display)._handle, text(name, "name"), cell, (place[0], place[1]), edge, depth)
    except InputError as error:
        raise error.of_arguments({"view_x": "view[0]", "view_y": "view[1]"}) from None


def panel_codes(display: Display, panel: ArrayLike) -> NDArray[np.uint8]:
    """Linear light as the 8-bit codes that drive the panel, in its encoding: what `lfdsim eia -o eia.png` writes. Light above 1 has
    the code of 1."""
    return _core.codes(display_of(display)._handle, pixels(panel, "panel", shown="its code is that of 1"))
