"""Wave in a bar: speed of a pulse in one-dimensional strain, and what a free end makes of its velocity."""

import numpy as np

SCENE = "bar_wave.toml"
SIZES = (50, 100, 200, 400)  # particles along the bar
ERROR = "speed"
SPEED = np.sqrt((1e7 + 4 / 3 * 3.75e6) / 1000)
ACROSS = 16  # particles
WIDTH = 0.04  # of the pulse

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no hourglass control": ("terms.hourglass=0",),
    "updated": ("group.bar.lagrangian=updated", "terms.hourglass="),
}


def settings(n):
    return f"start.spacing={1 / n}", f"domain.upper=[1.2, {ACROSS / n}]"


def start(n):
    x, y = (a.ravel() for a in np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(ACROSS) + 0.5) / n, indexing="ij"))
    v = 1e-3 * SPEED * np.exp(-0.5 * ((x - 0.5) / WIDTH)**2)
    return {"x": np.column_stack((x, y)), "v": np.column_stack((v, 0 * v)), "rho": np.full(len(x), 1000.0)}


def peak(t, v):
    """Time and height of the largest value, by a parabola."""
    k = int(np.argmax(v))
    a, b, c = np.polyfit(t[k - 2:k + 3] - t[k], v[k - 2:k + 3], 2)
    return t[k] - b / (2 * a), c - b * b / (4 * a)


def measure(run):
    series = run.series()
    t = series["t"]
    before = t < 0.42 / SPEED  # the reflected pulse comes later
    t_near, _ = peak(t[before], series["near_vx"][before])
    t_far, high = peak(t[before], series["far_vx"][before])
    way = series["far_x"][0] - series["near_x"][0]
    energy = sum(series[k] for k in series if k.startswith("energy"))
    return {"speed": abs(way / (t_far - t_near) / SPEED - 1), "free end / pulse": peak(t, series["end_vx"])[1] / high,
            "pulse / exact": high / (0.5e-3 * SPEED), "largest change of energy": np.max(np.abs(energy / energy[0] - 1))}
