"""Couette start-up: largest error over the speed of the lid at four times against the series (Morris et al. 1997)."""

import numpy as np

import poiseuille
from poiseuille import FORMULATIONS, LENGTH, SIZES, VISCOSITY  # noqa: F401

SCENE = "couette.toml"
ERROR = "largest error / V0"
LID = 12.5e-6
TIMES = (0.045, 0.1125, 0.225, 1.0)


def settings(n):
    """Those of Poiseuille, but that the lid is a region too."""
    dx = LENGTH / n
    return (*poiseuille.settings(n)[:4], f"start.region.1.upper=[{20 * dx}, {1.2 * LENGTH}]",
            f"start.region.2.upper=[{20 * dx}, {LENGTH}]", *poiseuille.settings(n)[5:])


def exact(y, t):
    n = np.arange(1, 200)
    k = n * np.pi / LENGTH
    terms = (-1.0)**n / n * np.sin(np.outer(y, k)) * np.exp(-VISCOSITY * k**2 * t)
    return LID * (y / LENGTH + 2 / np.pi * np.sum(terms, axis=1))


def measure(run):
    snapshots = run.snapshots()
    errors = []
    for time in TIMES:
        s = min(snapshots, key=lambda s: abs(s.time - time))
        errors.append(np.abs(s.velocity[:, 0] - exact(s.position[:, 1], s.time)).max())
    return {"largest error / V0": max(errors) / LID, "at the end": errors[-1] / LID}
