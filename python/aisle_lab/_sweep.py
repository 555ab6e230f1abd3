"""Grids of parameters: one row a combination, over plan or drive, with progress, two threads and resume."""

from __future__ import annotations

import inspect
import itertools
import json
import math
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import IO, Any

import pandas as pd

from . import _drive, _names, _native, _plan
from ._maps import Map, PathLike
from ._parameters import counts_with
from ._results import read_lines

Runner = Callable[..., Any]

PARAMETER = "parameters."  # before the name of a parameter: "parameters.wang.alpha"


def sweep(
    run: Runner,
    over: Mapping[str, Sequence[Any]],
    *,
    out: PathLike | None = None,
    workers: int = 2,
    progress: bool = True,
    **fixed: Any,
) -> pd.DataFrame:
    """Runs `plan` or `drive` for every combination of values, and returns one row a combination.

    `run`: `plan` or `drive`. `over`: the values of each argument, e.g. `{"planner": ["astar", "wang"], "seed": range(5)}`.
    A parameter is named through its argument: `"parameters.alpha": [0.1, 0.2]`; with its planner's name,
    `"parameters.wang.alpha"`, it counts where that planner plans, and other planners get one row each, without it.
    `fixed`: arguments that are the same in all rows; of `parameters`, those of a planner count where it plans.
    `out`: a file of JSON Lines (`.jsonl`, see `read_results`) to which each row is appended as soon as it is there; called
    again with the same file, the rows in it are not run again. Its first line tells the commit and the fixed arguments.
    A `Map` stands there with its digest, a map's file with its path.
    `workers`: threads; the work is done without Python's lock. `progress`: a line on stderr.

    The frame has a column for each name in `over`, then those of `Plan.figures()` or `Drive.figures()`. Raises ValueError,
    with the combination's own line, for the first that is bad input; rows that were done by then stay in `out`.
    """
    kind = kind_of(run)
    refuse_unusable(kind, over, fixed)
    combinations = list(combinations_of(kind, over, fixed))
    refuse_idle_parameters(kind, over, fixed, combinations)
    head = {
        "made_by": f"aisle_lab.sweep({kind})",
        "commit": _names.commit(),
        "fixed": {name: shown(value) for name, value in fixed.items()},
    }

    done = rows_of(out, head)
    missing = [combination for combination in combinations if key_of(combination) not in done]
    with Rows(out, head, done) as rows:
        told = len(combinations) - len(missing)
        for combination, figures in figures_of(kind, run, missing, fixed, workers):
            rows.add(combination, figures)
            told += 1
            if progress:
                sys.stderr.write(f"\rsweep: {told} of {len(combinations)}")
                sys.stderr.flush()
        if progress and missing:
            sys.stderr.write("\n")

    return pd.DataFrame([done[key_of(combination)] for combination in combinations])


def kind_of(run: Runner) -> str:
    if run is _plan.plan:
        return "plan"
    if run is _drive.drive:
        return "drive"
    raise ValueError("sweep runs aisle_lab.plan or aisle_lab.drive")


def refuse_unusable(kind: str, over: Mapping[str, Sequence[Any]], fixed: Mapping[str, Any]) -> None:
    known = inspect.signature({"plan": _plan.plan, "drive": _drive.drive}[kind]).parameters
    for name, values in over.items():
        if not name.startswith(PARAMETER) and (name not in known or name == "parameters"):
            names = ", ".join(it for it in known if it != "parameters")
            raise ValueError(f"sweep: '{name}' is no argument of {kind}: there are {names} and parameters.NAME")
        if name in fixed:
            raise ValueError(f"sweep: '{name}' is in `over` and given beside it")
        if isinstance(values, str) or len(values) == 0:
            raise ValueError(f"sweep: '{name}' is a list of values, one at least")
    for name in parameters_of(over, fixed):
        if "." in name:
            _native.check_parameter_name(name)


def parameters_of(over: Mapping[str, Sequence[Any]], fixed: Mapping[str, Any]) -> list[str]:
    """The names of all parameters of a sweep, without "parameters."."""
    swept = [name[len(PARAMETER) :] for name in over if name.startswith(PARAMETER)]
    return [*swept, *(fixed.get("parameters") or {})]


def refuse_idle_parameters(
    kind: str, over: Mapping[str, Sequence[Any]], fixed: Mapping[str, Any], combinations: Sequence[Mapping[str, Any]]
) -> None:
    """Raises ValueError for a parameter that would change no row."""
    planners = {planners_of(kind, {**fixed, **combination}) for combination in combinations}
    for name in parameters_of(over, fixed):
        if not any(counts_with(name, *pair) for pair in planners):
            names = ", ".join(sorted({one for pair in planners for one in pair if one}))
            raise ValueError(f"sweep: parameter '{name}' is of another planner than those of this sweep: {names}")


def combinations_of(kind: str, over: Mapping[str, Sequence[Any]], fixed: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """All combinations in the order of `over`, the last name fastest; a parameter of a planner that does not plan in a
    combination is left out there, and what then comes twice is one."""
    seen = set()
    for values in itertools.product(*over.values()):
        combination = dict(zip(over.keys(), values, strict=True))
        planner, local = planners_of(kind, {**fixed, **combination})
        for name in list(combination):
            if name.startswith(PARAMETER) and not counts_with(name[len(PARAMETER) :], planner, local):
                del combination[name]
        if key_of(combination) not in seen:
            seen.add(key_of(combination))
            yield combination


def planners_of(kind: str, arguments: Mapping[str, Any]) -> tuple[str, str]:
    """The global and the local planner of a call; no local one where a path is planned."""
    if kind == "plan":
        return arguments.get("planner", _plan.PLANNER), ""
    local = arguments.get("local", _drive.LOCAL)
    return _drive.global_planner_of(local, arguments.get("planner"), arguments.get("as_printed", False)), local


def arguments_of(kind: str, combination: Mapping[str, Any], fixed: Mapping[str, Any]) -> dict[str, Any]:
    """As `plan` and `drive` take them: of the fixed parameters, those that count in this combination."""
    arguments = dict(fixed)
    planners = planners_of(kind, {**fixed, **combination})
    if fixed.get("parameters"):
        counting = {name: value for name, value in fixed["parameters"].items() if counts_with(name, *planners)}
        arguments["parameters"] = counting

    for name, value in combination.items():
        if name.startswith(PARAMETER):
            arguments["parameters"] = {**(arguments.get("parameters") or {}), name[len(PARAMETER) :]: value}
        else:
            arguments[name] = value
    return arguments


def figures_of(
    kind: str, run: Runner, combinations: Sequence[Mapping[str, Any]], fixed: Mapping[str, Any], workers: int
) -> Iterator[tuple[Mapping[str, Any], dict[str, Any]]]:
    """Each combination with its figures, as they come. After an error, and on Ctrl-C, what was not begun is dropped."""
    threads = ThreadPoolExecutor(workers)
    try:
        asked = {threads.submit(lambda it: run(**arguments_of(kind, it, fixed)).figures(), it): it for it in combinations}
        for future in as_completed(asked):
            yield asked[future], future.result()
    finally:
        threads.shutdown(cancel_futures=True)


def shown(value: Any) -> Any:
    """As JSON knows it: paths are texts, places are lists, NumPy's numbers are numbers."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Map):
        return repr(value)
    if isinstance(value, Mapping):
        return {name: shown(it) for name, it in value.items()}
    if isinstance(value, (list, tuple)):
        return [shown(it) for it in value]
    return value.item() if hasattr(value, "item") else value


def known(value: Any) -> Any:
    """JSON has no "not a number"."""
    return None if isinstance(value, float) and not math.isfinite(value) else value


def key_of(combination: Mapping[str, Any]) -> str:
    return json.dumps({name: shown(value) for name, value in combination.items()}, sort_keys=True)


def rows_of(out: PathLike | None, head: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """The rows of an earlier call, by the key of their combination. Raises ValueError when it was another sweep."""
    if out is None or not Path(out).exists() or Path(out).stat().st_size == 0:
        return {}
    known, rows = read_lines(out)
    if {name: known.get(name) for name in head} != json.loads(json.dumps(head)):
        raise ValueError(f"{os.fspath(out)}: is of another sweep (commit or fixed arguments differ): name another file")
    return {json.dumps(row.pop("combination"), sort_keys=True): row for row in rows}


def drop_cut_line(file: Path) -> None:
    """The last line, where its writer was killed before it was whole."""
    text = file.read_bytes()
    os.truncate(file, text.rfind(b"\n") + 1)


class Rows:
    """Keeps rows, and appends them to a file where there is one."""

    def __init__(self, out: PathLike | None, head: dict[str, Any], rows: dict[str, dict[str, Any]]) -> None:
        self._rows = rows
        self._file: IO[str] | None = None
        if out is not None:
            is_new = not rows
            if not is_new:
                drop_cut_line(Path(out))
            self._file = open(out, "w" if is_new else "a", encoding="utf-8")
            if is_new:
                self._write({"head": head})

    def add(self, combination: Mapping[str, Any], figures: Mapping[str, Any]) -> None:
        row = {**{name: shown(value) for name, value in combination.items()}, **{name: known(it) for name, it in figures.items()}}
        self._rows[key_of(combination)] = row
        self._write({"combination": json.loads(key_of(combination)), **row})

    def _write(self, line: Mapping[str, Any]) -> None:
        if self._file is not None:
            self._file.write(json.dumps(line) + "\n")
            self._file.flush()

    def __enter__(self) -> Rows:
        return self

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            self._file.close()
