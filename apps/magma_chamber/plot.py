#!/usr/bin/python3
"""Draws runs of the magma chamber: grains in two melts that are heated from below. Any run with melts will do.

    plot.py DIR [DIR ...] [--out DIR] [--times T,T,...] [--draw isotherms,fraction,series,layer]

isotherms: grains where they cross a vertical plane, over the melts, with isotherms; the first, a middle and the last
snapshot, or those nearest to the times (s). fraction: the share of the volume that grains take, against height and time.
series: speed of the flow, heat through the sides, iterations. layer: thickness and mean fraction of the grains that the
interface holds up, where their fraction is at least half of its largest value above it, and how many fall through.
Without --draw it draws what there is: fraction and layer want grains, layer two melts, series a monitor of melts.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parent.parent / "plotting"))
from melt import draw_series  # noqa: E402
from melt_run import Run  # noqa: E402
from run_folder import BadInput, drawing_parser, given_to, refusing  # noqa: E402

PICTURES = ("isotherms", "fraction", "series", "layer")


def arguments():
    parser = drawing_parser(__doc__, PICTURES)
    parser.add_argument("--times", metavar="LIST", help="isotherms: draw the snapshots nearest to these times (s)")
    given = given_to(parser, PICTURES)
    try:
        given.times = [float(t) for t in given.times.split(",")] if given.times is not None else None
    except ValueError:
        parser.error("--times: not a list of numbers")
    if given.times is not None and not np.all(np.isfinite(given.times)):
        parser.error("--times: not finite")
    return given


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


def drawn(run, names, times):
    """Names and figures, one after the other."""
    import pictures  # only now: it takes a second, and refusals should not
    from layers import History
    history = History(run) if {"fraction", "layer"} & set(names) else None
    snapshots = run.spread(3) if times is None else [run.nearest(t) for t in times]
    draw = {"isotherms": lambda: pictures.draw_isotherms(run, snapshots), "series": lambda: draw_series(run),
            "fraction": lambda: pictures.draw_fractions(history), "layer": lambda: pictures.draw_layer(history)}
    for name in names:
        yield name, draw[name]()


def main():
    given = arguments()
    runs = [Run(folder) for folder in given.runs]
    for run in runs:
        for name, reason in lacking(run).items():
            if given.chosen and name in given.draw:
                raise BadInput(f"{run.folder}: --draw: no {name}: {reason}")
    out = given.out or runs[0].folder
    out.mkdir(parents=True, exist_ok=True)
    from figures import STYLE, plt, save
    plt.rcParams.update(STYLE)
    for run in runs:
        prefix = f"{run.name}_" if len(runs) > 1 else ""
        names = [name for name in PICTURES if name in given.draw and name not in lacking(run)]
        for name, figure in drawn(run, names, given.times):
            path = out / f"{prefix}{name}.png"
            save(figure, path)
            print(path)


if __name__ == "__main__":
    sys.exit(refusing(main))
