"""Viscous standing wave, Re 2500: decay of the amplitude against the exact linear theory."""

import numpy as np

import standing_wave
from standing_wave import FORMULATIONS, SCENE, SIZES, start  # noqa: F401

ERROR = "decay rate"


def settings(n):
    return (*standing_wave.settings(n), f"group.water.viscosity={1000 * np.sqrt(9.81) / 2500}")


def measure(run):
    return standing_wave.measure(run, 2500)
