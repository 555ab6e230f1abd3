"""Results of sweeps, from Python or from the command line, as pandas frames."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pandas as pd

from ._maps import PathLike


def read_results(path: PathLike) -> pd.DataFrame:
    """Reads a file of `sweep(out=...)` or of `aisle lab sweep`: JSON Lines (`.jsonl`), or CSV (`.csv`) with comment lines; of a
    folder that the command line wrote, its `results.jsonl`.

    One row a run. `frame.attrs["head"]` holds what the file says of itself, e.g. the commit. Raises FileNotFoundError for a
    file that does not exist, and ValueError, with file and line, for one that is neither.
    """
    file = Path(path)
    if file.is_dir():
        file = file / "results.jsonl"
    if file.suffix == ".jsonl":
        head, rows = read_lines(file)
        frame = pd.json_normalize([{name: it for name, it in row.items() if name != "combination"} for row in rows])
    elif file.suffix == ".csv":
        head = comments_of(file)
        frame = pd.read_csv(file, skiprows=len(head))
    else:
        raise ValueError(f"{os.fspath(path)}: is neither .jsonl nor .csv")
    frame.attrs["head"] = head
    return frame


def read_lines(path: PathLike) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """The head and the rows. A last line that was cut off when its writer was killed is no row."""
    text = text_of_file(path)
    if text and "\n" not in text and not is_json(text):
        raise ValueError(f"{os.fspath(path)}:1: is cut within its first line, and holds no row: delete it")

    lines: list[dict[str, Any]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        try:
            lines.append(json.loads(line))
        except json.JSONDecodeError as error:
            if number == len(text.splitlines()) and not text.endswith("\n"):
                break
            raise ValueError(f"{os.fspath(path)}:{number}: is no JSON: {error.msg}") from None
    head = lines[0].get("head", {}) if lines else {}
    return head, [line for line in lines if "head" not in line]


def text_of_file(path: PathLike) -> str:
    """What is read of a file; FileNotFoundError says itself which one."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except FileNotFoundError:
        raise
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{os.fspath(path)}: cannot be read: {error}") from None


def is_json(text: str) -> bool:
    try:
        json.loads(text)
    except json.JSONDecodeError:
        return False
    return True


def comments_of(file: Path) -> dict[str, str]:
    """`# name: value` lines at the beginning of a CSV file."""
    head: dict[str, str] = {}
    for line in text_of_file(file).splitlines():
        if not line.startswith("#"):
            break
        name, _, value = line[1:].partition(":")
        head[name.strip()] = value.strip()
    return head
