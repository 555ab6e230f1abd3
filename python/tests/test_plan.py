from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import aisle_lab as aisle
from aisle_lab._parameters import text_of


def test_a_plan_goes_from_start_to_goal_around_the_wall(hall: aisle.Map) -> None:
    plan = aisle.plan(hall, (-8, -4), (8, -4), planner="theta", radius_m=0.5)

    assert plan.found and plan.fault == "" and plan.refusal == ""
    assert plan.waypoints.shape == (plan.nodes, 3) and plan.clearance_m.shape == (plan.nodes,)
    assert tuple(plan.waypoints[0, :2]) == (-8, -4) and tuple(plan.waypoints[-1, :2]) == (8, -4)
    legs = np.diff(plan.waypoints[:, :2], axis=0)
    assert plan.length_m == pytest.approx(np.hypot(*legs.T).sum())
    assert plan.waypoints[0, 2] == pytest.approx(np.arctan2(legs[0, 1], legs[0, 0]))
    assert plan.least_clearance_m >= 0.5
    assert list(plan.frame().columns) == ["x_m", "y_m", "yaw_rad", "clearance_m"]


def test_headings_are_the_planners_where_it_knows_them(hall: aisle.Map) -> None:
    plan = aisle.plan(hall, (-8, -4, 0.0), (8, -4, 0.0), planner="hybrid", turning_radius_m=1.0, radius_m=0.3)
    assert plan.found and plan.waypoints[0, 2] == pytest.approx(0.0) and plan.waypoints[-1, 2] == pytest.approx(0.0, abs=0.2)


def test_no_path_is_an_outcome_with_its_reason(hall: aisle.Map) -> None:
    plan = aisle.plan(hall, (-8, -4), (0.25, -4.75))
    assert not plan.found and plan.outcome == "goal blocked" and "goal in obstacle" in plan.refusal
    assert plan.waypoints.shape == (0, 3)
    assert aisle.plan(hall, (-8, -4), (0.25, -4.75), nearest=True).found


def test_a_drawn_map_is_planned_from_s_to_t(papers: Path) -> None:
    plan = aisle.plan(papers / "wang-1.txt", planner="wang")
    assert plan.found and tuple(plan.waypoints[-1, :2]) == (19.5, 19.5)


def test_parameters_are_set_by_name(papers: Path) -> None:
    as_published = aisle.plan(papers / "wang-1.txt", planner="wang")
    bare = aisle.plan(papers / "wang-1.txt", planner="wang", parameters={"passes": "none"})
    assert bare.nodes > as_published.nodes
    named = aisle.plan(papers / "wang-1.txt", planner="wang", parameters={"wang.passes": "none"})
    assert (named.waypoints == bare.waypoints).all()
    assert "passes" in set(aisle.parameters("wang").query("side == 'global'").name)


@pytest.mark.parametrize(("value", "text"), [(True, "yes"), (np.bool_(True), "yes"), (np.bool_(False), "no"), (2, "2.0"), ("a", "a")])
def test_values_are_written_as_on_the_command_line(value: object, text: str) -> None:
    assert text_of(value) == text


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ({"planner": "wong"}, "did you mean wang"),
        ({"planner": "wang", "parameters": {"pases": "none"}}, "passes"),
        ({"planner": "wang", "parameters": {"passes": "all"}}, "passes"),
        ({"planner": "astar", "parameters": {"wang.passes": "none"}}, "wang"),
        ({"radius_m": 0.5, "footprint_m": (1.0, 0.5)}, "give one"),
        ({"start": (1.0,)}, "start"),
        ({"goal": (float("nan"), 1.0)}, "goal"),
        ({"resolution_m": 0.5}, "resolution_m"),
        ({"planner": "astar", "parameters": {"wnag.passes": "none"}}, "did you mean 'wang'"),
        ({"radius_m": -1.0}, "radius_m = -1 is not within 0 and 100"),
        ({"radius_m": float("nan")}, "radius_m = nan"),
        ({"safe_distance_m": -0.1}, "safe_distance_m"),
        ({"preferred_clearance_m": float("inf")}, "preferred_clearance_m"),
        ({"turning_radius_m": 101.0}, "turning_radius_m = 101"),
        ({"footprint_m": (1.0, 0.0)}, "footprint_m: width = 0"),
        ({"footprint_m": (float("nan"), 1.0)}, "footprint_m: length"),
        ({"footprint_m": (1.0, 0.5, -101.0)}, "footprint_m: ahead"),
    ],
)
def test_bad_input_is_a_value_error_with_one_line(hall: aisle.Map, arguments: dict, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint) as raised:
        aisle.plan(hall, **{"start": (-8, -4), "goal": (8, -4), **arguments})
    assert "\n" not in str(raised.value)


def test_start_and_goal_are_needed_where_the_map_has_none(hall: aisle.Map) -> None:
    with pytest.raises(ValueError, match="give start"):
        aisle.plan(hall)


def test_threads_may_plan_on_one_map(hall: aisle.Map) -> None:
    goals = [(8, -4 + 0.1 * i) for i in range(20)]
    with ThreadPoolExecutor(4) as threads:
        lengths = list(threads.map(lambda goal: aisle.plan(hall, (-8, -4), goal, planner="theta").length_m, goals))
    assert lengths == [aisle.plan(hall, (-8, -4), goal, planner="theta").length_m for goal in goals]


def test_all_planners_are_listed() -> None:
    assert {"astar", "li", "qu", "wang", "yu"} <= set(aisle.planners().name)
    assert {"li", "qu", "wang", "wu", "yu", "dwa"} <= set(aisle.local_planners().name)
