"""Builds the native module with CMake (preset `python`) for the interpreter that runs pip. Everything else is in
pyproject.toml."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

TOP = Path(__file__).resolve().parent.parent  # of Aisle's tree


class CMakeModule(build_ext):
    """Takes the module out of build/python, where CMake leaves it."""

    def build_extension(self, ext: Extension) -> None:
        configure = ["cmake", "--preset", "python", "--log-level=WARNING", f"-DPython_EXECUTABLE={sys.executable}"]
        subprocess.run(configure, cwd=TOP, check=True)
        jobs = os.environ.get("AISLE_JOBS", "")
        build = ["cmake", "--build", "--preset", "python", *(["-j", jobs] if jobs else [])]
        subprocess.run(build, cwd=TOP, check=True)

        wanted = Path(self.get_ext_fullpath(ext.name))
        wanted.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(TOP / "build/python/site/aisle_lab" / wanted.name, wanted)


setup(ext_modules=[Extension("aisle_lab._native", sources=[])], cmdclass={"build_ext": CMakeModule})
