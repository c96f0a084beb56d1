"""Arguments that several functions take, checked."""

from __future__ import annotations

import math
import os
import sys
import warnings
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from lfdsim import _core
from lfdsim.display import Display
from lfdsim.errors import DisplayError, InputError, LfdsimWarning, in_python
from lfdsim.texts import text

Corners = tuple[int, int, int, int]
Model = Union[str, "os.PathLike[str]", None]

LIT = 0.01  # of a picture's values: fewer that are not 0 are specks
_PACKAGE = os.path.dirname(__file__) + os.sep


def display_of(display: Any) -> Display:
    if not isinstance(display, Display):
        raise TypeError(f"display is a {type(display).__name__}; give a lfdsim.Display, as Display.load(path) reads it")
    return display


KEYS = {  # of arguments that stand for a key of the description
    "camera_mm": "camera.position_mm",
    "target_mm": "camera.target_mm",
    "frame_width_mm": "camera.frame_width_mm",
    "size": "camera.resolution",
    "samples": "render.samples",
    "estimator": "render.estimator",
    "seed": "render.seed",
    "pickup": "content.pickup",
}


def seen(display: Any, model: Any, **arguments: Any) -> Display:
    """The display with another model and, where arguments have a value, with their KEYS changed. Errors name the arguments, too."""
    given = {KEYS[name]: value for name, value in arguments.items() if value is not None}
    if "camera.frame_width_mm" in given:
        given = {"camera.fov_deg": None, **given}
    try:
        changed = display_of(display).with_(given)
    except DisplayError as error:
        arguments_of = {KEYS[name]: name for name in arguments}
        named = [(arguments_of.get(p.key.partition("[")[0], p.where), p.what) for p in error.problems]
        raise DisplayError(named) from None
    return changed._with_model(model)


def pixels(
    array: Any, name: str, needed: int = 4, *, white: float = 1, shown: str = "it is taken as it is"
) -> NDArray[Any]:
    """Height x width x 3: float32, or codes of uint8 or uint16, in C order. Copies only what is not yet so. An alpha channel may be
    there where it is full everywhere. `needed`: bytes of memory for each value, of all that will be there at a time. `white`: the most
    that light can be, above which a warning is given, with what becomes of it (`shown`); whole numbers above 1 are taken for codes in
    any case."""
    try:
        given = np.asarray(array)
    except (ValueError, TypeError) as error:
        raise TypeError(f"{name} is not a picture: {error}") from None
    if np.ma.is_masked(array):
        raise InputError([(name, f"has masked values; give {name}.filled(value), with the value that they should have")])
    codes = given.dtype.kind == "u" and given.dtype.itemsize <= 2
    if given.dtype.kind != "f" and not codes:
        remedy = f"; if these are codes of 0 to 255, {name}.astype(numpy.uint8)" if given.dtype.kind in "iu" else ""
        raise TypeError(f"{name} holds {given.dtype}; give float32 or float64 (linear light, white is 1), or uint8 or uint16 (codes){remedy}")
    if given.ndim != 3 or given.shape[2] not in (3, 4):
        raise InputError([(name, f"has the shape {given.shape}; give (height, width, 3)")])
    if given.size == 0 or max(given.shape) >= 2**31 or given.shape[0] * given.shape[1] >= 2**31:
        raise InputError([(name, f"has the shape {given.shape}; there must be 1 to 2^31 - 1 pixels")])
    # Of what has to be copied, or is no real memory.
    _core.require_memory(name, f"an array of the shape {given.shape}", given.size * needed)
    if given.shape[2] == 4:
        if not (given[..., 3] >= (np.iinfo(given.dtype).max if codes else 1)).all():
            raise InputError([(name, f"has the shape {given.shape}, and its alpha is not full everywhere, which no panel shows; give (height, width, 3)")])
        given = given[..., :3]
    with np.errstate(over="ignore"):  # what float32 cannot hold becomes infinite, which is refused with its place
        made = np.ascontiguousarray(given, dtype=given.dtype.newbyteorder("=") if codes else np.float32)
    if not codes:
        _warn_above(made, name, white, shown)
    elif made.dtype.itemsize == 2:
        _warn_dark(made, name)
    return made


def _warn_above(light: NDArray[np.float32], name: str, white: float, shown: str) -> None:
    with np.errstate(invalid="ignore"):  # nan is refused with its place
        greatest = float(light.max())
    if not 1.001 < greatest < np.inf or np.isnan(greatest):
        return
    integers = bool((light == np.floor(light)).all())
    if not integers and greatest <= white * 1.001:
        return
    bits = 16 if greatest > 255 else 8
    remedy = (
        f"if these are codes of 0 to {2**bits - 1}, give {name}.astype(numpy.uint{bits}), which is decoded"
        if integers or greatest > 16
        else "divide by the greatest value"
    )
    warn([f"{name} holds light of up to {greatest:.6g}, and white is 1: {shown}; {remedy}"])


def _warn_dark(codes: NDArray[Any], name: str) -> None:
    """Of codes of 16 bits that are those of 8: not of black, nor of a few specks in it."""
    greatest = int(codes.max())
    if 1 < greatest <= 255 and np.count_nonzero(codes) > LIT * codes.size:
        remedy = f"if these are codes of 0 to 255, give {name}.astype(numpy.uint8)"
        warn([f"{name} holds codes of up to {greatest}, and white is 65535: it is nearly black; {remedy}"])


def whole(value: Any, name: str, low: int, high: int) -> int:
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} is a {type(value).__name__}; give a whole number")
    try:
        number: int = value.__index__()
    except TypeError:  # an array of several, or of others
        raise TypeError(f"{name} is a {type(value).__name__}; give one whole number") from None
    if not low <= number <= high:
        raise InputError([(name, f"is {number}, allowed is {low} to {high}")])
    return number


def number(value: Any, name: str) -> float:
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} is a {type(value).__name__}; give a number")
    try:
        real = float(value)
    except OverflowError:
        raise InputError([(name, "is beyond what a float can hold; give a smaller number")]) from None
    except (TypeError, ValueError):  # an array of several, or of others
        raise TypeError(f"{name} is a {type(value).__name__}; give one number") from None
    if math.isnan(real):
        raise InputError([(name, "is nan; give a number")])
    return real


def numbers(values: Any, count: int, name: str) -> list[float]:
    try:
        given = list(values)
    except TypeError:
        raise TypeError(f"{name} is {values!r}; give {count} numbers") from None
    if len(given) != count:
        raise InputError([(name, f"is {values!r}; give {count} numbers")])
    return [number(value, name) for value in given]


def flag(value: Any, name: str) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is a {type(value).__name__}; give True or False")
    return bool(value)


def encoding_of(encoding: Any) -> str:
    given = text(encoding, "encoding")
    if given not in ("srgb", "linear"):
        raise InputError([("encoding", f'is "{given}", allowed is srgb, linear')])
    return given


def threads_of(threads: Any) -> int:
    return whole(threads, "threads", 0, 1024)


def corners(crop: Any, width: int, height: int) -> Corners | None:
    """(x0, y0, x1, y1): columns x0 to x1 - 1 and rows y0 to y1 - 1 of a picture of this size."""
    if crop is None:
        return None
    try:
        x0, y0, x1, y1 = (whole(value, "crop", 0, 2**31 - 1) for value in crop)
    except TypeError:
        raise TypeError(f"crop is {crop!r}; give (x0, y0, x1, y1)") from None
    except ValueError as error:
        if isinstance(error, InputError):
            raise
        raise InputError([("crop", f"is {crop!r}; give (x0, y0, x1, y1)")]) from None
    if not (x0 < x1 <= width and y0 < y1 <= height):
        raise InputError([("crop", f"is {crop!r}; allowed are columns x0 < x1 up to {width} and rows y0 < y1 up to {height}")])
    return x0, y0, x1, y1


def points(places: Any, name: str) -> list[tuple[float, float, float]]:
    try:
        given = list(places)
    except TypeError:
        raise TypeError(f"{name} is {places!r}; give (x, y, z) of each") from None
    found = [numbers(place, 3, f"{name}[{k}]") for k, place in enumerate(given)]
    return [(x, y, z) for x, y, z in found]


def warn(notes: list[str]) -> None:
    """Warnings point to the line that called this package."""
    frame, level = sys._getframe(), 1
    while frame.f_back and frame.f_code.co_filename.startswith(_PACKAGE):
        frame, level = frame.f_back, level + 1
    for note in notes:
        warnings.warn(in_python(note), LfdsimWarning, stacklevel=level)
