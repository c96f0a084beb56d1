"""Measures of a display: field of view, depth of field and more."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from lfdsim import _core
from lfdsim.arguments import Model, number, seen, threads_of, warn
from lfdsim.display import Display
from lfdsim.errors import InputError
from lfdsim.progress import Progress, shown
from lfdsim.results import Result
from lfdsim.texts import text


class Measure(NamedTuple):
    """A measure that analyze() knows."""

    name: str
    title: str
    says: str  # what it means, in a sentence
    source: str  # where its definition comes from


def measures() -> list[Measure]:
    """All measures, in the order of the program's report."""
    return [Measure(*measure) for measure in _core.measures()]


def analyze(
    display: Display,
    measure: str,
    *,
    angles_deg: Iterable[float] | None = None,
    depths_mm: Iterable[float] | None = None,
    viewing_distance_mm: float | None = None,
    eye_distance_mm: float = 65.0,
    wavelength_nm: float = 550.0,
    camera_mm: Sequence[float] | None = None,
    size: Sequence[int] | None = None,
    samples: int | None = None,
    estimator: str | None = None,
    seed: int | None = None,
    pickup: str | None = None,
    model: Model = None,
    threads: int = 0,
    device: str = "auto",
    progress: Progress = None,
) -> Result:
    """Measures the display; measures() lists what can be measured.

    angles_deg: angles of the views for the field of view, rising; depths_mm: depths of the model for the depth of field; both have defaults.
    viewing_distance_mm: distance of the eyes from the panel; default: the camera's. eye_distance_mm: distance between a viewer's two eyes.
    wavelength_nm: wavelength for diffraction. size: (width, height) of the pictures that are compared: fewer pixels take less time.
    The other arguments are those of render().
    """
    of = seen(
        display,
        model,
        camera_mm=camera_mm,
        size=size,
        samples=samples,
        estimator=estimator,
        seed=seed,
        pickup=pickup,
    )
    settings: dict[str, Any] = {
        "angles_deg": _numbers(angles_deg, "angles_deg"),
        "depths_mm": _numbers(depths_mm, "depths_mm"),
        "viewing_distance_mm": None if viewing_distance_mm is None else number(viewing_distance_mm, "viewing_distance_mm"),
        "eye_distance_mm": number(eye_distance_mm, "eye_distance_mm"),
        "wavelength_nm": number(wavelength_nm, "wavelength_nm"),
    }
    known = [m.name for m in measures()]
    if text(measure, "measure") not in known:
        raise InputError([("measure", f'"{measure}" is not a measure; there are: {", ".join(known)}')])
    with shown(progress) as report:
        measured = _core.analyze(
            of._handle, measure, **settings, threads=threads_of(threads), device=text(device, "device"), progress=report
        )
    warn(measured.warnings())
    return Result(measured, measure)


def _numbers(values: Any, name: str) -> list[float]:
    if values is None:
        return []
    try:
        array = np.asarray(values if isinstance(values, np.ndarray) else list(values))
    except (TypeError, ValueError):
        raise TypeError(f"{name} is a {type(values).__name__}; give a list of numbers") from None
    if array.size == 0:
        raise InputError([(name, "is empty; give a list of numbers")])
    if array.dtype.kind not in "fiu" or array.ndim != 1:
        raise InputError([(name, f"has the shape {array.shape} of {array.dtype}; give a list of numbers")])
    given: list[float] = array.astype(float).tolist()
    return given
