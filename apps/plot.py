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
import peperite  # noqa: E402
from peperite.drawing import module_for  # noqa: E402
from peperite.drawing.command import refusing, show  # noqa: E402


def is_sandbox(scene):
    """A back wall that is pushed; of its shear boxes a lid over a bottom that slides."""
    walls = {wall["name"] for wall in scene.get("wall", [])}
    pushed = {change["name"] for stage in scene.get("stage", []) for change in stage.get("wall", [])
              if any(change.get("velocity", []))}
    return "back" in pushed or {"lid", "bottom"} <= walls and "bottom" in pushed


def main():
    words = sys.argv[1:]
    folders = [word for k, word in enumerate(words) if not word.startswith("-") and not words[k - 1].startswith("--")]
    if not folders:
        if {"-h", "--help"} & set(words):
            print(__doc__)
            return
        raise peperite.Error("the following arguments are required: DIR")
    os.environ["MPLBACKEND"] = "Agg"
    scenes = [peperite.open(folder).scene for folder in folders]
    kinds = {is_sandbox(scene) or module_for(scene) for scene in scenes}
    if len(kinds) > 1:
        raise peperite.Error("runs of different kinds: draw one after the other")
    if is_sandbox(scenes[0]):
        os.execv(sys.executable, [sys.executable, "-B", str(here / "sandbox/plot.py"), *words])
    show(module_for(scenes[0]), words)


if __name__ == "__main__":
    sys.exit(refusing(main))
