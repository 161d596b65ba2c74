"""The pictures of a sandbox run and of shear boxes."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.lines import Line2D

from forces import Contacts, principal, stress_on
from wedge import critical_taper

# Three layers, each in two tones: offsets show better in thin bands.
LAYERS = ("#8a5a33", "#a87142", "#d9b779", "#ecd39e", "#4f7f78", "#6fa39a")
FORWARD, BACK, WALL, CHAIN = "#c1272d", "#1b6ca8", "#555555", "#7a1f1f"
CURVES = ("#8a6d1d", "#3a7d44", "#7a4f9e")


def chosen_moments(history, number, faulted=False):
    """Spread evenly over the shortening; those with strain only, where asked for."""
    moments = [m for m in history.moments if m.gamma is not None] if faulted else history.moments
    if not moments:
        return []
    wanted = np.unique(np.linspace(0, len(moments) - 1, number + 1 if faulted else number).round().astype(int))
    return [moments[k] for k in (wanted[1:] if faulted and len(wanted) > number else wanted)]


def sheet(history, number, bar=False):
    """A column of panels to one scale, in centimetres, and their height for the highest surface."""
    width = 9.0
    high = 100 * 1.12 * max(m.surface.height.max() for m in history.moments)
    low, right = 100 * history.wall_start - 0.5, 100 * history.far + 0.5
    inches = width * (high + 0.6) / (right - low)
    gap, above, below = 0.32, 0.45, 0.5 + 0.75 * bar
    size = (width + 0.95, above + number * (inches + gap) + below)
    figure = plt.figure(figsize=size)
    for k in range(number):
        top = size[1] - above - k * (inches + gap) - 0.15
        axes = figure.add_axes([0.7 / size[0], (top - inches) / size[1], width / size[0], inches / size[1]])
        axes.set(xlim=(low, right), ylim=(-0.6, high), ylabel="z (cm)")
        axes.tick_params(labelbottom=k == number - 1)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    figure.axes[-1].set_xlabel("x (cm)")
    figure.text(0.7 / size[0], 1 - 0.2 / size[1], history.run.title, fontsize=13, weight="bold", va="center")
    return figure, list(figure.axes)


def draw_walls(axes, history, moment):
    far, wall, (_, top) = 100 * history.far, 100 * moment.wall, axes.get_ylim()
    axes.plot([wall, wall], [0, top], color=WALL, linewidth=3, solid_capstyle="butt")
    axes.plot([wall, far, far], [0, 0, top], color=WALL, linewidth=1)
    axes.set_title(f"shortening {100 * moment.shortening:.1f} cm", pad=2)


def circles(axes, snapshot, **options):
    size = 200 * snapshot.radius
    axes.add_collection(EllipseCollection(size, size, 0, units="xy", offsets=100 * snapshot.position[:, [0, 2]],
                                          offset_transform=axes.transData, linewidths=0, **options))


def draw_layers(history):
    moments = chosen_moments(history, 5)
    figure, panels = sheet(history, len(moments))
    colours = np.array(LAYERS)[history.layers(len(LAYERS))]
    for axes, moment in zip(panels, moments):
        circles(axes, moment.snapshot, facecolors=colours)
        draw_walls(axes, history, moment)
    return figure


def draw_strain(history):
    moments = chosen_moments(history, 5, faulted=True)
    if not moments:
        return None
    figure, panels = sheet(history, len(moments), bar=True)
    most = np.nanquantile(np.concatenate([m.gamma[np.isfinite(m.gamma)] for m in moments]), 0.99)
    for axes, moment in zip(panels, moments):
        drawn = axes.imshow(moment.gamma.T, origin="lower", extent=[100 * c for c in history.grid.corners()],
                            cmap=plt.get_cmap("YlOrBr", 12), vmin=0, vmax=most, aspect="auto", interpolation="nearest")
        axes.plot(100 * moment.surface.x, 100 * moment.surface.height, color="#333333", linewidth=0.7)
        for fault in moment.faults:
            (x0, x1), (z0, z1) = fault.ends
            colour = FORWARD if fault.dip > 0 else BACK
            axes.plot([100 * x0, 100 * x1], [100 * z0, 100 * z1], color=colour, linewidth=1.6)
            axes.annotate(f"{abs(fault.dip):.0f}°", (100 * x1, 100 * z1), xytext=(0, 3), textcoords="offset points",
                          ha="center", fontsize=8, color=colour)
        draw_walls(axes, history, moment)
        axes.set_title(f"shortening {100 * moment.since:.1f} to {100 * moment.shortening:.1f} cm", pad=2)
    handles = [Line2D([], [], color=FORWARD, label="forward thrust, dip"), Line2D([], [], color=BACK, label="back thrust")]
    figure.legend(handles=handles, loc="upper right", ncols=2, borderaxespad=0.2)
    place = figure.add_axes([0.25, 0.55 / figure.get_figheight(), 0.5, 0.12 / figure.get_figheight()])
    figure.colorbar(drawn, cax=place, orientation="horizontal", label="shear strain meanwhile", extend="max")
    return figure


def draw_chains(history):
    moments = chosen_moments(history, 4)
    figure, panels = sheet(history, len(moments))
    for axes, moment in zip(panels, moments):
        contacts = Contacts(moment.snapshot)
        circles(axes, moment.snapshot, facecolors="#efe9dc")
        width = 0.1 * np.minimum(contacts.strength, 20)
        axes.add_collection(LineCollection(100 * contacts.lines, linewidths=width, colors=CHAIN))
        draw_walls(axes, history, moment)
        axes.set_title(f"shortening {100 * moment.shortening:.1f} cm: contacts above the mean force of "
                       f"{1e3 * contacts.mean_force:.2g} mN; coordination {contacts.coordination:.2f}, anisotropy "
                       f"{contacts.anisotropy:.2f} along {contacts.direction:.0f}°", pad=2)
    return figure


def draw_stress(history):
    moments = [m for m in chosen_moments(history, 3) if "stress" in m.snapshot]
    if not moments:
        return None
    figure, panels = sheet(history, len(moments), bar=True)
    fields = [principal(*stress_on(history.grid, m.snapshot)) for m in moments]
    most = np.nanquantile(np.concatenate([f[0][np.isfinite(f[0])] for f in fields]), 0.98) / 1e3
    for axes, moment, (pressure, _, angle) in zip(panels, moments, fields):
        drawn = axes.imshow(pressure.T / 1e3, origin="lower", extent=[100 * c for c in history.grid.corners()],
                            cmap=plt.get_cmap("viridis", 16), vmin=0, vmax=most, aspect="auto", interpolation="nearest")
        every = max(1, int(round(0.006 / history.grid.cell)))
        i, k = (a.ravel() for a in np.mgrid[every // 2:pressure.shape[0]:every, every // 2:pressure.shape[1]:every])
        inside = np.isfinite(pressure[i, k])
        i, k = i[inside], k[inside]
        arm = 0.25 * np.stack([np.cos(angle[i, k]), np.sin(angle[i, k])], axis=1)
        centre = 100 * np.stack([history.grid.centres(0)[i], history.grid.centres(1)[k]], axis=1)
        ends = np.stack([centre - arm, centre + arm], axis=1)
        axes.add_collection(LineCollection(ends, colors="white", linewidths=0.9))
        draw_walls(axes, history, moment)
    place = figure.add_axes([0.25, 0.55 / figure.get_figheight(), 0.5, 0.12 / figure.get_figheight()])
    figure.colorbar(drawn, cax=place, orientation="horizontal", extend="max",
                    label="pressure in the plane (kPa); lines: direction of the greatest compression")
    return figure


def draw_history(history, sand, floor):
    table = history.run.series
    way = 100 * history.speed * (table["t"] - history.begin)
    moving = way >= 0
    figure, (force, slope, order) = plt.subplots(3, 1, figsize=(9, 8), sharex=True, layout="constrained")
    force.plot(way[moving], np.abs(table["back_fx"][moving]) / history.run.width, color="#1b6ca8", linewidth=0.9)
    force.set_ylabel("force on the back wall\n(N per m of width)")
    force.set_ylim(bottom=0)
    shortening = [100 * m.shortening for m in history.moments]
    slope.plot(shortening, [m.taper for m in history.moments], "o-", color=CURVES[1], markersize=3, linewidth=1)
    least, after = (critical_taper(sand[k], floor[k]) for k in (0, 1))
    slope.axhspan(min(least, after), max(least, after), color=CURVES[1], alpha=0.18, linewidth=0)
    slope.annotate("least stable taper", (0.01, max(least, after)), xycoords=("axes fraction", "data"), xytext=(0, 2),
                   textcoords="offset points", fontsize=8, color=CURVES[1])
    slope.set(ylabel="taper (°)", ylim=(0, None))
    for moment in history.moments:
        for fault in moment.faults:
            order.plot(100 * moment.shortening, 100 * fault.root, "^" if fault.dip > 0 else "v", markersize=5,
                       color=FORWARD if fault.dip > 0 else BACK, alpha=0.8)
    order.plot(shortening, [100 * m.wall for m in history.moments], color=WALL, linewidth=2, label="back wall")
    order.plot(shortening, [100 * m.front for m in history.moments], color=CURVES[0], linewidth=1,
               label="front of the rise")
    handles, labels = order.get_legend_handles_labels()
    handles += [Line2D([], [], color=FORWARD, marker="^", linestyle="", label="root of a forward thrust"),
                Line2D([], [], color=BACK, marker="v", linestyle="", label="root of a back thrust")]
    order.legend(handles=handles, loc="lower right", ncols=2)
    order.set(ylabel="x (cm)", xlabel="shortening (cm)")
    for axes in (force, slope, order):
        axes.grid(True)
        axes.margins(x=0)
    figure.suptitle(history.run.title, x=0.01, ha="left", fontsize=13, weight="bold")
    return figure


def draw_shear(boxes):
    figure, axes = plt.subplots(figsize=(9, 4), layout="constrained")
    for box, colour in zip(boxes, (LAYERS[0], BACK, CURVES[2], WALL)):
        axes.plot(box.way / box.height, box.ratio, color=colour, linewidth=0.4, alpha=0.4)
        name = {"sand": "sand on sand", "floor": "sand on the floor"}[box.name]
        axes.plot(box.way / box.height, box.smoothed, color=colour, linewidth=1.5,
                  label=f"{name}: {box.peak:.1f}° at the peak, {box.residual:.1f}° later")
    axes.set(xlabel="way of the lower plane / height of the layer", ylabel="tangential / normal force", ylim=(0, 1))
    axes.grid(True)
    axes.margins(x=0)
    axes.legend()
    axes.set_title("Shear box")
    return figure
