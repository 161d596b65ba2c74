"""Isothermal shock tube, 10 : 1."""

import shock_tube
from shock_tube import ERROR, FORMULATIONS, SCENE, SIZES, settings  # noqa: F401


def start(n):
    return shock_tube.start(n, 10)


def measure(run):
    return shock_tube.measure(run, 10)
