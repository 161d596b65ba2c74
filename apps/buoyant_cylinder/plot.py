#!/usr/bin/python3
"""Draws runs of two-dimensional scenes: particles with velocities, principal stresses, pressure, time series.

    plot.py DIR [DIR ...] [--out DIR] [--time T] [--dynamic] [--average time|space]
                          [--draw particles,pressure,strip,series]

DIR is the folder of a run (snapshot_<step>.h5 and series.csv). Writes into the first DIR, or into --out,
and prints the path of each picture. With several runs their names go before the pictures'; the time series
of all are on one sheet.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.colors import to_rgb, to_rgba
from matplotlib.lines import Line2D
from PIL import Image

from run_data import Run
from run_folder import drawing_parser, given_to, refusing

PICTURES = ("particles", "pressure", "strip", "series")
WALL, SPRAY = "#9a9a9a", "#1b2a49"
GROUPS = ("#f4c89a", "#4fa3a5", "#c97b84", "#a7b957", "#8d7fb8")  # in the order of the scene
RUNS = ("#1b6ca8", "#c8553d", "#3a7d44", "#7a4f9e", "#8a6d1d", "#444444")
TENSION, COMPRESSION = "#d62839", "#1d3557"

STYLE = {
    "font.size": 10, "axes.titlesize": 11, "axes.titlelocation": "left",
    "axes.edgecolor": "#555555", "axes.linewidth": 0.8, "axes.axisbelow": True, "grid.color": "#dddddd",
    "xtick.color": "#333333", "ytick.color": "#333333", "legend.frameon": False, "figure.dpi": 110,
}


# ---- pieces -------------------------------------------------------------------------------------------------


def nice(value):
    """The largest of 1, 2, 5 times a power of ten that is not above value."""
    if not value > 0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return power * max(f for f in (1, 2, 5) if f * power <= value * 1.0000001)


def pressure_text(value):
    for unit, size in (("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3)):
        if value >= size:
            return f"{value / size:g} {unit}"
    return f"{value:g} Pa"


def colours_of(run):
    """One for each group."""
    fresh = iter(GROUPS * len(run.names))
    return [WALL if kind == "wall" else SPRAY if name in run.sprays else next(fresh)
            for name, kind in zip(run.names, run.kinds)]


def view_of(run, snapshots):
    """The container, or all particles where there is none, and what rises above it; x and y limits."""
    walls = run.is_wall(snapshots[0])
    frame = snapshots[0].position[walls] if walls.any() else snapshots[0].position
    low, high = frame.min(axis=0), frame.max(axis=0)
    top = max(np.quantile(s.position[~run.is_wall(s), 1], 0.995) for s in snapshots)
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
    figure.axes[0].annotate(text, (0, 1), (0, 38), xycoords="axes fraction", textcoords="offset points",
                            va="center", fontsize=13, weight="bold")


def note(axes, text):
    """Small print under the right end of the panel."""
    axes.annotate(text, (1, 0), (0, -27), xycoords="axes fraction", textcoords="offset points", ha="right",
                  va="center", fontsize=8, color="#666666")


def beyond(snapshot, view):
    count = int(np.sum(np.any((snapshot.position < view[0]) | (snapshot.position > view[1]), axis=1)))
    return f"{count} not shown" if count else ""


def circles(axes, snapshot, chosen=slice(None), **options):
    diameter = snapshot.diameter[chosen]
    collection = EllipseCollection(diameter, diameter, 0, units="xy", offsets=snapshot.position[chosen],
                                   offset_transform=axes.transData, **options)
    return axes.add_collection(collection)


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


# ---- pictures -----------------------------------------------------------------------------------------------


def draw_velocities(axes, run, snapshot):
    """Sticks start at the centres and taper towards where the particle goes."""
    circles(axes, snapshot, facecolors=np.array(colours_of(run))[snapshot.group])
    movers = ~run.is_wall(snapshot)
    position, velocity = snapshot.position[movers], snapshot.velocity[movers]
    speed = np.hypot(*velocity.T)
    fast = np.quantile(speed, 0.98) if speed.any() else 1.0
    metres = 3 * run.spacing / fast  # of stick per m/s
    across = np.stack([-velocity[:, 1], velocity[:, 0]], axis=1) / np.maximum(speed, 1e-300)[:, None]
    across *= 0.11 * run.spacing
    corners = np.stack([position + across, position + metres * velocity, position - across], axis=1)
    axes.add_collection(PolyCollection(corners, facecolors="black", edgecolors="black", linewidths=0.15))
    scale_bar(axes, metres * nice(1.5 * fast), f"{nice(1.5 * fast):g} m/s")


def draw_stresses(axes, run, snapshot, dynamic):
    """Two lines along the principal axes; none longer than a spacing, so that crosses do not overlap."""
    greater, smaller, angle = snapshot.principal_stresses(dynamic)
    tint = np.array([to_rgba(c, 0.3) for c in colours_of(run)])
    tint[np.bincount(snapshot.group).argmax(), 3] = 0  # what fills the container stays white
    circles(axes, snapshot, facecolors=tint[snapshot.group])
    largest = np.quantile(np.maximum(np.abs(greater), np.abs(smaller)), 0.99)
    per_pascal = run.spacing / largest if largest > 0 else 0.0
    for value, turn in ((greater, angle), (smaller, angle + np.pi / 2)):
        length = np.minimum(np.abs(value) * per_pascal, run.spacing)
        arm = 0.5 * length[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        ends = np.stack([snapshot.position - arm, snapshot.position + arm], axis=1)
        axes.add_collection(LineCollection(ends, colors=np.where(value > 0, TENSION, COMPRESSION), linewidths=0.9))
    bar = nice(4 * largest)
    scale_bar(axes, bar * per_pascal, pressure_text(bar))
    labels = ("above hydrostatic", "below") if dynamic else ("compression", "tension")
    handles = [Line2D([], [], color=c, label=label) for c, label in zip((COMPRESSION, TENSION), labels)]
    axes.legend(handles=handles, ncols=2, bbox_to_anchor=(0.5, -0.06), **BELOW)
    cut = int(np.sum((np.abs(greater) > largest) | (np.abs(smaller) > largest)))
    return f"{cut} larger ones cut at {pressure_text(float(f'{largest:.2g}'))}" if cut else ""


def draw_particles(run, snapshot, dynamic):
    view = view_of(run, [snapshot])
    figure, (left, right) = panels(view, 2, 5.0, 0.95)
    draw_velocities(left, run, snapshot)
    counts = np.bincount(snapshot.group, minlength=len(run.names))
    left.legend(handles=group_handles(run, counts), ncols=4, bbox_to_anchor=(0.5, -0.06), **BELOW)
    left.set_title("Particles and velocities")
    note(left, beyond(snapshot, view))
    note(right, draw_stresses(right, run, snapshot, dynamic))
    right.set_title("Principal stresses less hydrostatic" if dynamic else "Principal stresses")
    head(figure, run.heading(snapshot))
    return figure


def draw_map(figure, axes, run, snapshot, values, limits, colours, label):
    """Movers coloured by value, walls grey; a colour bar below. NaN: the particle's group has no such value."""
    walls = run.is_wall(snapshot)
    circles(axes, snapshot, walls, facecolors=WALL)
    circles(axes, snapshot, ~walls & np.isnan(values), facecolors="#e4e4e4")
    chosen = ~walls & np.isfinite(values)
    drawn = circles(axes, snapshot, chosen, array=values[chosen], cmap=plt.get_cmap(colours, 16), clim=limits)
    ends = bool(np.any(values[chosen] < limits[0])), bool(np.any(values[chosen] > limits[1]))
    box = axes.get_position()
    inch = 1 / figure.get_figheight()
    place = figure.add_axes([box.x0 + 0.05 * box.width, box.y0 - 0.78 * inch, 0.9 * box.width, 0.15 * inch])
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[ends]
    return figure.colorbar(drawn, cax=place, orientation="horizontal", label=label, extend=extend)


def draw_pressure(run, snapshot):
    view = view_of(run, [snapshot])
    movers = ~run.is_wall(snapshot)
    gas = snapshot.void_fraction is not None
    figure, all_axes = panels(view, 3 if gas else 2, 3.6 if gas else 4.4, 1.4)
    pressure = snapshot.pressure / 1e6
    low, high = np.quantile(pressure[movers], (0.002, 0.998))
    draw_map(figure, all_axes[0], run, snapshot, pressure, (min(0, low), max(high, 1e-6)), "viridis",
             "p less surface pressure (MPa)")
    all_axes[0].set_title("Pressure")
    excess = (snapshot.pressure - snapshot.hydrostatic()) / 1e3
    reach = max(np.quantile(np.abs(excess[movers]), 0.98), 1e-3)
    draw_map(figure, all_axes[1], run, snapshot, excess, (-reach, reach), "RdBu_r",
             "p less pressure of melt at rest (kPa)")
    all_axes[1].set_title("Pressure less hydrostatic")
    if gas:
        bubbly = np.array([g.get("eos") == "bubbly" for g in run.scene["group"]])[snapshot.group]
        bar = draw_map(figure, all_axes[2], run, snapshot, np.where(bubbly, snapshot.void_fraction, np.nan), (0, 0.8),
                       "YlGnBu", "volume fraction of gas ψ")
        for group in run.scene["group"]:
            if "fragmentation" in group:
                bar.ax.axvline(group["fragmentation"]["void_fraction"], color="black", linewidth=1.5)
        all_axes[2].set_title("Gas (black line: fragmentation)" if run.sprays else "Gas")
    note(all_axes[0], beyond(snapshot, view))
    head(figure, run.heading(snapshot))
    return figure


def draw_strip(run):
    chosen = np.unique(np.linspace(0, len(run.snapshots) - 1, 6).round().astype(int))
    snapshots = [run.snapshots[k] for k in chosen]
    view = view_of(run, snapshots)
    figure, all_axes = panels(view, len(snapshots), 2.0, 0.8)
    for axes, snapshot in zip(all_axes, snapshots):
        circles(axes, snapshot, facecolors=np.array(colours_of(run))[snapshot.group])
        axes.set_title(f"t = {snapshot.time:.1f} s")
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


def draw_series(runs):
    quantities = (("y", "height y (m)", 1), ("vy", "velocity $v_y$ (m/s)", 1), ("rho", "density ρ (kg/m³)", 1),
                  ("p", "p less surface pressure (MPa)", 1e6))
    colours = RUNS * len(runs)
    figure, grid = plt.subplots(2, 2, figsize=(11, 7.2), sharex=True, layout="constrained")
    handles, ends = [], {axes: [] for axes in grid.flat}
    for run, label, colour in zip(runs, labels_of(runs), colours):
        table, monitor = run.series(), run.tracked()
        if monitor is None or f"{monitor}_y" not in table:
            raise BadInput(f"{run.folder / 'series.csv'}: the scene follows no particle: give it a [[monitor]]")
        text = f"{label}: {run.title}" if len(runs) > 1 else run.title
        handles.append(Line2D([], [], color=colour, label=text))
        broke = run.fragmentation(table)
        if broke is not None:
            handles.append(Line2D([], [], color=colour, linestyle=":", label=f"first fragmentation, {broke:.1f} s"))
        for axes, (quantity, _, unit) in zip(grid.flat, quantities):
            values = table[f"{monitor}_{quantity}"] / unit
            axes.plot(table["t"], values, color=colour, linewidth=0.9)
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


# ---- command line -------------------------------------------------------------------------------------------


def arguments():
    parser = drawing_parser(__doc__, PICTURES)
    parser.add_argument("--time", metavar="T", type=float,
                        help="draw the snapshot nearest to T seconds (default: last)")
    parser.add_argument("--dynamic", action="store_true", help="stresses: leave the hydrostatic pressure out")
    parser.add_argument("--average", choices=("time", "space"),
                        help="velocity and pressure: draw the averages of output.average_time or average_space")
    given = given_to(parser, PICTURES)
    if given.time is not None and not np.isfinite(given.time):
        parser.error("--time: not a finite number")
    return given


def pictures(runs, given):
    """Names and figures, one after the other."""
    for run in runs:
        prefix = f"{run.name}_" if len(runs) > 1 else ""
        snapshot = run.nearest(given.time).averaged(given.average)
        if "particles" in given.draw:
            yield f"{prefix}particles.png", draw_particles(run, snapshot, given.dynamic)
        if "pressure" in given.draw:
            yield f"{prefix}pressure.png", draw_pressure(run, snapshot)
        if "strip" in given.draw and len(run.snapshots) >= 3:
            yield f"{prefix}strip.png", draw_strip(run)
    if "series" in given.draw:
        yield "series.png", draw_series(runs)


def to_palette(rgb, flat=112, others=64):
    """A picture of few colours, a quarter as large. Exact are our own colours, which may be rare, and the `flat`
    most frequent ones."""
    own = np.array([to_rgb(c) for c in (WALL, SPRAY, TENSION, COMPRESSION, *GROUPS, *RUNS)])
    own = np.concatenate([255 * (share * own + 1 - share) for share in (1, 0.7, 0.4)]).round().astype(np.uint8)
    packed = rgb.astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], dtype=np.uint32)
    colours, where, count = np.unique(packed, return_inverse=True, return_counts=True)
    channels = np.stack([colours >> 16, colours >> 8 & 255, colours & 255], axis=1).astype(np.uint8)
    order = np.argsort(-count, kind="stable")
    palette, rest = np.concatenate([own, channels[order[:flat]]]), order[flat:]
    if rest.size:
        edges = np.repeat(channels[rest], np.ceil(np.sqrt(count[rest])).astype(int), axis=0)
        chosen = Image.fromarray(edges[None]).quantize(others).getpalette()[: 3 * others]
        palette = np.concatenate([palette, np.reshape(chosen, (-1, 3)).astype(np.uint8)])
    distance = sum((channels[:, None, c].astype(np.int32) - palette[None, :, c]) ** 2 for c in range(3))
    picture = Image.fromarray(distance.argmin(axis=1).astype(np.uint8)[where].reshape(rgb.shape[:2]), mode="P")
    picture.putpalette(palette.tobytes())
    return picture


def save(figure, path):
    figure.canvas.draw()
    to_palette(np.asarray(figure.canvas.buffer_rgba())[:, :, :3]).save(path, optimize=True)
    plt.close(figure)


def draw():
    given = arguments()
    runs = [Run(folder) for folder in given.runs]
    out = given.out or runs[0].folder
    out.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update(STYLE)
    for name, figure in pictures(runs, given):
        save(figure, out / name)
        print(out / name)


if __name__ == "__main__":
    sys.exit(refusing(draw))
