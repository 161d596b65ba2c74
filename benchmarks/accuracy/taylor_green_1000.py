"""Taylor-Green vortices, Re 1000: speed exp(-8 pi^2 t / Re) of the first, everywhere."""

import taylor_green
from taylor_green import FORMULATIONS, SCENE  # noqa: F401

SIZES = (50, 100)
ERROR = "largest L1 to t = 2"


def settings(n):
    return (*taylor_green.settings(n), "group.fluid.viscosity=0.001")


def measure(run):
    return taylor_green.measure(run, 0.001)
