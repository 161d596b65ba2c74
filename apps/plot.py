#!/usr/bin/python3
"""Draws any run: the sandbox and its shear boxes by sandbox/plot.py, all else by the package peperite, which is in python/.

    plot.py DIR [DIR ...] [--out DIR] [--draw LIST] [--time T] [--dynamic] [--average time|space]

DIR is the folder of a run. What there is to draw: `peperite plot --help`, sandbox/plot.py --help.
"""

import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here / "python"))
import peperite  # noqa: E402
from peperite.drawing import draw, parser  # noqa: E402
from peperite.drawing.command import refusing, show  # noqa: E402


def is_sandbox(scene):
    """A back wall that is pushed; of its shear boxes a lid over a bottom that slides."""
    walls = {wall["name"] for wall in scene.get("wall", [])}
    pushed = {change["name"] for stage in scene.get("stage", []) for change in stage.get("wall", [])
              if any(change.get("velocity", []))}
    return "back" in pushed or {"lid", "bottom"} <= walls and "bottom" in pushed


def main():
    given = parser(__doc__).parse_args()
    if all(is_sandbox(peperite.open(folder).scene) for folder in given.runs):
        os.execv(sys.executable, [sys.executable, "-B", str(here / "sandbox/plot.py"), *sys.argv[1:]])
    show(draw(given))


if __name__ == "__main__":
    sys.exit(refusing(main))
