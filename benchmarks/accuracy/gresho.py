"""Gresho vortex: circular speed at t = 1 against the steady vortex it was at the start."""

import numpy as np

SCENE = "gresho.toml"
SIZES = (25, 50, 100)
ERROR = "L1 of u_phi at t = 1"
C = 10

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no shifting": ("terms.shifting=false",),
    "no diffusion": ("terms.density_diffusion=0",),
    "h = dx": ("kernel.h_over_dx=1.0",),
    "Wendland C4, h = 2 dx": ("kernel.shape=wendland_c4", "kernel.h_over_dx=2.0"),
    "artificial viscosity 0.02": ("terms.artificial_viscosity=0.02",),
    "ida": ("formulation=ida", "terms.shifting=", "terms.density_diffusion="),
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def exact(r):
    """Speed and pressure over that of the middle."""
    speed = np.where(r < 0.2, 5 * r, np.where(r < 0.4, 2 - 5 * r, 0))
    ring = 4 + 12.5 * r**2 - 20 * r + 4 * np.log(5 * np.maximum(r, 0.2))
    pressure = np.where(r < 0.2, 12.5 * r**2, np.where(r < 0.4, ring, 4 * np.log(2) - 2))
    return speed, pressure


def start(n):
    """Displaced by up to 5 % of a spacing: a flow along the rows of an exact lattice takes long to break them."""
    centres = (np.arange(n) + 0.5) / n - 0.5
    x = np.column_stack([a.ravel() for a in np.meshgrid(centres, centres)])
    x += np.random.default_rng(1).uniform(-0.05, 0.05, x.shape) / n
    r = np.hypot(*x.T)
    speed, pressure = exact(r)
    return {"x": x, "v": np.column_stack((-x[:, 1], x[:, 0])) * (speed / r)[:, None], "rho": 1 + pressure / C**2}


def measure(run):
    """L1 over the particles, sum |u_phi - exact| / sum |exact|; the peak is that of means over rings dx wide."""
    snapshots = run.snapshots()
    first, last = snapshots[0], snapshots[-1]
    r = np.hypot(*last.position.T)
    u = (last.position[:, 0] * last.velocity[:, 1] - last.position[:, 1] * last.velocity[:, 0]) / r
    speed, _ = exact(r)
    rings = np.floor(r * np.sqrt(len(r)) + 0.5).astype(int)
    means = np.bincount(rings, u) / np.maximum(np.bincount(rings), 1)
    turn = [np.sum(s.mass * (s.position[:, 0] * s.velocity[:, 1] - s.position[:, 1] * s.velocity[:, 0]))
            for s in (first, last)]
    return {"L1 of u_phi at t = 1": np.abs(u - speed).sum() / speed.sum(),
            "mean |u_phi - exact|": np.abs(u - speed).mean(), "peak of ring means": means[1:].max(),
            "largest u_phi": u.max(), "kinetic energy lost": 1 - last.kinetic / first.kinetic,
            "angular momentum / first": turn[1] / turn[0]}
