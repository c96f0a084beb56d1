"""Pictures: float32 arrays of shape (height, width, 3), linear light, row 0 at the top."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lfdsim import _core
from lfdsim.arguments import Corners, Model, corners, encoding_of, pixels, points, seen, threads_of, warn
from lfdsim.display import Display
from lfdsim.errors import InputError
from lfdsim.panels import Panel, panel_of
from lfdsim.progress import Progress, shown
from lfdsim.texts import text

Picture = NDArray[np.float32]


def render(
    display: Display,
    panel: ArrayLike | Panel | None = None,
    *,
    camera_mm: Sequence[float] | None = None,
    target_mm: Sequence[float] | None = None,
    frame_width_mm: float | None = None,
    size: Sequence[int] | None = None,
    samples: int | None = None,
    estimator: str | None = None,
    seed: int | None = None,
    crop: Corners | None = None,
    model: Model = None,
    threads: int = 0,
    device: str = "auto",
    kernel: str = "",
    progress: Progress = None,
) -> Picture:
    """What a camera sees of the display.

    panel: (height, width, 3) of the panel's pixels. Floats are linear light, shown as they are; uint8 and uint16 are codes, which
        the panel's encoding turns into light. None: the elemental images of the display's model, or of `model`, rounded to the
        8-bit codes that the panel is driven by. A Panel, where many views are taken of one picture.
    camera_mm, target_mm: (x, y, z) of the camera, and of what it looks at; the panel's centre is the origin, +z to the viewer.
    frame_width_mm: width of the frame in the plane through the target. size: (width, height) in pixels.
    samples, estimator, seed: as the keys of [render]. All of these are by default those of the display.
    crop: (x0, y0, x1, y1): these columns and rows of the frame only.
    threads: 0: all. device: "auto" (a GPU where one works), "cpu", "cuda", "cuda:N". kernel: an instruction set of the CPU.
    progress: see lfdsim.progress.
    """
    view = seen(
        display,
        model,
        camera_mm=camera_mm,
        target_mm=target_mm,
        frame_width_mm=frame_width_mm,
        size=size,
        samples=samples,
        estimator=estimator,
        seed=seed,
    )
    if panel is not None and model is not None:
        raise InputError([("panel, model", "the panel can show only one of these; give one of them")])
    codes_or_light, prepared = panel_of(panel)
    part = corners(crop, *view["camera.resolution"])
    with shown(progress) as report:
        image, notes, _ = _core.render(
            view._handle, codes_or_light, prepared, part, threads_of(threads), text(device, "device"), text(kernel, "kernel"), report
        )
    warn(notes)
    return image


def elemental_images(
    display: Display,
    *,
    model: Model = None,
    pickup: str | None = None,
    targets: Sequence[ArrayLike] | None = None,
    target_eyes_mm: Sequence[Sequence[float]] | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Picture:
    """The panel's picture of the display's model, or of `model`: linear light, not yet rounded to codes (see panel_codes).

    pickup: "nodal", "traced", "integrated" or "inverse"; default: the display's.
    targets: with pickup="inverse", pictures that eyes should see in place of a scene: arrays of (rows, columns, 3), linear light or
        codes as in render(), each as the display's camera frames it from that eye, of any size with the camera's proportions.
        target_eyes_mm: (x, y, z) of these eyes.
    """
    made_for = seen(display, model, pickup=pickup)
    if (targets is None) != (target_eyes_mm is None):
        raise InputError([("targets, target_eyes_mm", "belong together; give a picture and a place for each eye")])
    if targets is not None and (model is not None or made_for["content.pickup"] != "inverse"):
        raise InputError([("targets", 'are what pickup="inverse" shows in place of a model; give that pickup, and no model')])
    pictures = [pixels(target, f"targets[{k}]") for k, target in enumerate(() if targets is None else targets)]
    eyes = points(() if target_eyes_mm is None else target_eyes_mm, "target_eyes_mm")
    with shown(progress) as report:
        if targets is None:
            image, notes = _core.elemental_images(made_for._handle, threads_of(threads), report)
        else:
            try:
                image, notes = _core.invert_pictures(made_for._handle, pictures, eyes, threads_of(threads), report)
            except InputError as error:
                raise error.of_arguments({"content.inverse.eyes_mm": "target_eyes_mm"}) from None
    warn(notes)
    return image


def photograph(
    display: Display,
    *,
    camera_mm: Sequence[float] | None = None,
    target_mm: Sequence[float] | None = None,
    frame_width_mm: float | None = None,
    size: Sequence[int] | None = None,
    samples: int | None = None,
    seed: int | None = None,
    crop: Corners | None = None,
    model: Model = None,
    threads: int = 0,
    progress: Progress = None,
) -> Picture:
    """The model itself before the same camera: what the viewer should see. Arguments as those of render()."""
    view = seen(
        display,
        model,
        camera_mm=camera_mm,
        target_mm=target_mm,
        frame_width_mm=frame_width_mm,
        size=size,
        samples=samples,
        seed=seed,
    )
    part = corners(crop, *view["camera.resolution"])
    with shown(progress) as report:
        image, notes = _core.photograph(view._handle, part, threads_of(threads), report)
    warn(notes)
    return image


def compare(a: ArrayLike, b: ArrayLike, *, crop: Corners | None = None, encoding: str = "srgb") -> dict[str, float]:
    """The similarity of two pictures of the same size: what `lfdsim compare --json` prints, including "ssim"; "psnr_db" may be inf.

    Floats are linear light; uint8 and uint16 are codes in `encoding`, "srgb" or "linear".
    """
    codes = encoding_of(encoding)
    first, second = pixels(a, "a", 8, white=16), pixels(b, "b", 8, white=16)
    if first.shape != second.shape:
        raise InputError([("b", f"has the shape {second.shape}, a has {first.shape}; only pictures of equal size can be compared")])
    return _core.compare(first, second, corners(crop, first.shape[1], first.shape[0]), codes == "linear")
