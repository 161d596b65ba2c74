"""Kelvin-Helmholtz, densities 2:1: growth rate, as kelvin_helmholtz.py; the density jumps where the flow turns."""

import kelvin_helmholtz as one
from kelvin_helmholtz import ERROR, SCENE, SIZES, measure  # noqa: F401

RATIO = 0.5

FORMULATIONS = {
    "default": ("terms.pressure_weights=density",),
    "pressures by volume": (),
    "no shifting": ("terms.pressure_weights=density", "terms.shifting=false"),
}


def settings(n):
    return (*one.settings(n), f"group.slow.density={RATIO}")


def start(n):
    return one.start(n, RATIO)
