"""Lid-driven cavity, Re 1000: velocities on the centre lines against Ghia et al. (1982), tables I and II."""

import cavity
from cavity import ERROR, FORMULATIONS, SCENE  # noqa: F401

SIZES = (50, 100)


def settings(n):
    return (*cavity.settings(n), "group.fluid.viscosity=0.001", "time.until=60")


def measure(run):
    return cavity.measure(run, 1000)
