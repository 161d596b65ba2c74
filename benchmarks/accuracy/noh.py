"""Noh's implosion in two dimensions: density behind the shock at t = 0.6, against 16."""

import numpy as np

SCENE = "noh.toml"
SIZES = (50, 100, 200)  # across
ERROR = "density missing"
FORMULATIONS = {"default": (), "mixed": ("precision=mixed",), "no conduction": ("terms.artificial_conduction=0",)}


def settings(n):
    return (f"start.spacing={2 / n}",)


def start(n):
    axis = (np.arange(n) + 0.5) * 2 / n - 1
    x = np.stack([a.ravel() for a in np.meshgrid(axis, axis)], axis=1)
    r = np.sqrt(np.sum(x**2, axis=1))
    x, r = x[r < 1], r[r < 1]
    return {"x": x, "v": -x / r[:, None], "rho": 1.0, "mass": 4 / n**2, "u": 1e-6 * 1.5}


def measure(run):
    """Mean density between 1/4 and 3/4 of the shock's radius; the shock where it falls through 10."""
    last = run.snapshots()[-1]
    r, shock = np.sqrt(np.sum(last.position**2, axis=1)), last.time / 3
    inside = (r > 0.25 * shock) & (r < 0.75 * shock)
    series = run.series()
    energy = series["energy_kinetic"] + series["energy_internal"]
    return {"density missing": 1 - last.density[inside].mean() / 16, "noise": last.density[inside].std() / 16,
            "centre": last.density[r < 0.1 * shock].mean() / 16 - 1,
            "shock": r[last.density > 10].max() / shock - 1, "energy": energy[-1] / energy[0] - 1}
