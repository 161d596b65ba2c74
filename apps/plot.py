#!/usr/bin/python3
"""Draws any run, by what its scene has.

    plot.py DIR [DIR ...] [--out DIR] [--time T] [--draw LIST]

DIR is the folder of a run (snapshot_<step>.h5 and series.csv). Which options there are depends on the run: plot.py DIR --help.
The sandbox and its shear boxes are drawn by sandbox/plot.py, all else by the package peperite, which is in python/.
"""

import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here / "python"))
from peperite.drawing import module_for  # noqa: E402
from peperite.drawing.command import refusing, runs_in, show  # noqa: E402


def is_sandbox(scene):
    """A back wall that is pushed; of its shear boxes a lid over a bottom that slides."""
    walls = {wall["name"] for wall in scene.get("wall", [])}
    pushed = {change["name"] for stage in scene.get("stage", []) for change in stage.get("wall", [])
              if any(change.get("velocity", []))}
    return "back" in pushed or {"lid", "bottom"} <= walls and "bottom" in pushed


def main():
    words = sys.argv[1:]
    scenes = [run.scene for run in runs_in(words, __doc__)]
    if scenes and all(map(is_sandbox, scenes)):
        os.execv(sys.executable, [sys.executable, "-B", str(here / "sandbox/plot.py"), *words])
    if scenes:
        show(module_for(*scenes), words)


if __name__ == "__main__":
    sys.exit(refusing(main))
