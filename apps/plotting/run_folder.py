"""What the plotting scripts of all apps share: the folder of a run, its series, and refusals in one line."""

import argparse
import sys
from pathlib import Path

import numpy as np


class BadInput(Exception):
    """What is wrong with the arguments or with a file, in one line."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise BadInput(message)


def drawing_parser(description, pictures):
    """The arguments that every script has; given_to(parser, pictures) reads them."""
    parser = Parser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", metavar="DIR", nargs="+", help="folder of a run")
    parser.add_argument("--out", metavar="DIR", type=Path, help="where the pictures go (default: the first DIR)")
    parser.add_argument("--draw", metavar="LIST", help=f"some of {','.join(pictures)} (default: all that there is)")
    return parser


def given_to(parser, pictures):
    given = parser.parse_args()
    given.chosen = given.draw is not None
    given.draw = given.draw.split(",") if given.chosen else list(pictures)
    for name in given.draw:
        if name not in pictures:
            parser.error(f"--draw: \"{name}\" is not one of {', '.join(pictures)}")
    return given


def refusing(work):
    """Exit code of work(): 2 with one line for what it refuses."""
    try:
        work()
    except (BadInput, OSError) as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 2
    return 0


class RunFolder:
    """Snapshots, each read by `snapshot`, in the order of their steps, and the time series."""

    def __init__(self, folder, snapshot):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise BadInput(f"{folder}: no such folder")
        self.snapshots = sorted((snapshot(p) for p in self.folder.glob("snapshot_*.h5")), key=lambda s: s.step)
        if not self.snapshots:
            raise BadInput(f"{folder}: no snapshot_*.h5 in it")
        self.scene = self.snapshots[-1].scene
        self.name = self.folder.resolve().name
        self.title = self.scene.get("title", self.name)

    def series(self, *needed):
        """Columns by name. A last line that is not complete is left out: the run may still be writing."""
        path = self.folder / "series.csv"
        try:
            lines = path.read_text().rpartition("\n")[0].splitlines()
            names = lines[0].split(",") if lines else []
            rows = [[float(value) for value in line.split(",")] for line in lines[1:]]
            if "t" not in names or not rows:
                raise ValueError("no time series in it")
            if any(len(row) != len(names) for row in rows):
                raise ValueError("lines of different lengths")
        except (OSError, ValueError) as error:
            raise BadInput(f"{path}: cannot read it: {error}") from None
        table = dict(zip(names, np.array(rows).T))
        for name in needed:
            if name not in table:
                raise BadInput(f"{path}: no column {name}: the scene lacks its [[monitor]]")
        return table
