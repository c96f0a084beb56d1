"""Results in JSON, as Python's values."""

from __future__ import annotations

import json
import math
from typing import Any

INFINITE = {"infinite": math.inf, "-infinite": -math.inf}


def numbers_of(text: str) -> Any:
    """JSON of the program, its words for infinite numbers as numbers; null, where a figure is undefined, is None."""
    return _with_numbers(json.loads(text))


def _with_numbers(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _with_numbers(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_with_numbers(each) for each in value]
    return INFINITE.get(value, value) if isinstance(value, str) else value
