"""What follows from a display's description."""

from __future__ import annotations

from typing import Any

from lfdsim import _core
from lfdsim.arguments import display_of, flag
from lfdsim.display import Display
from lfdsim.numbers_of import numbers_of


def check(display: Display, warnings: bool = True) -> dict[str, Any]:
    """What `lfdsim check --json` prints: keys, geometry, theory, notes (why a figure is None) and warnings. Infinite figures are inf.

    warnings=False leaves them out (None): rays are traced and models read for them, some milliseconds each time.
    """
    found: dict[str, Any] = numbers_of(_core.check(display_of(display)._handle, None, flag(warnings, "warnings")))
    return found
