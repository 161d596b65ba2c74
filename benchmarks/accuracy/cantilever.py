"""Cantilever: period of a plate in a slot against Timoshenko's, and what is left of its amplitude."""

import numpy as np

SCENE = "cantilever.toml"
SIZES = (6, 10, 20)  # particles across the plate
ERROR = "period"
LENGTH, HEIGHT, SOUND, SPEED = 0.2, 0.02, 57.027, 0.01
PERIOD = 0.25647  # thin plate 0.25403 s; shear and rotary inertia lengthen it

# Walls hold no updated solid by its stress: the slot is a solid too heavy to move.
UPDATED = ("group.plate.lagrangian=updated", "group.slot.clamps=", "group.slot.kind=solid", "group.slot.density=1e9",
           "group.slot.bulk_modulus=3.252032520325203e6", "group.slot.poisson_ratio=0.3975", "time.cfl=0.5")
FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no hourglass control": ("terms.hourglass=0",),
    "updated": UPDATED,
}


def settings(n):
    return (f"start.spacing={HEIGHT / n}",)


def mode(x):
    """First mode of the thin plate, of height 1 at its end."""
    k_l = 1.875
    m, n = np.sin(k_l) + np.sinh(k_l), np.cos(k_l) + np.cosh(k_l)
    shape = lambda a: m * (np.cos(a) - np.cosh(a)) - n * (np.sin(a) - np.sinh(a))  # noqa: E731
    return shape(k_l * x / LENGTH) / shape(k_l)


def start(n, speed=SPEED):
    """`speed` of the end in units of the sound speed. The slot is as deep as the kernel's radius, and more."""
    dx = HEIGHT / n
    along = (np.arange(-5, 10 * n) + 0.5) * dx
    across = (np.arange(n) + 0.5) * dx - HEIGHT / 2
    x, y = (a.ravel() for a in np.meshgrid(along, across, indexing="ij"))
    v = np.where(x > 0, speed * SOUND * mode(x), 0)
    return {"x": np.column_stack((x, y)), "v": np.column_stack((0 * v, v)), "group": (x < 0).astype(int)}


def measure(run):
    series = run.series()
    t, y = series["t"], series["tip_y"]
    y = y - y[0]
    k = np.flatnonzero((y[:-1] < 0) != (y[1:] < 0))
    crossings = t[k] - y[k] * (t[k + 1] - t[k]) / (y[k + 1] - y[k])
    period = 2 * np.mean(np.diff(crossings)) if len(crossings) > 1 else np.nan
    high = [np.max(np.abs(y[(t >= a) & (t < a + PERIOD)])) for a in np.arange(0, t[-1] - 0.99 * PERIOD, PERIOD)]
    energy = sum(series[k] for k in series if k.startswith("energy"))
    return {"period": abs(period / PERIOD - 1), "T [s]": period, "periods": t[-1] / period,
            "amplitude / first": high[-1] / high[0], "energy / first": energy[-1] / energy[0],
            "largest change of energy": np.max(np.abs(energy / energy[0] - 1))}
