"""Rotating square patch: angular momentum, energy and voids to omega t = 4, pressures all negative at the start."""

import numpy as np
from scipy.spatial import cKDTree

SCENE = "rotating_patch.toml"
SIZES = (50, 100)
ERROR = "angular momentum lost"

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no shifting": ("terms.shifting=false",),
    "artificial viscosity": ("terms.artificial_viscosity=0.02",),
    "ida": ("formulation=ida", "terms.shifting=", "terms.density_diffusion="),
}
C = 7


def start(n):
    """Fields of the start file. The pressure solves lap p = 2 rho omega^2 with p = 0 on the edges: -0.147343 rho omega^2
    L^2 in the middle."""
    centres = (np.arange(n) + 0.5) / n
    x, y = (a.ravel() for a in np.meshgrid(centres, centres, indexing="ij"))
    odd = np.arange(1, 200, 2)
    sines = np.sin(np.pi * np.outer(centres, odd))
    pressure = (sines @ (-32 / np.pi**4 / np.outer(odd, odd) / (odd[:, None]**2 + odd**2)) @ sines.T).ravel()
    position = np.column_stack((x, y)) - 0.5
    return {"x": position, "v": np.column_stack((position[:, 1], -position[:, 0])), "rho": 1 + pressure / C**2}


def settings(n):
    return (f"start.spacing={1 / n}",)


def angular_momentum(s):
    return np.sum(s.mass * (s.position[:, 0] * s.velocity[:, 1] - s.position[:, 1] * s.velocity[:, 0]))


def measure(run):
    snapshots = run.snapshots()
    first, last = snapshots[0], snapshots[-1]
    dx = np.sqrt(1 / len(first.position))
    # A void: a point inside that has no particle within 1.5 dx. The middle stays inside.
    grid = np.column_stack([a.ravel() for a in np.meshgrid(*2 * [np.linspace(-0.35, 0.35, 71)])])
    gaps = cKDTree(last.position).query(grid)[0] / dx
    nearest = cKDTree(last.position).query(last.position, k=2)[0][:, 1] / dx
    series = run.series()
    energy = sum(series[k] for k in series.dtype.names if k.startswith("energy"))
    return {"angular momentum lost": abs(angular_momentum(last) / angular_momentum(first) - 1),
            "kinetic energy / first": last.kinetic / first.kinetic,
            "largest rise of energy": float(np.max(energy - np.minimum.accumulate(energy)) / energy[0]),
            "largest gap / dx": gaps.max(), "pairs closer than dx/2": float(np.mean(nearest < 0.5))}
