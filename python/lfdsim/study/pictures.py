"""The pictures of a study: one Zarr store, a chunk of it for each row, so that each has one writer."""

from __future__ import annotations

import functools
import pathlib
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from . import files, work
from .planned import PICTURES, Plan
from .problems import StudyError

if TYPE_CHECKING:
    import zarr


def prepare(plan: Plan) -> None:
    """An empty store, before rows are computed: it grows as they are.

    Pictures are (row, y, x, channel), linear light, row 0 of y at the top.
    """
    path = plan.folder / PICTURES
    if not plan.study.pictures:
        return
    _require_zarr()
    import zarr

    base = work.changed(plan.display, plan.display_folder, plan.study.fixed)
    with files.full_disk_told(path):
        group = zarr.open_group(path, mode="a", attributes={})
        for picture in plan.study.pictures:
            if picture.name in group:
                continue
            width, height = picture.settings.get("size") or base["camera.resolution"]
            group.create_array(
                picture.name,
                shape=(plan.rows, height, width, 3),
                chunks=(1, height, width, 3),
                dtype="float32",
                fill_value=float("nan"),
                dimension_names=("row", f"{picture.name}_y", f"{picture.name}_x", "channel"),
            )
        with warnings.catch_warnings():  # that other programs may ignore it: they do not need it
            warnings.simplefilter("ignore")
            zarr.consolidate_metadata(path)  # so that xarray opens the store without a search


def write(plan: Plan, row: int, made: dict[str, np.ndarray]) -> None:
    for name, picture in made.items():
        store = _open(plan.folder / PICTURES, name, plan.identity)
        if store.shape[1:] != picture.shape:
            raise StudyError(
                f"[[picture]] {name}",
                f"of row {row} is {picture.shape[1]} x {picture.shape[0]}, others {store.shape[2]} x "
                f"{store.shape[1]}; give the picture a size, or camera.resolution the same value in all rows",
            )
        with files.full_disk_told(plan.folder / PICTURES):
            store[row] = picture


def read(plan: Plan, row: int, name: str) -> np.ndarray:
    return np.asarray(_open(plan.folder / PICTURES, name, plan.identity)[row])


@functools.lru_cache(maxsize=16)
def _open(path: pathlib.Path, name: str, _identity: str) -> "zarr.Array[Any]":
    """The array of a picture. The study's identity keeps it apart from that of an earlier study in the same folder."""
    _require_zarr()
    import zarr

    return zarr.open_array(path / name, mode="r+")


def _require_zarr() -> None:
    try:
        import zarr  # noqa: F401
    except ImportError as error:
        raise StudyError("[[picture]]", "needs the Python package zarr; pip install zarr xarray") from error
