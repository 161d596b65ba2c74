"""Sedov's blast in two dimensions: energy within 2 dx of a point in a cold gas, at t = 0.1 against the similarity solution."""

import blast

SCENE = "blast.toml"
SIZES = (50, 100, 200)
ERROR = "worst"
FORMULATIONS = {"default": (), "mixed": ("precision=mixed",), "one h at most": ("kernel.largest_growth=1",),
                "cfl = 0.4": ("time.cfl=0.4",), "no conduction": ("terms.artificial_conduction=0",)}


def settings(n):
    return blast.settings(n, 2, min(8, n // 15))


def start(n):
    return blast.start(n, 2, 2 / n)


def measure(run):
    return blast.measure(run, 2)
