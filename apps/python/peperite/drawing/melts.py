"""Draws runs with melts: their cells in a vertical plane, grains where they cross it, and time series.

The columns of the picture of the plane are times, the start and the end among them (or the snapshot nearest to
one time), its rows the temperature with isotherms and the share of the second melt with the interface, as far as the
scene has them, else the speed. Arrows are the flow. In three dimensions the plane is the layer of cells nearest to the middle,
along the longer horizontal axis. The series are left out where the scene has no monitor of melts, unless they are asked for.
"""

import numpy as np
from matplotlib import patheffects
from matplotlib.ticker import MaxNLocator

from ..errors import Error
from . import style
from .melt_run import Run
from .style import nice, plt

PICTURES = ("plane", "series")
OPTIONS = ("time",)
TIMES = 3  # columns of a picture
ARROWS = 18  # along the longer side


def rows_of(run, snapshots):
    """What is drawn: name, unit, colours, lines and their colour, values in the plane at each time."""
    def planes(field):
        return [run.plane.of(s.cell(field)) for s in snapshots]
    rows = []
    if run.heated:
        rows.append(("temperature", "K", "inferno", ("isotherms", "white"), planes("temperature")))
    if run.mixed:
        rows.append((f"share of {run.melts[1]}", "1", "cividis", ("interface", "red"), planes("composition")))
    if not rows:
        rows.append(("speed", "m/s", "viridis", None, [np.hypot(*run.plane.velocity(s)) for s in snapshots]))
    return rows


def levels_of(low, high, lines):
    """Of the contour lines: round numbers, or the middle between two melts."""
    if lines is None or not high > low:
        return []
    if lines[0] == "interface":
        return [0.5]
    step = nice((high - low) / 6)
    return step * np.arange(np.floor(low / step) + 1, np.ceil(high / step))


def draw_field(axes, run, values, limits, colours, metre):
    extent = np.stack([run.plane.low, run.plane.high], axis=1).ravel() / metre
    return axes.imshow(values, origin="lower", extent=extent, cmap=plt.get_cmap(colours, 24), clim=limits,
                       interpolation="nearest")


def draw_lines(axes, run, values, levels, metre, **colour):
    inside = [level for level in levels if values.min() < level < values.max()]
    along, up = (run.grid.centres(axis) / metre for axis in run.plane.axes)
    if inside:
        axes.contour(along, up, values, levels=inside, linewidths=1.0, **colour)


def fastest(run, snapshots):
    speeds = np.concatenate([np.hypot(*run.plane.velocity(s)).ravel() for s in snapshots])
    return np.quantile(speeds, 0.99)


def draw_arrows(axes, run, snapshot, fast, metre):
    """Means over blocks of cells; the fastest are as long as a block, and those that would be dots are left out."""
    plane = run.plane
    block = max(1, int(np.ceil(max(run.grid.cells[axis] for axis in plane.axes) / ARROWS)))
    counts = [run.grid.cells[axis] // block for axis in plane.axes]

    def means(values):
        whole = values[: counts[1] * block, : counts[0] * block]
        return whole.reshape(counts[1], block, counts[0], block).mean(axis=(1, 3))
    place = [means(x) / metre for x in np.meshgrid(*(run.grid.centres(axis) for axis in plane.axes))]
    velocity = [means(v) for v in plane.velocity(snapshot)]
    seen = np.hypot(*velocity) > 0.12 * fast
    length = block * min(run.grid.edge[axis] for axis in plane.axes) / metre
    return axes.quiver(*(x[seen] for x in place), *(v[seen] for v in velocity), pivot="mid", angles="xy",
                       scale_units="xy", scale=fast / length, color="white", width=0.0045, minlength=0,
                       path_effects=[patheffects.withStroke(linewidth=1.4, foreground="black")])


def draw_grains(axes, run, snapshot, metre, inch):
    """Discs; with thin edges where they are large enough. `inch`: of the picture, in units of the axes."""
    place, diameter, group = run.plane.discs(snapshot)
    if not len(place):
        return
    points = 72 * np.median(diameter) / metre / inch
    fills = dict(zip(run.grains, ("#e8e8e8", *style.GROUPS) * len(run.grains)))
    style.circles(axes, place / metre, diameter / metre, facecolors=[fills[k] for k in group], edgecolors="#222222",
                    linewidths=min(0.6, 0.08 * points))


def draw_plane(run, snapshots):
    """One column a snapshot, one row a quantity, each with a scale of its own."""
    plane, rows = run.plane, rows_of(run, snapshots)
    size = plane.high - plane.low
    metre, length = style.unit_for(size.max(), "m")
    height = min(3.8 * size[1] / size[0], 5.2)
    width = max(height * size[0] / size[1], 2.2)
    figure, grid = plt.subplots(len(rows), len(snapshots), squeeze=False, layout="compressed", sharex=True, sharey=True,
                                figsize=(len(snapshots) * (width + 0.3) + 1.8, len(rows) * (height + 0.3) + 1.1))
    figure.get_layout_engine().set(w_pad=0.06, h_pad=0.06)
    fast, arrows = fastest(run, snapshots), []
    for row, (name, unit, colours, lines, values) in zip(grid, rows):
        low, high = (0.0, 1.0) if unit == "1" else (min(v.min() for v in values), max(v.max() for v in values))
        per, unit = style.unit_for(high, unit) if unit == "m/s" else (1.0, unit)
        limits = (low / per, high / per) if high > low else (low / per - 0.5, low / per + 0.5)
        levels = levels_of(*limits, lines)
        for axes, snapshot, field in zip(row, snapshots, values):
            image = draw_field(axes, run, field / per, limits, colours, metre)
            draw_grains(axes, run, snapshot, metre, size[0] / metre / width)
            if fast > 0:
                arrows.append(draw_arrows(axes, run, snapshot, fast, metre))
            if len(levels):
                draw_lines(axes, run, field / per, levels, metre, colors=style.LINES[lines[1]])
        label = name if unit == "1" else f"{name} ({unit})"
        bar = figure.colorbar(image, ax=list(row), label=f"{label}, {lines[1]}: {lines[0]}" if len(levels) else label,
                              shrink=0.95, aspect=24, pad=0.015)
        if len(levels):
            bar.ax.hlines(levels, 0, 1, transform=bar.ax.get_yaxis_transform(), colors=style.LINES[lines[1]], linewidth=1)
        row[0].set_ylabel(f"{'xyz'[plane.up]} ({length})")
    for axes, snapshot in zip(grid[0], snapshots):
        axes.set_title(f"t = {style.clock_text(snapshot.time, run.clock)}")
    for axes in grid[-1]:
        axes.set_xlabel(f"{'xyz'[plane.along]} ({length})")
    if fast > 0:
        key = style.nice(fast)
        grid[0, -1].quiverkey(arrows[len(snapshots) - 1], 0.94, 1.04, key, style.text_with_unit(key, "m/s"), labelpos="W",
                              coordinates="axes", color="black", labelsep=0.08)
    figure.suptitle(run.title + plane.title(), x=0.01, ha="left", fontsize=13, weight="bold")
    return figure


def draw_series(run):
    """Root of the mean square of the velocity, heat through the sides, iterations of the flow."""
    name = run.monitor()
    table = run.series
    heat, quantity = run.heat(table)
    size, unit = (run.clock[1], run.clock[0]) if run.clock else style.unit_for(table["t"][-1], "s")
    time = table["t"] / size
    per, speed = style.unit_for(np.nanmax(table[f"{name}_v_rms"]), "m/s")
    panels = [(f"$v_{{rms}}$ of the flow ({speed})", [("", table[f"{name}_v_rms"] / per)])]
    panels += [(quantity, heat)] if heat else []
    panels += [("iterations of the flow", [("", table[f"{name}_iterations"])])]
    figure, all_axes = plt.subplots(len(panels), 1, squeeze=False, sharex=True, layout="constrained",
                                    figsize=(8, 0.8 + 2.2 * len(panels)))
    for axes, (label, curves) in zip(all_axes[:, 0], panels):
        for (text, values), colour in zip(curves, style.RUNS * len(curves)):
            # One time alone would be no line.
            axes.plot(time, values, color=colour, linewidth=1.2, label=text, marker="o" if len(time) < 3 else None)
        axes.set_ylabel(label)
        axes.grid(True)
        axes.margins(x=0.01)
        axes.ticklabel_format(axis="y", useOffset=False)
        if label.startswith("iterations"):
            axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        if len(curves) > 1 or curves[0][0]:
            axes.legend()
    all_axes[-1, 0].set_xlabel(f"time t ({unit})")
    figure.suptitle(run.title, x=0.01, ha="left", fontsize=13, weight="bold")
    return figure


def pictures(runs, given):
    """Names and figures, one after the other."""
    for run in runs:
        prefix = f"{run.name}_" if len(runs) > 1 else ""
        if "plane" in given.draw:
            snapshots = run.spread(TIMES) if given.time is None else [run.at(given.time)]
            yield f"{prefix}plane.png", draw_plane(run, snapshots)
        if "series" not in given.draw:
            continue
        if run.monitor() is not None:
            yield f"{prefix}series.png", draw_series(run)
        elif given.chosen:
            raise Error(f"{run.folder}: its scene has no [[monitor]] of kind \"melt\"")
