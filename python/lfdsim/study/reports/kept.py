"""Whether a study's report is there, of its rows and its file as they are now.

Told without what draws reports, which takes a second to load.
"""

from __future__ import annotations

from .. import collected, files
from ..planned import Plan

NAME = "report.html"


def mark(plan: Plan) -> str:
    """In the report's head: of all that it shows."""
    return files.digest([files.note_of(plan.folder / collected.NAME)["checksum"], plan.study.text])


def is_there(plan: Plan) -> bool:
    try:
        with open(plan.folder / NAME, "rb") as file:
            return mark(plan).encode() in file.read(1000)
    except FileNotFoundError:
        return False
