#!/usr/bin/python3
"""Draws any run, by the script for its kind of scene.

    plot.py DIR [DIR ...] [--out DIR] [--time T] [--draw LIST]

DIR is the folder of a run (snapshot_<step>.h5 and series.csv). Melts: plotting/melt.py; what else has two dimensions:
buoyant_cylinder/plot.py; the sandbox and its shear boxes: sandbox/plot.py; everything else in three: plotting/plain.py.
Each says with --help what it draws.
"""

import os
import sys
import tomllib
from pathlib import Path

import h5py

here = Path(__file__).resolve().parent
sys.path.append(str(here / "plotting"))
from run_folder import BadInput, drawing_parser, refusing  # noqa: E402


def scene_of(folder):
    if not Path(folder).is_dir():
        raise BadInput(f"{folder}: no such folder")
    snapshots = sorted(Path(folder).glob("snapshot_*.h5"))
    if not snapshots:
        raise BadInput(f"{folder}: no snapshot_*.h5 in it")
    try:
        with h5py.File(snapshots[-1]) as file:
            return tomllib.loads(file.attrs["scene"])
    except (OSError, KeyError, ValueError) as error:
        raise BadInput(f"{snapshots[-1]}: not a snapshot: {error}") from None


def script_for(scene):
    walls = {wall["name"] for wall in scene.get("wall", [])}
    pushed = {change["name"] for stage in scene.get("stage", []) for change in stage.get("wall", [])
              if any(change.get("velocity", []))}
    if any(group["kind"] == "melt" for group in scene["group"]):
        return "plotting/melt.py"
    if scene["dimension"] == 2:
        return "buoyant_cylinder/plot.py"
    # The sandbox has a back wall that is pushed, its shear boxes a lid over a bottom that slides.
    if "back" in pushed or {"lid", "bottom"} <= walls and "bottom" in pushed:
        return "sandbox/plot.py"
    return "plotting/plain.py"


def main():
    parser = drawing_parser(__doc__, ["those that the script has"])
    for option in ("--time", "--average"):
        parser.add_argument(option, help="as the script says")
    given, _ = parser.parse_known_args()
    scripts = {script_for(scene_of(folder)) for folder in given.runs}
    if len(scripts) > 1:
        raise BadInput("runs of different kinds: draw one after the other")
    os.execv(sys.executable, [sys.executable, "-B", str(here / scripts.pop()), *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(refusing(main))
