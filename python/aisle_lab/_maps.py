"""Maps: files of any kind that Aisle reads, or NumPy arrays."""

from __future__ import annotations

import hashlib
import os
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native

FREE, OCCUPIED, UNKNOWN = 0, 1, 2

PathLike: TypeAlias = str | os.PathLike[str]
Point: TypeAlias = tuple[float, float]


class Map:
    """An occupancy grid in the map's frame. It does not change.

    `cells`: (height, width); row 0 is the lowest, column 0 the leftmost, as `imshow(cells, origin="lower")` shows them.
    Each is FREE, OCCUPIED or UNKNOWN, in which no vehicle may drive; of booleans, True is OCCUPIED. A picture, whose row 0
    is on top, is turned by `np.flipud`.
    `resolution_m`: edge of a cell. `origin_m`: lower left corner of cell (0, 0). `start_m`, `goal_m`: where a plan or a
    drive begins and ends that is not told otherwise.
    """

    def __init__(
        self,
        cells: ArrayLike,
        resolution_m: float,
        origin_m: Point = (0.0, 0.0),
        *,
        start_m: Point | None = None,
        goal_m: Point | None = None,
    ) -> None:
        values = np.asarray(cells)
        if values.dtype != bool and not np.isin(values, (FREE, OCCUPIED, UNKNOWN)).all():
            raise ValueError("map: cells are 0 (free), 1 (occupied) or 2 (unknown), or booleans (True: occupied)")
        self._native = _native.Map(values.astype(np.uint8), resolution_m, origin_m, start_m, goal_m)

    @classmethod
    def _of(cls, native: _native.Map) -> Map:
        made = cls.__new__(cls)
        made._native = native
        return made

    def __reduce__(self) -> tuple[object, ...]:
        """For pickle: the native map goes as its parts."""
        parts = (self.cells, self.resolution_m, self.origin_m, self.start_m, self.goal_m)
        return Map._of_parts, parts

    @staticmethod
    def _of_parts(
        cells: NDArray[np.uint8], resolution_m: float, origin_m: Point, start_m: Point | None, goal_m: Point | None
    ) -> Map:
        return Map(cells, resolution_m, origin_m, start_m=start_m, goal_m=goal_m)

    @property
    def cells(self) -> NDArray[np.uint8]:
        """A copy, (height, width), row 0 the lowest."""
        return self._native.cells

    @property
    def resolution_m(self) -> float:
        """Edge of a cell."""
        return self._native.resolution_m

    @property
    def origin_m(self) -> Point:
        """Lower left corner of the map, in its frame."""
        return self._native.origin_m

    @property
    def extent_m(self) -> tuple[float, float, float, float]:
        """Left, right, bottom, top, as matplotlib's `imshow(..., extent=)` wants them."""
        (x, y), (height, width) = self.origin_m, self.cells.shape
        return x, x + width * self.resolution_m, y, y + height * self.resolution_m

    @property
    def start_m(self) -> Point | None:
        """The start, which a text file draws as `S`; None: it has none."""
        return self._native.start_m

    @property
    def goal_m(self) -> Point | None:
        """The goal, which a text file draws as `T`; None: it has none."""
        return self._native.goal_m

    @cached_property
    def digest(self) -> str:
        """Of all that it holds: maps with the same digest are the same map, in every process."""
        cells = self.cells
        rest = (cells.shape, self.resolution_m, self.origin_m, self.start_m, self.goal_m)
        return hashlib.sha256(repr(rest).encode() + cells.tobytes()).hexdigest()[:16]

    def __repr__(self) -> str:
        height, width = self.cells.shape
        return f"Map({width} x {height} cells of {self.resolution_m:g} m, origin {self.origin_m}, digest {self.digest})"


MapLike: TypeAlias = Map | PathLike


def read_map(path: PathLike, resolution_m: float | None = None) -> Map:
    """Reads a picture (`.png`, `.pgm`; dark is occupied), a ROS map (`.yaml`), a Moving AI map (`.map`) or text (`.txt`:
    `#` occupied, `.` free, `?` unknown, `S` and `T` start and goal).

    `resolution_m`: edge of a cell. A picture needs it; text and Moving AI have cells of 1 m without it; a ROS map says it
    itself, and refuses another. Raises ValueError that names the file, what is wrong there, and what to do.
    """
    if Path(path).suffix.lower() in (".png", ".pgm") and resolution_m is None:
        raise ValueError(f"{path}: is a picture, which does not say how large a pixel is: give resolution_m, e.g. 0.05")
    return Map._of(_native.read_map(os.fspath(path), resolution_m))


def map_of(map: MapLike, resolution_m: float | None) -> Map:
    """The map itself, or that of a file."""
    if not isinstance(map, Map):
        return read_map(map, resolution_m)
    if resolution_m is not None:
        raise ValueError("resolution_m is for files: a Map has its own")
    return map


def place_of(name: str, given: tuple[float, ...] | None, drawn: Point | None) -> list[float]:
    """x, y or x, y, yaw: as given, else the map's own."""
    place = given if given is not None else drawn
    if place is None:
        raise ValueError(f"give {name}=(x, y) in metres, or a text map that has one (S, T)")
    if len(place) not in (2, 3):
        raise ValueError(f"{name}: give (x, y) or (x, y, yaw), not {len(place)} numbers")
    return [float(number) for number in place]
