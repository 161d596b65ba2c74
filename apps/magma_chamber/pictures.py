"""Pictures of runs of the magma chamber."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.lines import Line2D

from peperite.drawing import style
from peperite.drawing.melts import levels_of

TINTS = LinearSegmentedColormap.from_list("melts", ["#fbf6ea", "#cfdfee"])  # first and second melt
WARMTH = LinearSegmentedColormap.from_list("warmth", plt.get_cmap("inferno")(np.linspace(0.15, 0.8, 64)))
INTERFACE = "#1b6ca8"


def time_scale(run):
    """Size of the unit and its name."""
    return (run.clock[1], run.clock[0]) if run.clock else style.unit_for(run[-1].time, "s")


def grain_colours(run):
    return dict(zip(run.grains, ("#555555", *style.GROUPS) * len(run.grains)))


def handles_of(run):
    """What melts, grains and interface look like."""
    handles = [Line2D([], [], marker="s", linestyle="", color=TINTS(float(k)), markeredgecolor="#888888", markersize=9,
                      label=name) for k, name in enumerate(run.melts if run.mixed else [])]
    handles += [Line2D([], [], marker="o", linestyle="", color=colour, markersize=7, label=run.scene["group"][k]["name"])
                for k, colour in grain_colours(run).items()]
    return handles + ([Line2D([], [], color=INTERFACE, linewidth=1.4, label="interface")] if run.mixed else [])


def draw_lines(axes, place, values, levels, **colours):
    """Contours that can be seen over grains."""
    inside = [level for level in levels if values.min() < level < values.max()]
    if inside:
        axes.contour(*place, values, levels=inside, colors="white", linewidths=2.6, alpha=0.8)
        axes.contour(*place, values, levels=inside, linewidths=1.3, **colours)


def draw_isotherms(run, snapshots):
    """Grains over the melts, isotherms over both; one panel a snapshot."""
    plane = run.plane
    size = plane.high - plane.low
    metre, length = style.unit_for(size.max(), "m")
    height = min(4.2 * size[1] / size[0], 6.2)
    width = max(height * size[0] / size[1], 2.0)
    figure, all_axes = plt.subplots(1, len(snapshots), squeeze=False, layout="compressed", sharey=True,
                                    figsize=(len(snapshots) * (width + 0.3) + 1.9, height + 1.7))
    extent = np.stack([plane.low, plane.high], axis=1).ravel() / metre
    place = [run.grid.centres(axis) / metre for axis in plane.axes]
    heat = [plane.of(s.cell("temperature")) for s in snapshots] if run.heated else []
    limits = (min(t.min() for t in heat), max(t.max() for t in heat)) if heat else (0, 0)
    levels = levels_of(*limits, ("isotherms", ""))
    for k, (axes, snapshot) in enumerate(zip(all_axes[0], snapshots)):
        axes.set(xlim=extent[:2], ylim=extent[2:], aspect="equal", xlabel=f"{'xyz'[plane.along]} ({length})",
                 title=f"t = {style.clock_text(snapshot.time, run.clock)}")
        if run.mixed:
            share = plane.of(snapshot.cell("composition"))
            axes.imshow(share, origin="lower", extent=extent, cmap=TINTS, clim=(0, 1), interpolation="nearest")
        centre, diameter, group = plane.discs(snapshot)
        fills = grain_colours(run)
        style.circles(axes, centre / metre, diameter / metre, facecolors=[fills[g] for g in group], linewidths=0)
        if run.mixed:
            draw_lines(axes, place, share, [0.5], colors=INTERFACE)
        if heat:
            draw_lines(axes, place, heat[k], levels, cmap=WARMTH, norm=Normalize(*limits))
    all_axes[0, 0].set_ylabel(f"{'xyz'[plane.up]} ({length})")
    if len(levels):
        figure.colorbar(ScalarMappable(Normalize(*limits), WARMTH), ax=list(all_axes[0]), ticks=levels, aspect=26,
                        pad=0.015, label="isotherms: temperature (K)")
    handles = handles_of(run)
    if handles:
        inch = 1 / figure.get_figheight()
        figure.get_layout_engine().set(rect=(0, 0.42 * inch, 1, 1 - 0.52 * inch))
        figure.legend(handles=handles, loc="lower center", ncols=len(handles))
    figure.suptitle(run.title + plane.title(), x=0.01, ha="left", fontsize=13, weight="bold")
    return figure


def edges_between(times):
    """Each time in the middle of its own; the first and the last at the ends."""
    if len(times) == 1:
        return times[0] + np.array([-0.5, 0.5])
    return np.concatenate([times[:1], 0.5 * (times[1:] + times[:-1]), times[-1:]])


def draw_fractions(history):
    """Horizontal means of the volume fraction of grains against time and height."""
    run = history.run
    size, unit = time_scale(run)
    metre, length = style.unit_for(np.ptp(history.edges), "m")
    figure, axes = plt.subplots(figsize=(8.5, 4.6), layout="constrained")
    image = axes.pcolormesh(edges_between(history.times / size), history.edges / metre, history.fractions.T,
                            cmap="viridis", vmin=0)
    label = "volume fraction of grains φ"
    if run.mixed:
        axes.plot(history.times / size, history.interface / metre, color="white", linewidth=1.4,
                  marker="o" if len(history.times) == 1 else None)
        label += ", white: interface"
    figure.colorbar(image, label=label, pad=0.015)
    axes.set(xlabel=f"time t ({unit})", ylabel=f"height {'xyz'[run.grid.up]} ({length})")
    figure.suptitle(run.title, x=0.01, ha="left", fontsize=13, weight="bold")
    return figure


def draw_layer(history):
    """The layer of grains above the interface, and those that have left it."""
    run = history.run
    size, unit = time_scale(run)
    metre, length = style.unit_for(np.nanmax(history.thickness), "m")
    middle, fallen = history.fallen(size)
    panels = [(f"thickness ({length})", history.times, history.thickness / metre),
              ("mean fraction φ", history.times, history.mean),
              (f"grains fallen\nper {unit}", middle, fallen)]
    figure, all_axes = plt.subplots(3, 1, sharex=True, layout="constrained", figsize=(8, 7))
    marker = "o" if len(history.times) < 30 else None
    for axes, (label, times, values), colour in zip(all_axes, panels, style.RUNS):
        axes.plot(times / size, values, color=colour, linewidth=1.2, marker=marker, markersize=4)
        axes.set_ylabel(label)
        axes.grid(True)
        axes.margins(x=0.01)
        low, high = axes.get_ylim()
        axes.set_ylim(min(low, 0), high + 0.05 * (high - min(low, 0)))
    all_axes[-1].set_xlabel(f"time t ({unit})")
    all_axes[0].set_title("Where φ is at least half of its largest value above the interface", fontsize=10)
    all_axes[-1].set_title("From above the interface to below it, less those that rise", fontsize=10)
    figure.suptitle(f"{run.title}: layer on the interface", x=0.01, ha="left", fontsize=13, weight="bold")
    return figure
