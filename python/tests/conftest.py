from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import aisle_lab as aisle

TOP = Path(__file__).resolve().parent.parent.parent  # of Aisle's tree


@pytest.fixture
def papers() -> Path:
    """The folder of the papers' maps, cells of 1 m with S and T."""
    return TOP / "deploy/experiments"


@pytest.fixture
def hall() -> aisle.Map:
    """20 m x 10 m in cells of 0.5 m, with a wall across it that leaves a gap at the top."""
    cells = np.zeros((20, 40), bool)
    cells[:14, 20] = True
    return aisle.Map(cells, 0.5, origin_m=(-10.0, -5.0))
