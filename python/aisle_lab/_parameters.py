"""Parameters as Python gives them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

Value: TypeAlias = str | float | bool | np.bool_
Parameters: TypeAlias = Mapping[str, Value]

# Under these names stand the settings of the two services, whichever planner they run.
SERVICES = ("global-planner", "local-planner")


def text_of(value: Value) -> str:
    """As the command line says it: "0.1", "none", "yes"."""
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    return value if isinstance(value, str) else repr(float(value))


def texts_of(parameters: Parameters | None) -> dict[str, str]:
    """Names with their values as texts."""
    return {name: text_of(value) for name, value in (parameters or {}).items()}


def counts_with(name: str, global_planner: str, local_planner: str) -> bool:
    """Does `alpha`, `wang.alpha` or `local.wang.alpha` belong to one of these planners?"""
    *owners, _ = name.split(".")
    if not owners or owners[-1] in SERVICES:
        return True
    of_side = {"global": [global_planner], "local": [local_planner]}
    return owners[-1] in of_side.get(owners[0], [global_planner, local_planner])
