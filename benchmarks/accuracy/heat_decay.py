"""Conduction, a sine: temperatures at t = 0.02, over half of what swings then."""

import numpy as np

SCENE = "heat_decay.toml"
SIZES = (40, 80, 160)
ERROR = "L2"
ACROSS = 12  # particles across the strip


def limits(count):
    """Implicit, in steps of so many of the explicit limits, 0.25 h^2 / kappa."""
    return lambda n: ("terms.implicit_conduction=true", f"time.dt={count * 0.25 / n**2}")


FORMULATIONS = {"explicit": (), "implicit, 4 limits": limits(4), "implicit, 16 limits": limits(16)}


def settings(n):
    return (f"start.spacing={1 / n}", f"domain.upper=[1, {ACROSS / n}]")


def strip(n):
    """Places on an even lattice."""
    return np.column_stack([a.ravel() for a in np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(ACROSS) + 0.5) / n)])


def sine(x):
    return np.sin(2 * np.pi * x[:, 0])


def start(n):
    x = strip(n)
    return {"x": x, "v": 0, "T": 1 + 0.5 * sine(x)}


def compare(found, mode, amplitude):
    """With amplitude * mode: L2, and the rate at which the part that is the mode decays."""
    exact = amplitude * mode
    return np.sqrt(np.sum((found - exact)**2) / np.sum(exact**2)), np.sum(found * mode) / np.sum(mode**2)


def measure(run):
    last = run.snapshots()[-1]
    rate = 4 * np.pi**2
    error, left = compare(last.temperature - 1, sine(last.position), 0.5 * np.exp(-rate * last.time))
    return {"L2": error, "rate off": abs(np.log(0.5 / left) / last.time / rate - 1), "steps": run.perf["steps"]}
