"""Buiter et al. (2016), experiment 1: a stable wedge is pushed 4 cm and must stay rigid."""

import numpy as np

from runs import snapshots, source, write_start
from strain import Grid, shear_strain

SLOPE, HEIGHT = 20.0, 0.030  # [degrees], at the wall [m]
DIAMETER = 1.6e-3
LENGTH = HEIGHT / np.tan(np.radians(SLOPE))
BEGIN, SPEED = 0.3, 0.016
SANDBOX = source / "apps/sandbox/sandbox.toml"


def prepare(runner):
    """Cuts the wedge out of the sandbox's settled layer."""
    layer = snapshots(runner.run("wedge_layer", SANDBOX, "time.until=0.5 s", "output.snapshot_interval=0",
                                 "output.contacts=false"))[-1]
    x, z = layer.position[:, 0], layer.position[:, 2]
    inside = (z + layer.radius < (LENGTH - x) * np.tan(np.radians(SLOPE)))
    start = runner.work / "wedge.h5"
    write_start(start, layer.position[inside], layer.radius[inside], np.zeros(inside.sum()))
    return start


def slope(snapshot, wall):
    """Of the line through the tops of bins of two diameters, without the ends [degrees]."""
    edges = np.arange(wall, wall + LENGTH, 2 * DIAMETER)
    top = snapshot.position[:, 2] + snapshot.radius
    inside = np.digitize(snapshot.position[:, 0], edges) - 1
    x = 0.5 * (edges[:-1] + edges[1:])
    height = np.array([np.sort(top[inside == k])[-3:].mean() if np.sum(inside == k) > 3 else 0
                       for k in range(len(x))])
    used = (x > wall + 0.1 * LENGTH) & (x < wall + 0.85 * LENGTH)
    return -np.degrees(np.arctan(np.polyfit(x[used], height[used], 1)[0]))


def measure(runner):
    run = [s for s in snapshots(runner.run("wedge", "stable_wedge.toml", f"start.file={prepare(runner)}"))
           if s.time >= BEGIN * (1 - 1e-9)]
    pushed = [SPEED * (s.time - BEGIN) for s in run]
    slopes = [slope(s, way) for s, way in zip(run, pushed)]
    # Where the whole wedge slides its grains have moved as far as the wall.
    early = next(k for k, way in enumerate(pushed) if way >= 0.25 * pushed[-1])
    lag = (run[-1].position - run[early].position)[:, 0] - (pushed[-1] - pushed[early])
    strain = shear_strain(run[early], run[-1], Grid((0, 0), (pushed[-1] + LENGTH, 1.3 * HEIGHT), DIAMETER))
    inner = strain[np.isfinite(strain)]
    lines = [f"pushed {100 * pushed[-1]:.1f} cm: slope {slopes[0]:.2f} degrees before, {slopes[early]:.2f} after "
             f"{100 * pushed[early]:.1f} cm, {slopes[-1]:.2f} at the end; asked: a change below 1",
             f"from there on: grains fall behind the wall by {np.median(-lag) / DIAMETER:.2f} d in the median, "
             f"{np.quantile(np.abs(lag), 0.99) / DIAMETER:.2f} d in the 99th percentile; shear strain "
             f"{np.median(inner):.3f} in the median, {np.quantile(inner, 0.99):.3f} in the 99th percentile"]
    return lines, (pushed, slopes, run)


def draw(axes, result):
    pushed, slopes, run = result
    left, right = axes
    for s, way in ((run[0], pushed[0]), (run[-1], pushed[-1])):
        left.plot(100 * s.position[:, 0], 100 * s.position[:, 2], ".", ms=1.5, label=f"{100 * way:.0f} cm")
    left.set(xlabel="x [cm]", ylabel="z [cm]", title="Stable wedge", aspect="equal")
    left.legend(markerscale=5)
    right.plot(100 * np.array(pushed), slopes)
    right.set(xlabel="pushed [cm]", ylabel="slope [degrees]", ylim=(15, 25), title="Its slope")
