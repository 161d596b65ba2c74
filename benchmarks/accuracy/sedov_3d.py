"""Sedov's blast in three dimensions: energy within 2 dx of a point in a cold gas, at t = 0.05 against the similarity solution."""

import blast

SCENE = "blast.toml"
SIZES = (40, 60)
ERROR = "worst"
FORMULATIONS = {"default": ()}


def settings(n):
    return (*blast.settings(n, 3, 3), "time.until=0.05", "output.snapshot_interval=0.005")


def start(n):
    return blast.start(n, 3, 2 / n)


def measure(run):
    return blast.measure(run, 3)
