"""Colliding rings: energy, momentum and gaps of two elastic rings that bounce at 0.059 of their sound speed each."""

import numpy as np
from scipy.spatial import cKDTree

SCENE = "rings.toml"
SIZES = (5, 10, 20)  # particles across a ring
ERROR = "largest change of energy"
SOUND = np.sqrt(1.6260162601626016e7 / 1200)

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no hourglass control": ("terms.hourglass=0",),
}


def settings(n):
    return (f"start.spacing={0.01 / n}",)


def start(n, speed=0.059):
    """The rings just do not touch."""
    dx = 0.01 / n
    cells = (np.arange(-4 * n, 4 * n) + 0.5) * dx
    ring = np.column_stack([a.ravel() for a in np.meshgrid(cells, cells)])
    radius = np.hypot(*ring.T)
    ring = ring[(radius > 0.03) & (radius < 0.04)]
    apart = np.array([0.04 + dx, 0])
    x = np.concatenate((ring - apart, ring + apart))
    side = np.repeat([0, 1], len(ring))
    v = np.column_stack((np.where(side == 0, speed, -speed) * SOUND, np.zeros(len(x))))
    return {"x": x, "v": v, "rho": np.full(len(x), 1200.0), "group": side}


def angular_momentum(s):
    return np.sum(s.mass * (s.position[:, 0] * s.velocity[:, 1] - s.position[:, 1] * s.velocity[:, 0]))


def measure(run):
    snapshots = run.snapshots()
    first = snapshots[0]
    dx = np.sqrt(first.mass[0] / 1200)
    pairs = np.concatenate([np.flatnonzero(first.group == g)[cKDTree(first.position[first.group == g]).query_pairs(
        1.01 * dx, output_type="ndarray")] for g in (0, 1)])
    gaps = [np.linalg.norm(s.position[pairs[:, 0]] - s.position[pairs[:, 1]], axis=1).max() / dx for s in snapshots]
    series = run.series()
    energy = sum(series[k] for k in series if k.startswith("energy"))
    scale = np.sum(first.mass * np.abs(first.velocity[:, 0]))
    last = snapshots[-1]
    speed = [np.average(s.velocity[s.group == 1, 0], weights=s.mass[s.group == 1]) for s in (first, last)]
    return {"largest change of energy": np.max(np.abs(energy / energy[0] - 1)), "energy / first": energy[-1] / energy[0],
            "speed after / before": -speed[1] / speed[0], "largest gap / dx": max(gaps),
            "momentum": np.max(np.abs(series["momentum_px"])) / scale,
            "angular momentum": abs(angular_momentum(last)) / (scale * 0.04),
            "elastic share at most": np.max(series["energy_elastic"] / energy[0])}
