"""lfdsim: what a viewer sees of a light field display with a lens array, before it is built.

    import lfdsim
    d = lfdsim.Display.load("tablet.toml")
    view = lfdsim.render(d, model="monkey.blend", camera_mm=(40, 0, 599), size=(1280, 720))

Pictures are float32 arrays of shape (height, width, 3): linear light, row 0 at the top. Lengths are in mm, angles in degrees.
"""

import importlib
from typing import TYPE_CHECKING

from lfdsim._core import version as __version__
from lfdsim.checking import check
from lfdsim.display import Display
from lfdsim.errors import DisplayError, InputError, LfdsimWarning, Problem, UnknownKeyError
from lfdsim.measuring import Measure, analyze, measures
from lfdsim.panels import Panel, panel_codes, pattern
from lfdsim.photographs import PhotographComparison, compare_photograph, png, screen_corners
from lfdsim.pictures import compare, elemental_images, photograph, render
from lfdsim.results import Result

__all__ = [
    "Display",
    "DisplayError",
    "InputError",
    "LfdsimWarning",
    "Measure",
    "Panel",
    "PhotographComparison",
    "Problem",
    "Result",
    "UnknownKeyError",
    "__version__",
    "analyze",
    "check",
    "compare",
    "compare_photograph",
    "elemental_images",
    "measures",
    "panel_codes",
    "pattern",
    "photograph",
    "png",
    "render",
    "screen_corners",
    "study",
]


if TYPE_CHECKING:  # type checkers, which then know that there are no other names
    from lfdsim import study
else:

    def __getattr__(name: str) -> object:
        """Imports lfdsim.study on first use, since it needs pandas and scipy."""
        if name == "study":
            return importlib.import_module("lfdsim.study")
        raise AttributeError(f"module 'lfdsim' has no attribute {name!r}")
