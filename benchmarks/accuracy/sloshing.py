"""Sloshing tank 900 x 93 mm: period of the first mode against 2 pi / sqrt(g k tanh k H) = 1.9171 s."""

import numpy as np
from scipy.optimize import curve_fit

SCENE = "sloshing.toml"
SIZES = (12, 16, 24)  # particles from floor to surface
ERROR = "period"
LENGTH, DEPTH, GRAVITY, AMPLITUDE = 0.9, 0.093, 9.81, 0.002
K = np.pi / LENGTH
OMEGA = np.sqrt(GRAVITY * K * np.tanh(K * DEPTH))

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no-slip walls": ("group.wall.slip=",),
    "c = 10 sqrt(g H)": ("group.water.sound_speed=9.55",),
    "ida": ("formulation=ida", "terms.density_diffusion=", "group.wall.slip="),
}


def settings(n):
    return (f"start.spacing={DEPTH / n}",)


def mode(x, k, depth, speed):
    """Velocities of a standing wave whose surface is flat; `speed` is the largest of the surface."""
    return speed / np.sinh(k * depth) * np.column_stack((-np.sin(k * x[:, 0]) * np.cosh(k * x[:, 1]),
                                                         np.cos(k * x[:, 0]) * np.sinh(k * x[:, 1])))


def start(n):
    """Columns are as wide as the length divides: their mass is that of the water in them."""
    dx, columns, layers = DEPTH / n, round(LENGTH * n / DEPTH), 4
    inner = (np.arange(columns) + 0.5) * LENGTH / columns
    outer = (np.arange(layers) + 0.5) * dx
    across = np.concatenate((-outer[::-1], inner, LENGTH + outer))
    up = (np.arange(-layers, n + 2 * layers) + 0.5) * dx
    x = np.column_stack([a.ravel() for a in np.meshgrid(across, up)])
    inside = (x[:, 0] > 0) & (x[:, 0] < LENGTH) & (x[:, 1] > 0)
    water = inside & (x[:, 1] < DEPTH)
    keep = water | ~inside
    sound2 = 14.33**2
    rho = 1000 * np.exp(GRAVITY * (DEPTH - x[:, 1]) / sound2)
    rho[~water] = 1000
    v = np.where(water[:, None], mode(x, K, DEPTH, AMPLITUDE * OMEGA), 0)
    mass = rho * dx * np.where(water, LENGTH / columns, dx)
    return {"x": x[keep], "v": v[keep], "group": 1 - water[keep].astype(int), "mass": mass[keep]}


def swing(t, size, decay, omega, phase, mean):
    return size * np.exp(-decay * t) * np.cos(omega * t + phase) + mean


def measure(run):
    """A fit to the mean position of the water, which swings as the first mode alone."""
    series = run.series()
    t, x = series["t"], series["water_x"]
    fit, _ = curve_fit(swing, t, x, (np.ptp(x) / 2, 0.01, OMEGA, np.pi / 2, x.mean()))
    return {"period": abs(OMEGA / fit[2] - 1), "period [s]": 2 * np.pi / fit[2], "decay [1/s]": fit[1],
            "rms from the fit / amplitude": np.std(x - swing(t, *fit)) / abs(fit[0])}
