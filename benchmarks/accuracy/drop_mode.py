"""Mode 2 of a drop in a thin fluid like it, Oh = 0.002, amplitude R / 20: frequency and decay against linear theory."""

import numpy as np
from scipy.optimize import curve_fit

import drop
from drop_at_rest import FORMULATIONS, SCENE, SIZES, settings  # noqa: F401

ERROR = "square of the frequency"
AMPLITUDE, FIRST, LAST = 0.05, 0.3, 8  # the fit leaves out how the shear layers form


def start(n):
    return drop.start(n, AMPLITUDE)


def wave(t, amplitude, decay, frequency, phase, mean):
    return amplitude * np.exp(-decay * t) * np.cos(frequency * t + phase) + mean


def fit(times, elongation):
    return curve_fit(wave, times, elongation, p0=(1, 0.05, 1.65, 0, 0), maxfev=20000)[0]


def measure(run):
    snapshots = [s for s in run.snapshots() if FIRST < s.time < LAST]
    times = np.array([s.time for s in snapshots])
    shapes = np.array([drop.elongation(s.position[s.group == 1], (s.mass / s.density)[s.group == 1])
                       for s in snapshots]) / AMPLITUDE
    theory = fit(times, drop.exact(times))
    try:
        found = fit(times, shapes)
    except RuntimeError:  # no wave in it
        return {}
    ratio = (found[2] / theory[2])**2
    return {"square of the frequency": abs(ratio - 1), "over theory": ratio, "decay": found[1],
            "decay of theory": theory[1], "not of the wave": np.std(shapes - wave(times, *found))}
