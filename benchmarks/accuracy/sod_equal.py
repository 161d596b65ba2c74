"""Sod's shock tube from equal spacing, masses 8 : 1: the gas in the fan thins out to 2.3 spacings along the tube, and its kernels follow."""

import numpy as np

import sod
from sod import ERROR, SCENE, SIZES, measure  # noqa: F401

FORMULATIONS = {"default": (), "one h": ("kernel.largest_growth=1",), "cfl = 0.4": ("time.cfl=0.4",)}
ROWS = 30 * 2 + 6  # a period is at least three cells of the widest kernel and the skin


def settings(n):
    return (f"start.spacing={1 / n}", f"domain.upper=[0.8, {ROWS / n}]", "kernel.h_over_dx=1.2", "kernel.largest_growth=2")


def start(n, width=2):
    layers = 12
    x = (np.arange(-(n // 2) - layers, n // 2 + layers) + 0.5) / n
    x = np.column_stack([a.ravel() for a in np.meshgrid(x, (np.arange(ROWS) + 0.5) / n)])
    rho, p = (0.5 * (a + b) - 0.5 * (a - b) * np.tanh(x[:, 0] * n / width) for a, b in zip(sod.LEFT, sod.RIGHT))
    return {"x": x, "v": 0, "group": (np.abs(x[:, 0]) > 0.5).astype(int), "rho": rho, "mass": rho / n**2,
            "u": p / ((sod.GAMMA - 1) * rho)}
