"""Draws runs of two-dimensional scenes: particles with velocities, principal stresses, pressure, time series.

With several runs their names go before the pictures'; the time series of all are on one sheet. They are left out where the
scene follows no particle, unless they are asked for.
"""

import warnings

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation

from ..errors import Error
from .flat_run import Run
from .style import (COMPRESSION, GROUPS, RUNS, SPRAY, TENSION, WALL, circles, nice, plt, text_with_unit, time_text,
                    unit_for)

PICTURES = ("particles", "pressure", "strip", "series")
OPTIONS = ("time", "dynamic", "average")


# ---- pieces -------------------------------------------------------------------------------------------------


def colours_of(run):
    """One for each group."""
    fresh = iter(GROUPS * len(run.names))
    return [WALL if kind == "wall" else SPRAY if name in run.sprays else next(fresh)
            for name, kind in zip(run.names, run.kinds)]


def view_of(run, snapshots):
    """All particles of the start, and what rises above them; x and y limits."""
    frame = run.first["position"]
    if not len(frame):
        raise Error(f"{run.first.path}: there are no particles in it")
    low, high = frame.min(axis=0), frame.max(axis=0)
    top = max(np.quantile(np.append(s["position"][~s.where(kind="wall"), 1], low[1]), 0.995) for s in snapshots)
    highest = high[1] + 0.25 * (high[1] - low[1])
    high[1] = max(high[1], min(top, highest))
    return np.array([low - 1.5 * run.spacing, high + 1.5 * run.spacing])


def panels(view, number, width, below):
    """A figure with `number` panels of `width` inches side by side and `below` inches under them."""
    extent = view[1] - view[0]
    height, left, gap, above = width * extent[1] / extent[0], 0.65, 0.25, 0.8
    size = np.array([left + number * (width + gap), below + height + above])
    figure = plt.figure(figsize=size)
    for k in range(number):
        axes = figure.add_axes([(left + k * (width + gap)) / size[0], below / size[1],
                                width / size[0], height / size[1]])
        axes.set(xlim=view[:, 0], ylim=view[:, 1], xlabel="x (m)")
        axes.tick_params(labelleft=k == 0)
    figure.axes[0].set_ylabel("y (m)")
    return figure, list(figure.axes)


def head(figure, text):
    """Over the left edge of the first panel."""
    points = 72 * (figure.get_figwidth() - 0.8)
    figure.axes[0].annotate(text, (0, 1), (0, 38), xycoords="axes fraction", textcoords="offset points",
                            va="center", fontsize=min(13, points / 0.62 / len(text)), weight="bold")


def note(axes, text):
    """Small print under the right end of the panel."""
    axes.annotate(text, (1, 0), (0, -27), xycoords="axes fraction", textcoords="offset points", ha="right",
                  va="center", fontsize=8, color="#666666")


def beyond(snapshot, view):
    count = int(np.sum(np.any((snapshot["position"] < view[0]) | (snapshot["position"] > view[1]), axis=1)))
    return f"{count} not shown" if count else ""


def scale_bar(axes, length, text):
    """Over the right end of the panel; length in data units."""
    left, right = axes.get_xlim()
    where = axes.get_xaxis_transform()
    axes.plot([right - length, right], [1.02] * 2, transform=where, clip_on=False, color="black", linewidth=1.8)
    axes.text(right - length - 0.015 * (right - left), 1.02, text, transform=where, ha="right", va="center")


def group_handles(run, counts=None):
    handles = []
    for k, (name, colour) in enumerate(zip(run.names, colours_of(run))):
        label = name if counts is None else f"{name} ({counts[k]})"
        handles.append(Line2D([], [], marker="o", linestyle="", color=colour, markersize=7, label=label))
    return handles


BELOW = {"loc": "upper center", "handletextpad": 0.4, "columnspacing": 1.4}


def legend_below(axes, handles, ncols):
    """Under the name of the axis, however high the panel is."""
    down = ScaledTranslation(0, -28 / 72, axes.figure.dpi_scale_trans)
    axes.legend(handles=handles, ncols=ncols, bbox_to_anchor=(0.5, 0), bbox_transform=axes.transAxes + down, **BELOW)


# ---- pictures -----------------------------------------------------------------------------------------------


def quantile(values, share):
    """Of what is a number; 0 of nothing."""
    values = values[np.isfinite(values)]
    return np.quantile(values, share) if len(values) else 0.0


def draw_velocities(axes, run, snapshot):
    """Sticks start at the centres and taper towards where the particle goes."""
    circles(axes, snapshot["position"], snapshot.diameter, facecolors=np.array(colours_of(run))[snapshot["group"]])
    movers = ~snapshot.where(kind="wall") & np.isfinite(snapshot["velocity"]).all(axis=1)
    position, velocity = snapshot["position"][movers], snapshot["velocity"][movers]
    speed = np.hypot(*velocity.T)
    fast = next((fast for fast in (quantile(speed, 0.98), speed.max(initial=0)) if fast > 0), 1.0)
    metres = 3 * run.spacing / fast  # of stick per m/s
    across = np.stack([-velocity[:, 1], velocity[:, 0]], axis=1) / np.maximum(speed, 1e-300)[:, None]
    across *= 0.11 * run.spacing
    corners = np.stack([position + across, position + metres * velocity, position - across], axis=1)
    axes.add_collection(PolyCollection(corners, facecolors="black", edgecolors="black", linewidths=0.15))
    scale_bar(axes, metres * nice(1.5 * fast), text_with_unit(nice(1.5 * fast), "m/s"))


def draw_stresses(axes, run, snapshot, dynamic):
    """Two lines along the principal axes; none longer than a spacing, so that crosses do not overlap."""
    greater, smaller, angle = snapshot.principal_stresses(run.at_rest(snapshot) if dynamic else None)
    tint = np.array([to_rgba(c, 0.3) for c in colours_of(run)])
    tint[np.bincount(snapshot["group"], minlength=1).argmax(), 3] = 0  # what fills the container stays white
    circles(axes, snapshot["position"], snapshot.diameter, facecolors=tint[snapshot["group"]])
    largest = quantile(np.maximum(np.abs(greater), np.abs(smaller)), 0.99)
    per_pascal = run.spacing / largest if largest > 0 else 0.0
    for value, turn in ((greater, angle), (smaller, angle + np.pi / 2)):
        length = np.minimum(np.abs(value) * per_pascal, run.spacing)
        arm = 0.5 * length[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        ends = np.stack([snapshot["position"] - arm, snapshot["position"] + arm], axis=1)
        axes.add_collection(LineCollection(ends, colors=np.where(value > 0, TENSION, COMPRESSION), linewidths=0.9))
    bar = nice(4 * largest)
    scale_bar(axes, bar * per_pascal, text_with_unit(bar, "Pa"))
    labels = ("above hydrostatic", "below") if dynamic else ("compression", "tension")
    handles = [Line2D([], [], color=c, label=label) for c, label in zip((COMPRESSION, TENSION), labels)]
    legend_below(axes, handles, 2)
    cut = int(np.sum((np.abs(greater) > largest) | (np.abs(smaller) > largest)))
    return f"{cut} larger ones cut at {text_with_unit(float(f'{largest:.2g}'), 'Pa')}" if cut else ""


def draw_particles(run, snapshot, dynamic):
    view = view_of(run, [snapshot])
    figure, (left, right) = panels(view, 2, 5.0, 0.95)
    draw_velocities(left, run, snapshot)
    counts = np.bincount(snapshot["group"], minlength=len(run.names))
    legend_below(left, group_handles(run, counts), 4)
    left.set_title("Particles and velocities")
    note(left, beyond(snapshot, view))
    note(right, draw_stresses(right, run, snapshot, dynamic))
    right.set_title("Principal stresses less hydrostatic" if dynamic else "Principal stresses")
    head(figure, run.heading(snapshot))
    return figure


def draw_map(figure, axes, run, snapshot, values, limits, colours, label):
    """Movers coloured by value, walls grey; a colour bar below. NaN: the particle's group has no such value."""
    walls = snapshot.where(kind="wall")
    chosen = ~walls & np.isfinite(values)
    for some, options in ((walls, {"facecolors": WALL}), (~walls & np.isnan(values), {"facecolors": "#e4e4e4"}),
                          (chosen, {"array": values[chosen], "cmap": plt.get_cmap(colours, 16), "clim": limits})):
        drawn = circles(axes, snapshot["position"][some], snapshot.diameter[some], **options)
    ends = bool(np.any(values[chosen] < limits[0])), bool(np.any(values[chosen] > limits[1]))
    box = axes.get_position()
    inch = 1 / figure.get_figheight()
    place = figure.add_axes([box.x0 + 0.05 * box.width, box.y0 - 0.78 * inch, 0.9 * box.width, 0.15 * inch])
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[ends]
    return figure.colorbar(drawn, cax=place, orientation="horizontal", label=label, extend=extend)


def pressure_maps(run, snapshot):
    """Title, values, limits, colours and label of what is drawn of the pressure."""
    movers = ~snapshot.where(kind="wall")
    low, high = (quantile(snapshot["pressure"][movers], share) for share in (0.002, 0.998))
    size, unit = unit_for(max(abs(low), abs(high)), "Pa")
    maps = [("Pressure", snapshot["pressure"] / size, (min(0, low / size), high / size if high > max(low, 0) else 1.0),
             "viridis", f"p less surface pressure ({unit})")]
    at_rest = run.at_rest(snapshot)
    if at_rest is not None:
        excess = snapshot["pressure"] - at_rest
        reach = quantile(np.abs(excess[movers]), 0.98)
        size, unit = unit_for(reach, "Pa")
        reach = reach / size if reach > 0 else 1.0
        maps.append(("Pressure less hydrostatic", excess / size, (-reach, reach), "RdBu_r",
                     f"p less pressure of the layers at rest ({unit})"))
    return maps


def draw_pressure(run, snapshot):
    view = view_of(run, [snapshot])
    gas = "void_fraction" in snapshot
    maps = pressure_maps(run, snapshot)
    number = len(maps) + gas
    figure, all_axes = panels(view, number, 3.6 if number == 3 else 4.4, 1.4)
    for axes, (title, values, limits, colours, label) in zip(all_axes, maps):
        draw_map(figure, axes, run, snapshot, values, limits, colours, label)
        axes.set_title(title)
    if gas:
        bubbly = np.array([g.get("eos") == "bubbly" for g in run.scene["group"]])[snapshot["group"]]
        bar = draw_map(figure, all_axes[-1], run, snapshot, np.where(bubbly, snapshot["void_fraction"], np.nan), (0, 0.8),
                       "YlGnBu", "volume fraction of gas ψ")
        for group in run.scene["group"]:
            for row in group.get("becomes", []):
                if "void_fraction_above" in row:
                    bar.ax.axvline(row["void_fraction_above"], color="black", linewidth=1.5)
        all_axes[-1].set_title("Gas (black line: fragmentation)" if run.sprays else "Gas")
    note(all_axes[0], beyond(snapshot, view))
    head(figure, run.heading(snapshot))
    return figure


def draw_strip(run):
    snapshots = run.spread(6)
    view = view_of(run, snapshots)
    figure, all_axes = panels(view, len(snapshots), 2.0, 0.8)
    for axes, snapshot in zip(all_axes, snapshots):
        circles(axes, snapshot["position"], snapshot.diameter, facecolors=np.array(colours_of(run))[snapshot["group"]])
        axes.set_title(f"t = {time_text(snapshot.time)}")
        note(axes, beyond(snapshot, view))
    figure.legend(handles=group_handles(run), ncols=len(run.names), bbox_to_anchor=(0.5, 0.3 / figure.get_figheight()),
                  **BELOW)
    head(figure, run.title)
    return figure


def labels_of(runs):
    """A letter each, as in the paper (s, f, g), where folder names allow it; else the whole names."""
    letters = [run.name[0] for run in runs]
    return letters if len(set(letters)) == len(runs) else [run.name for run in runs]


def spread(values, least):
    """The values, moved apart to at least `least`, in their order."""
    order = np.argsort(values, kind="stable")
    places = np.array(values, dtype=float)
    for below, above in zip(order, order[1:]):
        places[above] = max(places[above], places[below] + least)
    return places - np.mean(places - values)


def follows_a_particle(run):
    return run.tracked() is not None and f"{run.tracked()}_y" in run.series


def series_of(run):
    """Times and what is drawn of the tracked particle, in SI units."""
    table, monitor = run.series, run.tracked()
    if not follows_a_particle(run):
        raise Error(f"{run.folder / 'series.csv'}: the scene follows no particle: give it a [[monitor]]")
    return table, {name: table[f"{monitor}_{name}"] for name in ("y", "vy", "rho", "p")}


def draw_series(runs):
    data = [series_of(run) for run in runs]
    size, unit = unit_for(max(np.abs(values["p"]).max(initial=0) for _, values in data), "Pa")
    quantities = (("y", "height y (m)", 1), ("vy", "velocity $v_y$ (m/s)", 1), ("rho", "density ρ (kg/m³)", 1),
                  ("p", f"p less surface pressure ({unit})", size))
    colours = RUNS * len(runs)
    figure, grid = plt.subplots(2, 2, figsize=(11, 7.2), sharex=True, layout="constrained")
    handles, ends = [], {axes: [] for axes in grid.flat}
    for run, (table, tracked), label, colour in zip(runs, data, labels_of(runs), colours):
        text = f"{label}: {run.title}" if len(runs) > 1 else run.title
        handles.append(Line2D([], [], color=colour, label=text))
        broke = run.fragmentation(table)
        if broke is not None:
            handles.append(Line2D([], [], color=colour, linestyle=":", label=f"first fragmentation, {broke:.1f} s"))
        for axes, (quantity, _, unit) in zip(grid.flat, quantities):
            values = tracked[quantity] / unit
            axes.plot(table["t"], values, color=colour, linewidth=0.9, marker="o" if len(values) < 3 else None)
            if broke is not None:
                axes.axvline(broke, color=colour, linewidth=1, linestyle=":")
            ends[axes].append((table["t"][-1], values[-1]))
    for axes, (_, title, _) in zip(grid.flat, quantities):
        axes.set_ylabel(title)
        axes.ticklabel_format(useOffset=False)
        axes.grid(True)
        axes.margins(x=0)
        if len(runs) > 1:
            time, values = np.array(ends[axes]).T
            places = spread(values, 0.05 * np.ptp(axes.get_ylim()))
            for label, colour, t, place in zip(labels_of(runs), colours, time, places):
                axes.annotate(label, (t, place), xytext=(4, 0), textcoords="offset points", color=colour,
                              va="center", weight="bold")
    for axes in grid[1]:
        axes.set_xlabel("time t (s)")
    figure.get_layout_engine().set(rect=(0, 0.06, 1, 0.89))
    figure.legend(handles=handles, loc="lower center", ncols=4)
    figure.text(0.01, 0.975, "Height, velocity, density and pressure of the tracked particle", va="center",
                fontsize=13, weight="bold")
    return figure


def pictures(runs, given):
    """Names and figures, one after the other."""
    for run in runs:
        if given.dynamic and run.at_rest(run.first) is None:
            raise Error(f"--dynamic: nothing is hydrostatic in {run.folder}: no gravity, or an ideal gas")
        prefix = f"{run.name}_" if len(runs) > 1 else ""
        snapshot = (run[-1] if given.time is None else run.at(given.time)).averaged(given.average)
        if "particles" in given.draw:
            yield f"{prefix}particles.png", draw_particles(run, snapshot, given.dynamic)
        if "pressure" in given.draw:
            yield f"{prefix}pressure.png", draw_pressure(run, snapshot)
        if "strip" in given.draw and len(run) >= 3:
            yield f"{prefix}strip.png", draw_strip(run)
    silent = next((run for run in runs if not follows_a_particle(run)), None) if "series" in given.draw else None
    if silent is not None and not given.chosen:
        warnings.warn(f"no series.png: the scene of {silent.folder} follows no particle: give it a [[monitor]]", stacklevel=1)
    elif "series" in given.draw:
        yield "series.png", draw_series(runs)
