"""Draws runs in three dimensions: fluids and solids in a slice through their middle, grains from the side.

Rows of the picture are times, the start and the end among them (or the snapshot nearest to one time).
Columns are the speed and, of fluids and solids, the pressure, of grains their displacement since the first snapshot, of
grains in a fluid their share of the volume.
The slice holds the particles within a spacing of the middle, those nearest to it on top.
"""

import numpy as np

from ..errors import Error
from ..run import Run as AnyRun
from . import style
from .style import circles, plt

PICTURES = ("slice", "side")
OPTIONS = ("time",)
TIMES = 3  # rows of a picture


class View:
    """The plane of a picture: along the longer axis across gravity (z where there is none), against the depth along
    the shorter one."""

    def __init__(self, snapshot):
        gravity = np.abs(snapshot.scene["domain"].get("gravity", [0, 0, 0]))
        self.up = int(np.argmax(gravity)) if np.any(gravity) else 2
        moving = snapshot["position"][snapshot.moves()]
        if not len(moving):
            raise Error(f"{snapshot.path}: nothing in it that moves")
        self.low, self.high = moving.min(axis=0), moving.max(axis=0)
        across = [axis for axis in range(3) if axis != self.up]
        self.along, self.depth = sorted(across, key=lambda axis: self.low[axis] - self.high[axis])
        self.middle = 0.5 * (self.low[self.depth] + self.high[self.depth])

    def flat(self, position):
        return position[:, [self.along, self.up]]

    def name(self, axis):
        return "xyz"[axis]


def sliced(run, snapshot, view):
    """What of a run of fluids and solids is drawn: rows, places in the plane, diameters, columns."""
    position = snapshot["position"]
    away = np.abs(position[:, view.depth] - view.middle)
    rows = np.argsort(-away, kind="stable")
    rows = rows[away[rows] < run.spacing]
    columns = {"speed": ("m/s", snapshot.speed()[rows])}
    density = snapshot["density"]
    fluid = density > 0  # of grains in a fluid there is none
    diameter = np.cbrt(snapshot["mass"] / np.where(fluid, density, 1))
    if run.mixed:
        diameter = np.where(fluid, diameter, 2 * snapshot["radius"])
        columns["share of grains"] = ("%", np.where(fluid, 100 * (1 - snapshot["porosity"]), np.nan)[rows])
        rows_last = np.argsort(~fluid[rows], kind="stable")  # over the fluid
        return (rows[rows_last], view.flat(position)[rows][rows_last], diameter[rows][rows_last],
                {name: (unit, values[rows_last]) for name, (unit, values) in columns.items()})
    columns["pressure"] = ("Pa", snapshot["pressure"][rows])
    return rows, view.flat(position)[rows], diameter[rows], columns


def from_the_side(run, snapshot, view):
    """Of a run of grains: all, the nearer ones over the farther ones."""
    position = snapshot["position"]
    rows = np.argsort(-position[:, view.depth], kind="stable")
    columns = {"speed": ("m/s", snapshot.speed()[rows])}
    if len(run) > 1:
        columns["displacement"] = ("m", np.linalg.norm(snapshot.displacement_since(run[0]), axis=1)[rows])
    return rows, view.flat(position)[rows], 2 * snapshot["radius"][rows], columns


class Run(AnyRun):
    def __init__(self, folder):
        super().__init__(folder)
        if self.scene["dimension"] != 3:
            raise Error(f"{folder}: the scene has {self.scene['dimension']} dimensions, this draws 3: take apps/plot.py")
        fields = self[-1].fields
        self.mixed = "radius" in fields and "density" in fields
        self.of_grains = "radius" in fields and not self.mixed
        self.spacing = self.scene["start"]["spacing"] if not self.of_grains else None


def draw(run, snapshots):
    """One row a snapshot, one column a quantity, each with a scale of its own."""
    view = View(run[0])
    parts = [(from_the_side if run.of_grains else sliced)(run, s, view) for s in snapshots]
    names = list(parts[0][3])
    frame = np.concatenate([view.flat(s["position"][s.moves()]) for s in snapshots])
    low, high = frame.min(axis=0), frame.max(axis=0)
    margin = 0.03 * (high - low).max() or 1.0  # of one point
    low, high = low - margin, high + margin
    metre, length = style.unit_for((high - low).max(), "m")
    width = 5.2
    height = min(max(width * (high - low)[1] / (high - low)[0], 1.2), 7.0)
    figure, grid = plt.subplots(len(parts), len(names), squeeze=False, layout="constrained",
                                figsize=(len(names) * (width + 0.9), len(parts) * (height + 0.75) + 1.3))
    for column, name in zip(grid.T, names):
        moving = [s.moves()[part[0]] for s, part in zip(snapshots, parts)]
        values = np.concatenate([part[3][name][1][free] for part, free in zip(parts, moving)])
        values = values[np.isfinite(values)]
        bottom, top = np.quantile(values, (0.002, 0.998)) if len(values) else (0.0, 0.0)
        bottom = min(bottom, 0.0)
        size, unit = style.unit_for(max(abs(bottom), abs(top)), parts[0][3][name][0])
        limits = (bottom / size, top / size) if top > bottom else (0.0, 1.0)
        for axes, snapshot, (_, place, diameter, columns), free in zip(column, snapshots, parts, moving):
            drawn = columns[name][1] / size
            place, diameter = place / metre, diameter / metre
            circles(axes, place[~free], diameter[~free], facecolors=style.WALL)
            shown = circles(axes, place[free], diameter[free], array=drawn[free], cmap=plt.get_cmap("viridis", 16),
                            clim=limits, linewidths=0)
            axes.set(xlim=(low[0] / metre, high[0] / metre), ylim=(low[1] / metre, high[1] / metre), aspect="equal",
                     title=f"{name.capitalize()}, t = {style.time_text(snapshot.time)}",
                     xlabel=f"{view.name(view.along)} ({length})", ylabel=f"{view.name(view.up)} ({length})")
        figure.colorbar(shown, ax=list(column), location="bottom", label=f"{name} ({unit})", extend="both",
                        shrink=0.8, aspect=40)
    where = "from the side" if run.of_grains else f"slice at {view.name(view.depth)} = {view.middle:.4g} m"
    figure.suptitle(f"{run.title}, {where}", x=0.01, ha="left", fontsize=13, weight="bold")
    return figure


def pictures(runs, given):
    """Names and figures, one after the other."""
    for run in runs:
        name = "side" if run.of_grains else "slice"
        if name not in given.draw:
            raise Error(f"{run.folder}: --draw: such a run has the picture {name}")
        snapshots = run.spread(TIMES) if given.time is None else [run.at(given.time)]
        yield f"{run.name}_{name}.png" if len(runs) > 1 else f"{name}.png", draw(run, snapshots)
