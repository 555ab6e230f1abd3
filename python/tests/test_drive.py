from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import aisle_lab as aisle


@pytest.fixture(scope="module")
def printed() -> aisle.Drive:
    papers = Path(__file__).resolve().parent.parent.parent / "deploy/experiments"
    return aisle.drive(map=papers / "wang-1.txt", local="wang", as_printed=True)


def test_a_drive_as_printed_has_the_planner_of_its_paper(printed: aisle.Drive) -> None:
    assert printed.planner == "wang" and printed.goals_assigned == 1 and printed.replans == 0


def test_a_drives_curves_are_as_long_as_its_time(printed: aisle.Drive) -> None:
    vehicle = printed.vehicle
    count = len(vehicle.t_s)
    assert vehicle.waypoints.shape == (count, 3)
    for curve in (vehicle.v_mps, vehicle.w_radps, vehicle.yaw_rad, vehicle.clearance_m):
        assert curve.shape == (count,) and np.isfinite(curve).all()
    assert (np.diff(vehicle.t_s) > 0).all() and vehicle.t_s[-1] <= printed.time_s + 0.2
    assert np.hypot(*np.diff(vehicle.waypoints[:, :2], axis=0).T).sum() == pytest.approx(printed.distance_m, rel=0.05)
    assert vehicle.v_mps.max() > 0.1 and vehicle.clearance_m.max() <= 2.0


def test_frames_have_a_row_a_sample_and_name_the_vehicle(printed: aisle.Drive) -> None:
    frame = printed.frame()
    assert len(frame) == len(printed.vehicle.t_s) and set(frame.vehicle) == {"agv-1"}
    assert {"t_s", "x_m", "y_m", "yaw_rad", "v_mps", "w_radps", "clearance_m"} <= set(frame.columns)


def test_the_same_drive_twice_is_the_same_to_the_bit(printed: aisle.Drive, papers: Path) -> None:
    again = aisle.drive(map=aisle.read_map(papers / "wang-1.txt"), local="wang", as_printed=True)
    assert again.trace_hash == printed.trace_hash and (again.vehicle.samples[:, :8] == printed.vehicle.samples[:, :8]).all()


def test_a_scenario_family_varies_by_its_seed() -> None:
    assert "crossing" in aisle.scenario_families()
    first, second = (aisle.drive("crossing", local="wu", truth=True, seed=seed) for seed in (1, 2))
    assert first.goals_assigned > 0 and first.trace_hash != second.trace_hash


def test_a_vehicle_drives_over_an_own_map(hall: aisle.Map) -> None:
    drive = aisle.drive(map=hall, start=(-8, -4), goal=(8, -4), local="wang", planner="clear")
    assert drive.reached and drive.contacts == 0 and drive.planner == "clear"
    assert np.hypot(*(drive.vehicle.waypoints[-1, :2] - (8, -4))) < 0.5


def test_parameters_change_a_drive(hall: aisle.Map) -> None:
    ways = {"map": hall, "start": (-8, -4), "goal": (-2, -4)}
    slow = aisle.drive(**ways, paper_limits=True, parameters={"max_speed_mps": 0.3})
    assert slow.vehicle.v_mps.max() <= 0.3 + 1e-9 < aisle.drive(**ways).vehicle.v_mps.max()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ({"scenario": "crosing"}, "did you mean 'crossing'"),
        ({"scenario": "crossing", "local": "wong"}, "did you mean 'wang'"),
        ({"scenario": "crossing", "planner": "astr"}, "astar"),
        ({"scenario": "crossing", "as_printed": True}, "give map"),
        ({"scenario": "crossing", "parameters": {"alpha": 1000}}, "alpha"),
        ({}, "give a scenario"),
        ({"scenario": "crossing", "goal": (1.0, 1.0)}, "are for a map"),
        ({"scenario": "crossing", "resolution_m": 0.5}, "are for a map"),
        ({"scenario": "crossing", "radius_m": 0.0}, "radius_m = 0 is not within 0.01 and 100"),
        ({"scenario": "crossing", "radius_m": float("nan")}, "radius_m = nan"),
        ({"scenario": "crossing", "seed": -1}, "seed = -1 is no whole number"),
        ({"scenario": "crossing", "seed": 2**64}, "seed = "),
        ({"scenario": "crossing", "seed": 1.5}, "seed = 1.5"),
    ],
)
def test_bad_input_is_a_value_error_with_one_line(arguments: dict, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint) as raised:
        aisle.drive(**arguments)
    assert "\n" not in str(raised.value)


def test_a_start_in_a_wall_is_refused(hall: aisle.Map) -> None:
    with pytest.raises(ValueError, match="no room"):
        aisle.drive(map=hall, start=(0.25, -4), goal=(8, -4))


def test_python_goes_on_while_a_drive_runs(hall: aisle.Map) -> None:
    """The lock is released: a thread counts meanwhile."""
    counted = 0
    over = threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.is_set():
            counted += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    aisle.drive(map=hall, start=(-8, -4), goal=(8, -4))
    over.set()
    counter.join()
    assert counted > 5


@pytest.fixture
def _interruptible() -> Iterator[None]:
    """Ctrl-C as in a terminal: what a shell starts in the background ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("_interruptible")
def test_ctrl_c_ends_a_drive(hall: aisle.Map) -> None:
    """The traditional window, which knows no path, stands behind the wall until its time is over."""
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        aisle.drive(map=hall, start=(-8, -4), goal=(8, -4), local="dwa")
    timer.join()
