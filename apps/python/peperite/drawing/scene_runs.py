"""Runs that a picture is made of: made where they are not there yet, on one rank each, two at a time."""

import argparse
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from ..errors import Error
from ..run import Run
from .style import save


def make(programs, scene, folder, settings):
    done = subprocess.run([str(Path(programs) / "peperite"), "run", str(scene), "--out", str(folder),
                           *(word for setting in settings for word in ("--set", setting))], capture_output=True, text=True)
    if done.returncode:
        raise Error(done.stderr.strip().split("\n")[0])


def drawn_from_runs(doc, scene, runs, draw, name):
    """A script's main. `scene`: its file; `runs`: by key, the run's name and what is set in its scene, the longest last;
    `draw(runs)` makes the figure, which is saved as NAME.png."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs")
    parser.add_argument("--out", help="default: RUNS")
    parser.add_argument("--programs", default="build/bin")
    given = parser.parse_args()
    folders = {key: Path(given.runs) / folder for key, (folder, _) in runs.items()}
    wanted = [key for key, folder in folders.items() if not (folder / "perf.json").is_file()]
    with ThreadPoolExecutor(2) as two:
        list(two.map(lambda key: make(given.programs, scene, folders[key], runs[key][1]), reversed(wanted)))
    save(draw({key: Run(folder) for key, folder in folders.items()}), Path(given.out or given.runs) / f"{name}.png")
