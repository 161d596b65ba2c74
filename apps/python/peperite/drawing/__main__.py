"""Draws any run, by what its scene has.

    plot DIR [DIR ...] [--out DIR] [--time T] [--draw LIST]

DIR is the folder of a run (snapshot_<step>.h5 and series.csv). Which options there are depends on the run: plot DIR --help.
"""

import sys

from . import module_for
from .command import refusing, runs_in, show


def main():
    words = sys.argv[1:]
    runs = runs_in(words, __doc__)
    if runs:
        show(module_for(*(run.scene for run in runs)), words)


if __name__ == "__main__":
    sys.exit(refusing(main))
