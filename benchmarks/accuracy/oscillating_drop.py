"""Oscillating drop under a central pull: period and amplitude over ten periods (Monaghan & Rafiee 2013)."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

SCENE = "oscillating_drop.toml"
SIZES = (12, 25, 50)  # particles along a radius
ERROR = "period"
SIGMA, DENSITY, SOUND = 0.5, 1000, 10

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no shifting": ("terms.shifting=false",),
    "no diffusion": ("terms.density_diffusion=0",),
    "ida": ("formulation=ida", "terms.shifting=", "terms.density_diffusion="),
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def start(n):
    """The pressure of the circle: rho (B^2 + sigma^2) (R^2 - r^2) / 2."""
    centres = (np.arange(-n, n) + 0.5) / n
    x = np.column_stack([a.ravel() for a in np.meshgrid(centres, centres)])
    x = x[np.sum(x**2, axis=1) < 1]
    pressure = 0.5 * DENSITY * (1 + SIGMA**2) * (1 - np.sum(x**2, axis=1))
    return {"x": x, "v": SIGMA * x * [1, -1], "rho": DENSITY + pressure / SOUND**2}


def exact_period(sigma):
    """Of sigma' = (B^2 + sigma^2) (b^2 - a^2) / (a^2 + b^2), a' = sigma a, a b = 1: twice the time until it is a circle
    again."""
    def rates(_, y):
        b = 1 / y[1]
        return (1 + y[0]**2) * (b**2 - y[1]**2) / (y[1]**2 + b**2), y[0] * y[1]

    def circle(_, y):
        return y[1] - 1

    circle.direction = -1
    return 2 * solve_ivp(rates, (0, 4), (sigma, 1), events=circle, rtol=1e-11, atol=1e-12).t_events[0][0]


def measure(run):
    """The kinetic energy M sigma^2 (a^2 + b^2) / 8 peaks when the drop is a circle, twice a period: its peaks give the
    period and, as M sigma^2 / 4, the amplitude."""
    series = run.series()
    spline = CubicSpline(series["t"], series["energy_kinetic"])
    slope, curve = spline.derivative(), spline.derivative(2)
    turns = slope.roots(extrapolate=False)
    peaks = turns[curve(turns) < 0]
    half = exact_period(SIGMA) / 2
    # Compression swings too: of the peaks near an expected one the highest.
    expected = [k * half for k in range(1, 21)]
    found = []
    for k, time in enumerate(expected):
        near = peaks[np.abs(peaks - time) < 0.35 * half]
        if len(near) == 0:
            return {"periods": k / 2}
        found.append(near[np.argmax(spline(near))])
    sigma = np.sqrt(spline(found[-1]) / spline(0))
    energy = sum(series[k] for k in series if k.startswith("energy"))
    return {"period": abs(found[-1] / (20 * half) - 1), "period [s]": found[-1] / 10, "amplitude / first": sigma,
            "periods": 10, "energy lost / first kinetic": (energy[0] - energy[-1]) / series["energy_kinetic"][0]}
