"""Spinning plate: angular momentum and energy of an elastic square over ten turns at 50 1/s."""

import numpy as np
from scipy.spatial import cKDTree

from rotating_patch import angular_momentum

SCENE = "spinning_plate.toml"
SIZES = (10, 20, 40)  # particles along an edge
ERROR = "angular momentum lost"
SPIN = 50

UPDATED = ("group.plate.lagrangian=updated", "terms.hourglass=", "time.cfl=0.5")
FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no hourglass control": ("terms.hourglass=0",),
    "updated": UPDATED,
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def start(n):
    cells = (np.arange(n) + 0.5) / n - 0.5
    x = np.column_stack([a.ravel() for a in np.meshgrid(cells, cells)])
    return {"x": x, "v": SPIN * np.column_stack((-x[:, 1], x[:, 0])), "rho": np.full(len(x), 1100.0)}


def measure(run):
    snapshots = run.snapshots()
    first = snapshots[0]
    dx = np.sqrt(first.mass[0] / 1100)
    turning = np.array([angular_momentum(s) for s in snapshots]) / angular_momentum(first)
    nearest = [cKDTree(s.position).query(s.position, k=2)[0][:, 1] for s in snapshots]
    series = run.series()
    energy = sum(series[k] for k in series if k.startswith("energy"))
    return {"angular momentum lost": np.max(np.abs(turning - 1)),
            "largest change of energy": np.max(np.abs(energy / energy[0] - 1)), "energy / first": energy[-1] / energy[0],
            "nearest pair / dx": min(d.min() for d in nearest) / dx, "furthest pair / dx": max(d.max() for d in nearest) / dx}
