"""Rising bubble 1 (Hysing et al. 2009): rise velocity, centre of mass and circularity against TP2D, FreeLIFE, MooNMD."""

import numpy as np

import interface

SCENE = "rising_bubble.toml"
SIZES = (20, 40, 80)  # 1/h of the benchmark
ERROR = "largest rise velocity"
SPEED, LEAST_CIRCULARITY, CENTRE = 0.2419, 0.9012, 1.0810  # middle of the three groups
RADIUS = 0.25

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "laplacian viscosity": ("terms.viscosity=laplacian",),
    "pressures by volume": ("terms.pressure_weights=volume",),
    "tension as a jump": ("terms.surface_tension.form=jump",),
    "no tension": ("terms.surface_tension=",),
}


def settings(n):
    wall = 4 / n
    return (f"start.spacing={1 / n}", f"start.lower={[0, -wall]}", f"start.upper={[1, 2 + wall]}")


def smooth_speed(run):
    """Means over 0.29 s, the period 2 H / c of the slowest sound in the closed box, which rings from the start."""
    series = run.series()
    window = np.ones(29) / 29
    return np.convolve(series["t"], window, "valid"), np.convolve(series["bubble_vy"], window, "valid")


def shape(snapshot):
    """Circularity and area of the bubble."""
    dx = np.sqrt(2 / len(snapshot.position))
    x = snapshot.position
    # The box is a period wide: images, should the bubble come near its edges.
    x, group = np.vstack([x, x + [1, 0], x - [1, 0]]), np.tile(snapshot.group, 3)
    inside = (group == 1) & (x[:, 0] > 0) & (x[:, 0] < 1)
    length, area = interface.length_and_area(x, inside, dx, 1.2 * dx)
    return 2 * np.sqrt(np.pi * area) / length, area / (np.pi * RADIUS**2)


def measure(run):
    time, speed = smooth_speed(run)
    series = run.series()
    shapes = np.array([shape(s) for s in run.snapshots() if s.time > 0.2])
    return {"largest rise velocity": abs(speed.max() / SPEED - 1), "at [s]": time[speed.argmax()],
            "centre of mass at 3 s": abs(np.interp(3, series["t"], series["bubble_y"]) / CENTRE - 1),
            "least circularity": abs(shapes[:, 0].min() / LEAST_CIRCULARITY - 1),
            "change of area": np.abs(shapes[:, 1] / shapes[0, 1] - 1).max()}
