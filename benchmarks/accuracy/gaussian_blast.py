"""Blast of a Gaussian of heat 0.05 wide in a cold gas: kinetic energy at t = 0.1 against finite volumes along the radius."""

import blast

SCENE = "blast.toml"
SIZES = (40, 64, 110)
ERROR = "worst"
WIDTH = 0.05
FORMULATIONS = {"default": (), "mixed": ("precision=mixed",), "one h at most": ("kernel.largest_growth=1",)}


def settings(n):
    return blast.settings(n, 2, 3 if n < 60 else 4)


def start(n):
    return blast.start(n, 2, WIDTH)


def measure(run):
    values = blast.measure(run, 2)
    lost = 1 - values["KE"] / blast.kinetic_energy(2, WIDTH, run.snapshots()[-1].time)
    return {"worst": abs(lost), "KE lost": lost,
            "peak density": values["peak density"], "energy": values["energy"]}
