"""Drives on the simulated site: every service of Aisle as it is, in one process and in virtual time."""

from __future__ import annotations

import operator
import os
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from . import _native
from ._maps import MapLike, PathLike, map_of, place_of
from ._parameters import Parameters, texts_of

COLUMNS = ["t_s", "x_m", "y_m", "yaw_rad", "v_mps", "w_radps", "sideways_mps", "clearance_m", "compute_us"]

LOCAL = "wang"  # that drives when none is named
GLOBAL = "direct"  # the same of global planners, of drives that are not as printed


@dataclass(frozen=True)
class VehicleDrive:
    """One vehicle's drive, one sample a cycle of its local planner, 50 a second: n samples."""

    samples: NDArray[np.float64]
    """(n, 9): COLUMNS, as `frame()` names them."""

    @property
    def t_s(self) -> NDArray[np.float64]:
        """(n,): since the start of the run."""
        return self.samples[:, 0]

    @property
    def waypoints(self) -> NDArray[np.float64]:
        """(n, 3): true x, y in metres in map, and yaw in radians, of the vehicle's frame."""
        return self.samples[:, 1:4]

    @property
    def yaw_rad(self) -> NDArray[np.float64]:
        """(n,): true heading in map, in (-pi, pi]."""
        return self.samples[:, 3]

    @property
    def v_mps(self) -> NDArray[np.float64]:
        """(n,): commanded speed along the heading."""
        return self.samples[:, 4]

    @property
    def w_radps(self) -> NDArray[np.float64]:
        """(n,): commanded turn rate, counter-clockwise positive."""
        return self.samples[:, 5]

    @property
    def clearance_m(self) -> NDArray[np.float64]:
        """(n,): from the outline to the nearest wall, person, block or vehicle; at most 2 m, negative where they overlap."""
        return self.samples[:, 7]

    @property
    def compute_us(self) -> NDArray[np.float64]:
        """(n,): CPU time of the local planner in this cycle. It alone differs from run to run."""
        return self.samples[:, 8]

    def frame(self) -> pd.DataFrame:
        """One row a sample: t_s, x_m, y_m, yaw_rad, v_mps, w_radps, sideways_mps (omnidirectional vehicles, to the left),
        clearance_m, compute_us."""
        return pd.DataFrame(self.samples, columns=COLUMNS)


@dataclass(frozen=True)
class Drive:
    """What a run gave. Counts are the referee's, who sees the truth."""

    local: str
    planner: str
    seed: int
    goals_assigned: int
    goals_reached: int
    goals_failed: list[tuple[str, str]]
    """Vehicle and reason of each goal that was given and not reached."""
    contacts: int
    contacts_moving_vehicle: int
    """Beginnings of contacts of a vehicle faster than 0.05 m/s."""
    least_clearance_m: float
    """Of moving vehicles to anything; not a number where nothing came near."""
    planned_m: float
    """Length of the first plan of each goal, together."""
    distance_m: float
    """Driven by all vehicles."""
    time_s: float
    """Simulated, the site's start included."""
    first_goal_s: float
    """When the first goal was given."""
    driven_s: float
    """From the first goal given to the last one reached, or to the end of the run where one was missed."""
    replans: int
    turn_sign_changes: int
    """Of turn rates beyond 0.05 rad/s."""
    trace_hash: str
    """Of every true pose: equal hashes mean the same run, to the bit."""
    log: list[str]
    """Contacts, violations of authority and goals missed, with time and vehicle."""
    vehicles: dict[str, VehicleDrive]

    @property
    def reached(self) -> bool:
        """Was every goal reached?"""
        return self.goals_reached == self.goals_assigned > 0

    @property
    def vehicle(self) -> VehicleDrive:
        """The first vehicle's drive."""
        return next(iter(self.vehicles.values()))

    def frame(self) -> pd.DataFrame:
        """The samples of all vehicles, with the column `vehicle` first."""
        frames = {name: vehicle.frame() for name, vehicle in self.vehicles.items()}
        return pd.concat(frames, names=["vehicle"]).reset_index(level="vehicle").reset_index(drop=True)

    def figures(self) -> dict[str, object]:
        """What is compared, as one flat row: all but the arrays and texts."""
        names = ("local", "planner", "seed", "goals_assigned", "goals_reached", "contacts", "contacts_moving_vehicle",
                 "least_clearance_m", "planned_m", "distance_m", "driven_s", "replans", "turn_sign_changes", "trace_hash")
        return {name: getattr(self, name) for name in names}


def drive(
    scenario: PathLike | None = None,
    *,
    map: MapLike | None = None,
    start: tuple[float, ...] | None = None,
    goal: tuple[float, ...] | None = None,
    resolution_m: float | None = None,
    local: str = LOCAL,
    planner: str | None = None,
    as_printed: bool = False,
    parameters: Parameters | None = None,
    paper_limits: bool = False,
    truth: bool = False,
    radius_m: float = 0.35,
    seed: int = 1,
) -> Drive:
    """Drives a scenario, or one vehicle over a map.

    `scenario`: a scenario file (YAML) or a name of `scenario_families()`, varied by `seed`.
    `map`, `start`, `goal`, `resolution_m`: as for `plan`, instead of a scenario.
    `local`: a name of `local_planners()`. `planner`: the global planner; left out, `direct`, or as printed that of the
    same paper.
    `as_printed`: the local planner as its paper prints it, on a map, with nothing of Aisle's own in between.
    `parameters`: of both planners, see `aisle_lab.parameters(planner)`. A bare name, `alpha`, is of the local planner; with
    its planner's name, `wang.passes`, or its side too, `global.wang.passes`, it is of that one.
    `paper_limits`: vehicles as in the local planner's paper. `truth`: tracks from the truth in sight, and not from
    simulated scans. `radius_m`: of the vehicle on a map; as printed it has the paper's.

    The same arguments give the same run, to the bit, on every machine. Raises ValueError for bad input, KeyboardInterrupt
    on Ctrl-C. May be called from several threads; the lock of Python is released meanwhile.
    """
    if (scenario is None) == (map is None):
        raise ValueError("give a scenario, or map, start and goal")
    if map is None and not (start is None and goal is None and resolution_m is None):
        raise ValueError("start, goal and resolution_m are for a map: a scenario has its own")
    if as_printed and map is None:
        raise ValueError("as_printed drives a paper's map: give map, with start and goal, instead of a scenario")

    grid = None if map is None else map_of(map, resolution_m)
    planner = global_planner_of(local, planner, as_printed)
    seed = seed_of(seed)
    answer = _native.drive(
        "" if scenario is None else os.fspath(scenario),
        None if grid is None else grid._native,
        [] if grid is None else place_of("start", start, grid.start_m),
        [] if grid is None else place_of("goal", goal, grid.goal_m),
        local,
        planner,
        texts_of(parameters),
        as_printed,
        paper_limits,
        truth,
        radius_m,
        seed,
    )
    vehicles = {name: VehicleDrive(samples) for name, samples in answer.pop("vehicles")}
    return Drive(local=local, planner=planner, seed=seed, vehicles=vehicles, **answer)


def seed_of(seed: int) -> int:
    """The seed itself, NumPy's too, if C++ can hold it."""
    try:
        number = operator.index(seed)
    except TypeError:
        number = -1

    if not 0 <= number < 2**64:
        raise ValueError(f"seed = {seed!r} is no whole number from 0 to 2^64 - 1")
    return number


def global_planner_of(local: str, planner: str | None, as_printed: bool) -> str:
    """The named one; else the default, or as printed that of the local planner's paper."""
    if planner is not None:
        return planner
    return _native.global_planner_of(local) if as_printed else GLOBAL
