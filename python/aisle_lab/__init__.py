"""Aisle's planners and its simulated site, for researchers.

    >>> import aisle_lab as aisle
    >>> plan = aisle.plan("site.png", start=(2, 2), goal=(30, 20), planner="wang", resolution_m=0.05)
    >>> drive = aisle.drive("crossing", local="wu", seed=3)
    >>> table = aisle.sweep(aisle.plan, {"planner": ["astar", "wang"]}, map="site.png", resolution_m=0.05,
    ...                     start=(2, 2), goal=(30, 20))

Lengths are metres, angles radians (counter-clockwise from the map's x axis), times seconds, unless a name says otherwise.
Places are in the map's frame: x to the right, y upwards. Bad input raises ValueError with one line that says what to do.
"""

from ._drive import Drive, VehicleDrive, drive
from ._maps import FREE, OCCUPIED, UNKNOWN, Map, read_map
from ._names import commit, local_planners, parameters, planners, scenario_families
from ._plan import Plan, plan
from ._results import read_results
from ._sweep import sweep

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNKNOWN",
    "Drive",
    "Map",
    "Plan",
    "VehicleDrive",
    "commit",
    "drive",
    "local_planners",
    "parameters",
    "plan",
    "planners",
    "read_map",
    "read_results",
    "scenario_families",
    "sweep",
]
