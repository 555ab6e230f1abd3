from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import aisle_lab as aisle


@pytest.fixture
def ways(papers: Path) -> dict[str, object]:
    return {"map": papers / "wang-1.txt", "progress": False}


def test_a_sweep_has_a_row_for_each_combination_in_order(ways: dict, papers: Path) -> None:
    maps = [papers / "wang-1.txt", papers / "yu-1.txt"]
    del ways["map"]
    table = aisle.sweep(aisle.plan, {"map": maps, "planner": ["astar", "theta"]}, **ways)

    assert list(table.planner) == ["astar", "theta"] * 2
    assert list(table["map"]) == [str(maps[0])] * 2 + [str(maps[1])] * 2
    for row in table.itertuples():
        assert row.length_m == aisle.plan(row.map, planner=row.planner).length_m


def test_a_parameter_of_another_planner_makes_no_rows(ways: dict) -> None:
    over = {"planner": ["astar", "wang"], "parameters.wang.log_base": [2, 10]}
    table = aisle.sweep(aisle.plan, over, **ways)
    assert list(table.planner) == ["astar", "wang", "wang"]
    assert table["parameters.wang.log_base"].isna().tolist() == [True, False, False]


def test_a_parameter_counts_for_the_local_planner_that_has_it(ways: dict) -> None:
    over = {"local": ["wang", "wu"], "parameters.wang.alpha": [0.05, 0.2]}
    table = aisle.sweep(aisle.drive, over, as_printed=True, **ways)
    assert list(table.local) == ["wang", "wang", "wu"]
    assert table.trace_hash.nunique() == 3


def test_drives_in_threads_are_those_that_run_alone(ways: dict) -> None:
    over = {"local": ["wang", "yu"]}
    table = aisle.sweep(aisle.drive, over, as_printed=True, **ways)
    here = aisle.drive(map=ways["map"], local="wang", as_printed=True)
    assert table.trace_hash[0] == here.trace_hash and table.planner.tolist() == ["wang", "yu"]


def test_seeds_may_be_of_numpy(ways: dict, tmp_path: Path) -> None:
    table = aisle.sweep(aisle.drive, {"seed": np.arange(1, 3)}, out=tmp_path / "seeds.jsonl", as_printed=True, **ways)
    assert table.seed.tolist() == sorted(aisle.read_results(tmp_path / "seeds.jsonl").seed) == [1, 2]


def test_a_sweep_goes_on_where_it_ended(ways: dict, tmp_path: Path) -> None:
    out = tmp_path / "sweep.jsonl"
    over = {"planner": ["astar", "theta", "wang"]}
    whole = aisle.sweep(aisle.plan, over, out=out, **ways)
    lines = out.read_text().splitlines(keepends=True)
    assert len(lines) == 4

    marked = json.loads(lines[1])
    marked["expanded"] = -1  # a row that is run again would not say so
    out.write_text(lines[0] + json.dumps(marked) + "\n" + lines[2][:20])  # killed within a line

    resumed = aisle.sweep(aisle.plan, over, out=out, **ways)
    assert resumed.expanded.tolist().count(-1) == 1
    assert resumed.length_m.tolist() == whole.length_m.tolist()
    assert len(out.read_text().splitlines()) == 4

    again = aisle.read_results(out)
    assert sorted(again.planner) == ["astar", "theta", "wang"]
    assert again.attrs["head"]["commit"] == aisle.commit()


def test_a_file_of_another_sweep_is_refused(ways: dict, tmp_path: Path) -> None:
    out = tmp_path / "sweep.jsonl"
    aisle.sweep(aisle.plan, {"planner": ["astar"]}, out=out, **ways)
    with pytest.raises(ValueError, match="another sweep"):
        aisle.sweep(aisle.plan, {"planner": ["astar"]}, out=out, radius_m=0.3, **ways)


def test_the_first_bad_combination_ends_the_sweep(ways: dict) -> None:
    with pytest.raises(ValueError, match="did you mean theta"):
        aisle.sweep(aisle.plan, {"planner": ["astar", "thta"]}, **ways)


@pytest.mark.parametrize(
    ("over", "complaint"),
    [({"planer": ["astar"]}, "no argument"), ({"planner": "astar"}, "list of values"), ({"seed": []}, "no argument")],
)
def test_what_cannot_be_swept_is_refused(ways: dict, over: dict, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        aisle.sweep(aisle.plan, over, **ways)


def test_results_of_the_command_line_are_read(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("# commit: 4c2e91a\nplanner,length_m\nastar,1.5\nwang,\n")
    (tmp_path / "a.jsonl").write_text('{"head": {"commit": "4c2e91a"}}\n{"planner": "astar", "length_m": 1.5}\n')
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder/results.jsonl").write_text((tmp_path / "a.jsonl").read_text())
    for name in ("a.csv", "a.jsonl", "folder"):
        frame = aisle.read_results(tmp_path / name)
        assert frame.attrs["head"]["commit"] == "4c2e91a" and frame.length_m[0] == 1.5
    with pytest.raises(ValueError, match="neither"):
        aisle.read_results(tmp_path / "a.txt")
    (tmp_path / "b.jsonl").write_text('{"head": {}}\nnone\n{}\n')
    with pytest.raises(ValueError, match="b.jsonl:2"):
        aisle.read_results(tmp_path / "b.jsonl")


def halls() -> list[aisle.Map]:
    """Of the same size; a wall stands across the second, which leaves a gap at the top."""
    cells = np.zeros((20, 40), bool)
    walled = cells.copy()
    walled[:14, 20] = True
    return [aisle.Map(it, 0.5) for it in (cells, walled)]


def test_maps_of_the_same_size_are_told_apart() -> None:
    table = aisle.sweep(aisle.plan, {"map": halls()}, start=(2.25, 1.25), goal=(18.25, 1.25), progress=False)
    assert len(table) == 2 and table["map"].nunique() == 2
    assert table.length_m[0] == 16.0 < table.length_m[1]


def test_a_sweep_over_maps_goes_on_with_maps_of_the_same_cells(tmp_path: Path) -> None:
    """As in another process, where they are other objects."""
    ways = {"start": (2.25, 1.25), "goal": (18.25, 1.25), "out": tmp_path / "sweep.jsonl", "progress": False}
    aisle.sweep(aisle.plan, {"map": halls()}, **ways)
    written = ways["out"].read_text()
    assert len(aisle.sweep(aisle.plan, {"map": halls()}, **ways)) == 2
    assert ways["out"].read_text() == written and len(written.splitlines()) == 3


@pytest.mark.parametrize(
    ("planners", "parameter", "complaint"),
    [
        (["astar", "wang"], "wnag.log_base", "did you mean 'wang'"),
        (["astar", "wang"], "wang.log_bse", "did you mean 'log_base'"),
        (["astar", "wang"], "qu.passes", "another planner than those of this sweep: astar, wang"),
        (["wang"], "local.wang.alpha", "another planner"),
    ],
)
@pytest.mark.parametrize("is_fixed", [False, True])
def test_a_parameter_that_changes_no_row_is_refused(
    ways: dict, planners: list[str], parameter: str, complaint: str, is_fixed: bool
) -> None:
    swept = {} if is_fixed else {f"parameters.{parameter}": [2]}
    fixed = {"parameters": {parameter: 2}} if is_fixed else {}
    with pytest.raises(ValueError, match=complaint) as raised:
        aisle.sweep(aisle.plan, {"planner": planners, **swept}, **fixed, **ways)
    assert "\n" not in str(raised.value)


def test_a_fixed_parameter_counts_for_the_planner_that_has_it(ways: dict) -> None:
    table = aisle.sweep(aisle.plan, {"planner": ["astar", "wang"]}, parameters={"wang.passes": "none"}, **ways)
    bare = aisle.plan(ways["map"], planner="wang", parameters={"passes": "none"})
    assert table.nodes.tolist() == [aisle.plan(ways["map"]).nodes, bare.nodes]


@pytest.mark.parametrize("name", ["missing.csv", "missing.jsonl"])
def test_results_that_do_not_exist_are_named(tmp_path: Path, name: str) -> None:
    with pytest.raises(FileNotFoundError, match=name):
        aisle.read_results(tmp_path / name)


def test_a_file_that_is_cut_within_its_head_says_so(ways: dict, tmp_path: Path) -> None:
    out = tmp_path / "cut.jsonl"
    out.write_text('{"head": {"made_by": "ais')
    with pytest.raises(ValueError, match="cut.jsonl:1: is cut within its first line"):
        aisle.read_results(out)
    with pytest.raises(ValueError, match="cut.jsonl:1: is cut within its first line"):
        aisle.sweep(aisle.plan, {"planner": ["astar"]}, out=out, **ways)
