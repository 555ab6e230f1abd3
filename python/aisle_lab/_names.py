"""What there is: planners, their parameters, scenarios."""

from __future__ import annotations

import pandas as pd

from . import _native


def planners() -> pd.DataFrame:
    """The global planners: columns name, summary."""
    return pd.DataFrame(_native.planners(), columns=["name", "summary"])


def local_planners() -> pd.DataFrame:
    """The local planners: columns name, summary."""
    return pd.DataFrame(_native.local_planners(), columns=["name", "summary"])


def parameters(planner: str = "") -> pd.DataFrame:
    """What may be set of a planner, of both the global and the local one where they share a name; of all when left out.

    Columns: side (global or local), planner, name, default (as published), unit, range, counts (in which drives, empty: in
    all), meaning. The planners `global-planner` and `local-planner` stand for the settings of these services.
    """
    columns = ["side", "planner", "name", "default", "unit", "range", "counts", "meaning"]
    return pd.DataFrame(_native.parameters(planner), columns=columns)


def scenario_families() -> list[str]:
    """Names that `drive` takes instead of a scenario file; each is varied by the seed."""
    return _native.scenario_families()


def commit() -> str:
    """The commit that the native module was built from, with `-dirty` after it when files differed from it."""
    return _native.commit()
