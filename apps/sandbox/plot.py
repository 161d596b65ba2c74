#!/usr/bin/python3
"""Draws and measures runs of the sandbox and of its shear boxes.

    plot.py DIR [DIR ...] [--out DIR] [--draw layers,strain,chains,stress,history,shear]

DIR is the folder of a run: one of the sandbox, any of shear_sand.toml and shear_floor.toml. Writes pictures and
summary.txt into the first DIR, or into --out, and prints the path of each picture and the summary. The shear boxes
give the angles of friction from which the theory of the critical taper follows; without them those measured by
gallery.sh are taken.
"""

import sys

import numpy as np

from grain_run import Run, peperite  # which finds the package
from peperite.drawing.command import drawn, parser_of, refusing, show

from forces import Contacts
from history import History
from shear_box import MEASURED, ShearBox, angles
from wedge import critical_taper, thrust_dips

PICTURES = ("layers", "strain", "chains", "stress", "history", "shear")


def theory(sand, floor):
    """What the critical taper says with the angles at the peak and after it."""
    for k, name in enumerate(("peak", "residual")):
        forward, back = thrust_dips(sand[k], floor[k])
        yield (f"critical taper with {name} friction, sand {sand[k]:.1f} deg, floor {floor[k]:.1f} deg: taper at "
               f"least {critical_taper(sand[k], floor[k]):.1f} deg, forward thrusts dip {forward:.1f} deg, back "
               f"thrusts {back:.1f} deg, in the flat layer both {45 - sand[k] / 2:.1f} deg")


def measured(history):
    last = history.moments[-1]
    yield f"shortening {100 * last.shortening:.2f} cm of a layer {1e3 * history.rest:.1f} mm high"
    late = [m.taper for m in history.moments if m.shortening >= 0.6 * last.shortening and np.isfinite(m.taper)]
    if late:
        yield (f"taper over the last 40 %: {np.mean(late):.1f} deg, {min(late):.1f} to "
               f"{max(late):.1f} deg")
    yield (f"highest point {1e3 * last.surface.height.max():.1f} mm, front of the rise "
           f"{100 * (last.front - last.wall):.1f} cm ahead of the wall")
    for name, (dip, spread) in zip(("forward", "back"), history.dips()):
        if np.isfinite(dip):
            yield f"{name} thrusts dip {dip:.1f} +- {spread:.1f} deg"
    for k, thrust in enumerate(history.thrusts):
        ahead = "" if k == 0 else (f", {(thrust.root - history.thrusts[k - 1].root) / history.rest:.1f} layer heights "
                                   f"ahead of the last")
        yield f"forward thrust {k + 1}: at {1e3 * thrust.shortening:.0f} mm, root x = {100 * thrust.root:.1f} cm{ahead}"


def from_contacts(history):
    for moment in (history.moments[0], history.moments[-1]):
        try:
            contacts = Contacts(moment.snapshot)
        except peperite.Error:
            return
        yield (f"contacts at {100 * moment.shortening:.1f} cm: coordination {contacts.coordination:.2f}, anisotropy "
               f"{contacts.anisotropy:.2f} along {contacts.direction:.0f} deg, mean force "
               f"{1e3 * contacts.mean_force:.2g} mN")


def is_shear_box(run):
    return any(wall["name"] == "lid" for wall in run.scene.get("wall", []))


def pictures(runs, given):
    """Names and figures, one after the other; then the summary."""
    boxes = [ShearBox(run) for run in runs if is_shear_box(run)]
    sandboxes = [run for run in runs if not is_shear_box(run)]
    if len(sandboxes) > 1:
        raise peperite.Error("more than one run of the sandbox: draw one after the other")
    import pictures  # only now: it takes a second, and refusals should not

    sand, floor = (found or known for found, known in zip(angles(boxes), MEASURED))
    lines, drawings = [box.text() for box in boxes], {}
    if boxes:
        drawings["shear"] = lambda: pictures.draw_shear(boxes)
    if sandboxes:
        history = History(sandboxes[0])
        lines += [*measured(history), *from_contacts(history)]
        for name in ("layers", "strain", "chains", "stress"):
            drawings[name] = lambda draw=getattr(pictures, f"draw_{name}"): draw(history)
        drawings["history"] = lambda: pictures.draw_history(history, sand, floor)
    lines += theory(sand, floor)
    for name in PICTURES:
        figure = drawings[name]() if name in given.draw and name in drawings else None
        if figure is not None:
            yield f"{name}.png", figure
    ((given.out or runs[0].folder) / "summary.txt").write_text("\n".join(lines) + "\n")
    print(*lines, sep="\n")


def main():
    given = parser_of(__doc__).parse_args()
    show(drawn(sys.modules[__name__], [Run(folder) for folder in given.runs], given))


if __name__ == "__main__":
    sys.exit(refusing(main))
