"""Planning offline, on a map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from . import _native
from ._maps import MapLike, map_of, place_of
from ._parameters import Parameters, texts_of

PLANNER = "astar"  # that is asked when none is named


@dataclass(frozen=True)
class Plan:
    """A planner's answer. Arrays are empty and figures 0 unless `found`."""

    planner: str
    outcome: str
    """found, no path, start blocked, goal blocked, out of map or out of time"""
    refusal: str
    """Why there is no path, in one line; empty when there is."""
    fault: str
    """What an independent checker objects to in the path; empty: nothing."""
    waypoints: NDArray[np.float64]
    """(n, 3): x, y in metres in map, yaw in radians. Where a planner knows no headings, yaw is that of the leg that
    follows, and at the goal of the leg that arrives."""
    clearance_m: NDArray[np.float64]
    """(n,): from each waypoint to what is not free, at most 5 m or the vehicle's needs; a safe lower bound."""
    length_m: float
    nodes: int
    turning_points: int
    turning_angle_rad: float
    """All changes of direction together."""
    least_clearance_m: float
    """Along the whole path."""
    expanded: int
    """Cells that the search took from its queue."""
    time_us: float
    """Of this search on this machine."""

    @property
    def found(self) -> bool:
        return self.outcome == "found"

    def frame(self) -> pd.DataFrame:
        """One row a waypoint: x_m, y_m, yaw_rad, clearance_m."""
        frame = pd.DataFrame(self.waypoints, columns=["x_m", "y_m", "yaw_rad"])
        return frame.assign(clearance_m=self.clearance_m)

    def figures(self) -> dict[str, object]:
        """What is compared, as one flat row: all but the arrays."""
        names = ("planner", "outcome", "length_m", "nodes", "turning_points", "turning_angle_rad", "least_clearance_m",
                 "expanded", "time_us", "refusal", "fault")
        return {name: getattr(self, name) for name in names}


def plan(
    map: MapLike,
    start: tuple[float, ...] | None = None,
    goal: tuple[float, ...] | None = None,
    *,
    planner: str = PLANNER,
    parameters: Parameters | None = None,
    resolution_m: float | None = None,
    radius_m: float = 0.0,
    footprint_m: tuple[float, float] | tuple[float, float, float] | None = None,
    safe_distance_m: float = 0.0,
    preferred_clearance_m: float = 0.0,
    turning_radius_m: float = 0.0,
    nearest: bool = False,
) -> Plan:
    """Plans a path with one planner.

    `map`: a file (see `read_map`, which explains `resolution_m`) or a Map.
    `start`, `goal`: (x, y) or (x, y, yaw) in metres and radians; a text map may draw them (S, T).
    `planner`: a name of `planners()`. `parameters`: of that planner, see `aisle_lab.parameters(planner)`, e.g.
    `{"passes": "none"}`, also as `wang.passes`; the others are as published.
    `radius_m`: of a round vehicle with its margin; or `footprint_m`: (length, width) or (length, width, ahead), a
    rectangle whose middle lies `ahead` before the vehicle's frame.
    `safe_distance_m`: that qu and yu keep beside the lines they draw. `preferred_clearance_m`: nearer to obstacles than
    this a metre costs more (clear). `turning_radius_m`: of a vehicle that cannot turn on the spot (hybrid).
    `nearest`: where the goal cannot be reached, go to the nearest place that can.

    No path is an outcome and no error. Raises ValueError for bad input, KeyboardInterrupt on Ctrl-C. May be called from
    several threads; the lock of Python is released meanwhile.
    """
    if footprint_m is not None and radius_m != 0.0:
        raise ValueError("radius_m is for a disc, footprint_m for a rectangle: give one")
    if footprint_m is not None and len(footprint_m) not in (2, 3):
        raise ValueError("footprint_m: give (length, width) or (length, width, ahead) in metres")

    grid = map_of(map, resolution_m)
    outline = [] if footprint_m is None else [*floats(footprint_m), 0.0][:3]
    answer = _native.plan(
        grid._native,
        place_of("start", start, grid.start_m),
        place_of("goal", goal, grid.goal_m),
        planner,
        texts_of(parameters),
        radius_m,
        outline,
        safe_distance_m,
        preferred_clearance_m,
        turning_radius_m,
        nearest,
    )
    waypoints = with_yaw(answer.pop("positions_m"), answer.pop("headings_rad"))
    return Plan(planner=planner, waypoints=waypoints, **answer)


def floats(numbers: tuple[float, ...]) -> list[float]:
    return [float(number) for number in numbers]


def with_yaw(positions_m: NDArray[np.float64], headings_rad: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) of (n, 2); without headings, those of the legs."""
    if len(headings_rad) != len(positions_m):
        headings_rad = np.zeros(len(positions_m))
        if len(positions_m) > 1:
            legs = np.diff(positions_m, axis=0)
            headings_rad[:-1] = np.arctan2(legs[:, 1], legs[:, 0])
            headings_rad[-1] = headings_rad[-2]
    return np.column_stack([positions_m, headings_rad])
