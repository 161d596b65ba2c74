"""Dissolved water, a sine: contents at t = 0.02, over what they swing by."""

import numpy as np

import heat_decay

SCENE = "water_decay.toml"
SIZES = (40, 80, 160)
ERROR = "L2"
FORMULATIONS = {"explicit": ()}
MEAN, SWING = 0.05, 0.02
settings = heat_decay.settings


def start(n):
    """The same liquid in all volumes, at 1 MPa on average."""
    x = heat_decay.strip(n)
    m = MEAN + SWING * heat_decay.sine(x)
    return {"x": x, "v": 0, "rho": 1100 * (1 + m) / (1 + MEAN), "m": m}


def measure(run):
    last = run.snapshots()[-1]
    rate = 4 * np.pi**2
    error, left = heat_decay.compare(last.dissolved - MEAN, heat_decay.sine(last.position), SWING * np.exp(-rate * last.time))
    return {"L2": error, "rate off": abs(np.log(SWING / left) / last.time / rate - 1), "steps": run.perf["steps"]}
