"""Executes the notebooks of this folder and keeps them, with their outputs, in the folder that is named:
python3 python/notebooks/execute.py build/python/notebooks"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

HERE = Path(__file__).resolve().parent
LONGEST_CELL_S = 300


def execute(file: Path, into: Path) -> bool:
    """False when a cell failed, which is then printed."""
    begun = time.monotonic()
    notebook = nbformat.read(file, as_version=4)
    try:
        NotebookClient(notebook, timeout=LONGEST_CELL_S, resources={"metadata": {"path": str(HERE)}}).execute()
    except CellExecutionError as error:
        print(f"{file.name}: {error}", file=sys.stderr)
        return False
    finally:
        nbformat.write(notebook, into / file.name)
    print(f"{file.name}: executed in {time.monotonic() - begun:.0f} s")
    return True


def main() -> int:
    into = Path(sys.argv[1])
    into.mkdir(parents=True, exist_ok=True)
    done = [execute(file, into) for file in sorted(HERE.glob("*.ipynb"))]
    return 0 if done and all(done) else 1


if __name__ == "__main__":
    sys.exit(main())
