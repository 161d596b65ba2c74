"""What the command lines of all drawing share. A drawing module has PICTURES, Run, OPTIONS, the names of those options of
peperite.drawing that it has, and pictures(runs, given), which yields names and figures."""

import argparse
import math
import os
import sys
import warnings
from pathlib import Path

from ..errors import Error


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Error(message)


def finite(text):
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def folder(text):
    if not text:
        raise ValueError("no name")
    return Path(text)


def parser_of(description):
    parser = Parser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", metavar="DIR", nargs="+", help="folder of a run")
    parser.add_argument("--out", metavar="DIR", type=folder, help="where the pictures go (default: the first DIR)")
    parser.add_argument("--draw", metavar="LIST", help="some of the pictures (default: all that there is)")
    return parser


def drawn(module, runs, given):
    """Paths of the pictures, one after the other, each as it is written."""
    given.chosen = given.draw is not None
    given.draw = given.draw.split(",") if given.chosen else list(module.PICTURES)
    for name in given.draw:
        if name not in module.PICTURES:
            raise Error(f"--draw: \"{name}\" is not one of {', '.join(module.PICTURES)}")
    names = {run.name for run in runs}
    for k, run in enumerate(runs):
        run.title = str(run.title).replace("$", r"\$")  # matplotlib takes what is between dollars for formulas
        if run.name in {other.name for other in runs[:k]}:
            run.name = next(name for n in range(2, 10**9) if (name := f"{run.name}_{n}") not in names)
            names.add(run.name)
    out = given.out or runs[0].folder
    out.mkdir(parents=True, exist_ok=True)
    from .style import STYLE, plt, save  # only now: it takes a second, and refusals should not
    with plt.rc_context(STYLE):
        for name, figure in module.pictures(runs, given):
            save(figure, out / name)
            yield out / name


def show(paths):
    """Prints what a program draws, which has no window."""
    os.environ["MPLBACKEND"] = "Agg"
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_: print(f"{program()}: {message}", file=sys.stderr)
        for path in paths:
            print(path)


def program():
    name = Path(sys.argv[0]).name
    return "peperite" if name == "__main__.py" else name


def refusing(work):
    """Exit code of work(): 2 with one line for what it refuses."""
    try:
        work()
    except (Error, OSError) as error:
        print(f"{program()}: {error}", file=sys.stderr)
        return 2
    return 0
