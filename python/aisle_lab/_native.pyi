"""The native module. Private: aisle_lab's functions check and name what goes in and comes out."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

class Map:
    def __init__(
        self,
        cells: NDArray[np.uint8],
        resolution_m: float,
        origin_m: tuple[float, float],
        start_m: tuple[float, float] | None,
        goal_m: tuple[float, float] | None,
    ) -> None: ...
    @property
    def cells(self) -> NDArray[np.uint8]: ...
    @property
    def resolution_m(self) -> float: ...
    @property
    def origin_m(self) -> tuple[float, float]: ...
    @property
    def start_m(self) -> tuple[float, float] | None: ...
    @property
    def goal_m(self) -> tuple[float, float] | None: ...

def commit() -> str: ...
def read_map(path: str, resolution_m: float | None) -> Map: ...
def planners() -> list[tuple[str, str]]: ...
def plan(
    map: Map,
    start: list[float],
    goal: list[float],
    planner: str,
    parameters: dict[str, str],
    radius_m: float,
    footprint_m: list[float],
    safe_distance_m: float,
    preferred_clearance_m: float,
    turning_radius_m: float,
    nearest: bool,
) -> dict[str, Any]: ...
def local_planners() -> list[tuple[str, str]]: ...
def parameters(planner: str) -> list[tuple[str, str, str, str, str, str, str, str]]: ...
def check_parameter_name(name: str) -> None: ...
def global_planner_of(local: str) -> str: ...
def scenario_families() -> list[str]: ...
def drive(
    scenario: str,
    map: Map | None,
    start: list[float],
    goal: list[float],
    local: str,
    planner: str,
    parameters: dict[str, str],
    as_printed: bool,
    paper_limits: bool,
    truth: bool,
    radius_m: float,
    seed: int,
) -> dict[str, Any]: ...
