"""Pictures of any run: flat of two dimensions, solid of three, melts of slow flow on a grid.

    plot DIR [DIR ...] [--out DIR] [--draw LIST] [--time T] [--dynamic] [--average time|space]

Two dimensions: particles (with velocities and principal stresses), pressure, strip (six times), series (of the particle that a
monitor follows; all runs on one sheet). Three: slice of fluids and solids, side of grains. Melts: plane, series. With several runs
their names go before the pictures'.
"""

import importlib

from ..errors import Error
from ..run import Run
from .command import drawn, finite, parser_of

OPTIONS = ("time", "dynamic", "average")


def parser(description=__doc__):
    out = parser_of(description)
    out.add_argument("--time", metavar="T", type=finite, help="the snapshot nearest to T seconds")
    out.add_argument("--dynamic", action="store_true", help="two dimensions, stresses: leave the hydrostatic pressure out")
    out.add_argument("--average", choices=("time", "space"),
                     help="two dimensions: velocity and pressure averaged (output.average_time, average_space)")
    return out


def module_for(*scenes):
    """The one that draws all of them."""
    names = {"melts" if any(group["kind"] == "melt" for group in scene["group"]) else
             "flat" if scene["dimension"] == 2 else "solid" for scene in scenes}
    if len(names) > 1:
        raise Error("runs of different kinds: draw one after the other")
    return importlib.import_module(f".{names.pop()}", __name__)


def draw(given):
    """What parser() has read: paths of the pictures, one after the other."""
    module = module_for(*(Run(folder).scene for folder in given.runs))
    for option in OPTIONS:
        if getattr(given, option) and option not in module.OPTIONS:
            raise Error(f"--{option}: there is none for such runs")
    yield from drawn(module, [module.Run(folder) for folder in given.runs], given)


def draw_run(run, out=None, **options):
    """Draws a run into `out` or into its folder. Options are those of the command line."""
    words = [f"--{name}" if value is True else f"--{name}={value}" for name, value in options.items()
             if value is not None and value is not False]
    given = parser().parse_args([*words, "of a run"])
    given.runs, given.out = [run.folder], out if out is None else run.folder.__class__(out)
    yield from draw(given)
