#!/usr/bin/python3
"""Draws runs of the magma chamber: grains in two melts that are heated from below. Any run with melts will do.

    plot.py DIR [DIR ...] [--out DIR] [--times T,T,...] [--draw isotherms,fraction,series,layer]

isotherms: grains where they cross a vertical plane, over the melts, with isotherms; the first, a middle and the last
snapshot, or those nearest to the times (s). fraction: the share of the volume that grains take, against height and time.
series: speed of the flow, heat through the sides, iterations. layer: thickness and mean fraction of the grains that the
interface holds up, where their fraction is at least half of its largest value above it, and how many fall through.
Without --draw it draws what there is: fraction and layer want grains, layer two melts, series a monitor of melts.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from peperite import Error  # noqa: E402
from peperite.drawing.command import drawn, finite, parser_of, refusing, show  # noqa: E402
from peperite.drawing.melt_run import Run  # noqa: E402

PICTURES = ("isotherms", "fraction", "series", "layer")


def times(text):
    try:
        return [finite(t) for t in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"not a list of numbers: \"{text}\"") from None


def arguments():
    parser = parser_of(__doc__)
    parser.add_argument("--times", metavar="LIST", type=times, help="isotherms: draw the snapshots nearest to these times (s)")
    return parser.parse_args()


def lacking(run):
    """Why a picture cannot be drawn."""
    reasons = {}
    if not run.grains:
        reasons["fraction"] = reasons["layer"] = "its scene has no grains"
    elif not run.mixed:
        reasons["layer"] = "its scene has one melt"
    if run.monitor() is None:
        reasons["series"] = "its scene has no [[monitor]] of kind \"melt\""
    return reasons


def figures(run, names, given):
    """Names and figures, one after the other."""
    import pictures  # only now: it takes a second, and refusals should not
    from layers import History
    from peperite.drawing.melts import draw_series
    history = History(run) if {"fraction", "layer"} & set(names) else None
    snapshots = run.spread(3) if given.times is None else [run.at(t) for t in given.times]
    draw = {"isotherms": lambda: pictures.draw_isotherms(run, snapshots), "series": lambda: draw_series(run),
            "fraction": lambda: pictures.draw_fractions(history), "layer": lambda: pictures.draw_layer(history)}
    for name in names:
        yield f"{name}.png", draw[name]()


def pictures(runs, given):
    for run in runs:
        for name, reason in lacking(run).items():
            if given.chosen and name in given.draw:
                raise Error(f"{run.folder}: --draw: no {name}: {reason}")
    for run in runs:
        prefix = f"{run.name}_" if len(runs) > 1 else ""
        names = [name for name in PICTURES if name in given.draw and name not in lacking(run)]
        for name, figure in figures(run, names, given):
            yield prefix + name, figure


def main():
    given = arguments()
    show(drawn(sys.modules[__name__], [Run(folder) for folder in given.runs], given))


if __name__ == "__main__":
    sys.exit(refusing(main))
