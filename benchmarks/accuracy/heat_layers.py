"""Conduction, layers 1:100: temperatures of the slowest mode at t = 0.02, over what they swing by."""

import numpy as np
from scipy.optimize import brentq

import heat_decay

SCENE = "heat_layers.toml"
SIZES = (40, 80, 160)
ERROR = "L2"
RATIO = 100


def limits(count):
    """Implicit, in steps of so many of the explicit limits of the slow layer."""
    return lambda n: ("terms.implicit_conduction=true", f"time.dt={count * 0.25 / n**2}")


FORMULATIONS = {"explicit": (), "implicit, 4 limits of the slow": limits(4), "implicit, 16": limits(16)}
settings = heat_decay.settings

# k in the slow layer, k / 10 in the quick one: one value and one flux where they meet, a quarter metre from their middles.
SLOWER = RATIO**-0.5
K = brentq(lambda k: np.sin(k / 4) * np.cos(k * SLOWER / 4) + RATIO * SLOWER * np.sin(k * SLOWER / 4) * np.cos(k / 4),
           2 * np.pi, 4 * np.pi)


def mode(x):
    away = np.abs(x[:, 0] - 0.5)
    quick = np.cos(K / 4) / np.cos(K * SLOWER / 4) * np.cos(K * SLOWER * (0.5 - away))
    return np.where(away < 0.25, np.cos(K * away), quick)


def start(n):
    x = heat_decay.strip(n)
    return {"x": x, "v": 0, "group": np.where(np.abs(x[:, 0] - 0.5) < 0.25, 0, 1), "T": 1 + 0.5 * mode(x)}


def measure(run):
    last = run.snapshots()[-1]
    error, left = heat_decay.compare(last.temperature - 1, mode(last.position), 0.5 * np.exp(-K**2 * last.time))
    return {"L2": error, "rate off": abs(np.log(0.5 / left) / last.time / K**2 - 1), "steps": run.perf["steps"]}
