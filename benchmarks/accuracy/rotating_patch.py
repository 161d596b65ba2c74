"""Rotating square patch: angular momentum, energy and voids to omega t = 4, pressures all negative at the start."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import Delaunay, cKDTree

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


def largest_void(position, least):
    """Radius of the largest empty circle that the fluid encloses, those with a radius below `least` left out (0: none is
    as large). Triangles with larger circumcircles, linked where they share a side, are the space between the arms as
    well: what reaches the hull lies outside. Else the corners of the patch would count once they are drawn out."""
    mesh = Delaunay(position)
    a, b, c = (position[mesh.simplices[:, k]] for k in range(3))
    u, v = b - a, c - a
    area = 0.5 * np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    sides = [np.linalg.norm(w, axis=1) for w in (u, v, b - c)]
    radius = np.divide(np.prod(sides, axis=0), 4 * area, out=np.full(len(area), np.inf), where=area > 0)
    empty = radius > least
    i, k = np.nonzero((mesh.neighbors >= 0) & empty[:, None])
    j = mesh.neighbors[i, k]
    linked = empty[j]
    _, part = connected_components(coo_matrix((np.ones(linked.sum()), (i[linked], j[linked])), (len(area), len(area))))
    outside = np.unique(part[np.any(mesh.neighbors < 0, axis=1) & empty])
    inside = empty & ~np.isin(part, outside)
    return radius[inside].max(initial=0)


def measure(run):
    snapshots = run.snapshots()
    first, last = snapshots[0], snapshots[-1]
    dx = np.sqrt(1 / len(first.position))
    nearest = cKDTree(last.position).query(last.position, k=2)[0][:, 1] / dx
    series = run.series()
    energy = sum(series[k] for k in series if k.startswith("energy"))
    return {"angular momentum lost": abs(angular_momentum(last) / angular_momentum(first) - 1),
            "kinetic energy / first": last.kinetic / first.kinetic,
            "largest rise of energy": float(np.max(energy - np.minimum.accumulate(energy)) / energy[0]),
            "largest void / dx": max(largest_void(s.position, 1.5 * dx) for s in snapshots) / dx,
            "pairs closer than dx/2": float(np.mean(nearest < 0.5))}
