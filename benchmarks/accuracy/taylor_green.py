"""Taylor-Green vortices, Re 100: speed exp(-8 pi^2 t / Re) of the first, everywhere."""

import numpy as np

SCENE = "taylor_green.toml"
SIZES = (25, 50, 100)
ERROR = "L2 at t = 1"


def settings(n):
    return (f"start.spacing={1 / n}", "output.snapshot_interval=0.25")


FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "lattice": ("start.jitter=0",),
    "no shifting": ("terms.shifting=false",),
    "ida": ("formulation=ida", "terms.shifting=", "terms.density_diffusion="),
}


def exact(position, decay):
    """In 3D the same flow at all heights."""
    x, y = 2 * np.pi * position.T[:2]
    still = [0 * x] * (position.shape[1] - 2)
    return decay * np.column_stack((-np.cos(x) * np.sin(y), np.sin(x) * np.cos(y), *still))


def measure(run, viscosity=0.01):
    """L1 and L2 of the velocity at the particles, kinetic energy over exact."""
    worst, at_one, energy = 0, None, 0
    for s in run.snapshots()[1:]:
        decay = np.exp(-8 * np.pi**2 * viscosity * s.time)
        u = exact(s.position, decay)
        away = np.linalg.norm(s.velocity - u, axis=1)
        l1 = away.sum() / np.linalg.norm(u, axis=1).sum()
        l2 = np.sqrt((away**2).sum() / (u**2).sum())
        worst = max(worst, l1)
        energy = s.kinetic / (0.25 * decay**2 * s.mass.sum())
        if at_one is None and s.time >= 1:
            at_one = l2
    return {"L2 at t = 1": at_one, "largest L1 to t = 2": worst, "kinetic energy / exact at t = 2": energy}
