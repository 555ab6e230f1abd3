from __future__ import annotations

import pickle
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

import aisle_lab as aisle


def test_row_0_of_a_map_is_its_lowest(hall: aisle.Map) -> None:
    assert hall.cells.shape == (20, 40)
    assert hall.cells[0, 20] == aisle.OCCUPIED and hall.cells[19, 20] == aisle.FREE
    assert hall.extent_m == (-10.0, 10.0, -5.0, 5.0)


def test_a_picture_is_read_with_its_top_row_on_top(tmp_path: Path) -> None:
    picture = np.ones((4, 6))
    picture[0, :] = 0.0  # black
    matplotlib.image.imsave(tmp_path / "site.png", picture, cmap="gray", vmin=0, vmax=1)

    site = aisle.read_map(tmp_path / "site.png", resolution_m=0.25)

    assert site.resolution_m == 0.25 and site.cells.shape == (4, 6)
    assert (site.cells[3] == aisle.OCCUPIED).all() and (site.cells[:3] == aisle.FREE).all()


def test_a_picture_needs_a_resolution(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="give resolution_m"):
        aisle.read_map(tmp_path / "site.png")


def test_a_drawn_map_has_start_and_goal(papers: Path) -> None:
    drawn = aisle.read_map(papers / "wang-1.txt")
    assert drawn.start_m == (1.5, 1.5) and drawn.goal_m == (19.5, 19.5)


@pytest.mark.parametrize(
    ("cells", "ways", "complaint"),
    [
        (np.zeros(4), {}, "two dimensions"),
        (np.full((2, 2), 7), {}, "0 \\(free\\)"),
        (np.zeros((2, 2)), {"resolution_m": 0.0}, "resolution_m = 0 is not within 0.001 and 1000"),
        (np.zeros((2, 2)), {"resolution_m": float("inf")}, "resolution_m = inf"),
        (np.zeros((2, 2)), {"resolution_m": float("nan")}, "resolution_m = nan"),
        (np.zeros((2, 2)), {"origin_m": (0.0, float("nan"))}, "origin_m is not finite"),
        (np.zeros((2, 2)), {"goal_m": (float("inf"), 0.0)}, "goal_m is not finite"),
    ],
)
def test_what_is_no_map_is_refused(cells: np.ndarray, ways: dict, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint) as raised:
        aisle.Map(cells, **{"resolution_m": 1.0, **ways})
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("resolution_m", [0.0, -1.0, float("nan"), 1001.0])
def test_a_file_is_read_with_a_resolution_that_can_be(papers: Path, resolution_m: float) -> None:
    with pytest.raises(ValueError, match="resolution_m = .* is not within 0.001 and 1000"):
        aisle.read_map(papers / "wang-1.txt", resolution_m=resolution_m)


def test_bad_files_raise_one_clear_line(tmp_path: Path) -> None:
    (tmp_path / "bad.txt").write_text("..x\n...\n")
    for name in ("bad.txt", "missing.yaml"):
        with pytest.raises(ValueError, match=name) as raised:
            aisle.read_map(tmp_path / name)
        assert "\n" not in str(raised.value)


def test_maps_survive_pickle(papers: Path) -> None:
    drawn = aisle.read_map(papers / "wang-1.txt")
    copy = pickle.loads(pickle.dumps(drawn))
    assert (copy.cells == drawn.cells).all() and copy.start_m == drawn.start_m and repr(copy) == repr(drawn)
