"""The command line that all drawing modules share. A module has PICTURES, Run, more_arguments(parser) and
pictures(runs, given), which yields names and figures."""

import argparse
import math
import os
import sys
import warnings
from pathlib import Path

from ..errors import Error
from ..run import Run


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Error(message)


def finite(text):
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def time_argument(parser, help):
    parser.add_argument("--time", metavar="T", type=finite, help=help)


def parser_of(module):
    parser = Parser(description=module.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", metavar="DIR", nargs="+", help="folder of a run")
    parser.add_argument("--out", metavar="DIR", type=Path, help="where the pictures go (default: the first DIR)")
    parser.add_argument("--draw", metavar="LIST", help=f"some of {','.join(module.PICTURES)} (default: all that there is)")
    module.more_arguments(parser)
    return parser


def given_to(module, words):
    """What the words say; `chosen`: whether the pictures are named."""
    parser = parser_of(module)
    given = parser.parse_args(words)
    given.chosen = given.draw is not None
    given.draw = given.draw.split(",") if given.chosen else list(module.PICTURES)
    for name in given.draw:
        if name not in module.PICTURES:
            parser.error(f"--draw: \"{name}\" is not one of {', '.join(module.PICTURES)}")
    return given


def drawn(module, words):
    """Paths of the pictures, one after the other, each as it is written."""
    given = given_to(module, words)
    runs = [module.Run(folder) for folder in given.runs]
    for run in runs:
        run.title = str(run.title).replace("$", r"\$")  # matplotlib takes what is between dollars for formulas
    out = given.out or runs[0].folder
    out.mkdir(parents=True, exist_ok=True)
    from .style import STYLE, plt, save  # only now: it takes a second, and refusals should not
    with plt.rc_context(STYLE):
        for name, figure in module.pictures(runs, given):
            save(figure, out / name)
            yield out / name


def runs_in(words, doc):
    """The runs that a command line names, before it is known which options they have; none where it asks for help alone."""
    folders = [word for k, word in enumerate(words) if not word.startswith("-") and not words[k - 1].startswith("--")]
    if not folders and {"-h", "--help"} & set(words):
        print(doc)
    elif not folders:
        raise Error("the following arguments are required: DIR")
    return [Run(folder) for folder in folders]


def show(module, words):
    """Draws for a program, which has no window."""
    os.environ["MPLBACKEND"] = "Agg"
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_: print(f"{program()}: {message}", file=sys.stderr)
        for path in drawn(module, words):
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
