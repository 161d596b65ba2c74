"""Poiseuille start-up: largest error over u_max at five times against the series (Morris et al. 1997)."""

import numpy as np

SCENE = "poiseuille.toml"
SIZES = (20, 40, 80)  # particles across
ERROR = "largest error / u_max"
LENGTH, VISCOSITY, FORCE = 1e-3, 1e-6, 1e-4
TIMES = (0.0225, 0.045, 0.1125, 0.225, 1.0)

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "implicit": ("terms.implicit_viscosity=true", "time.dt=", "time.cfl=0.8"),
    "no shifting": ("terms.shifting=false",),
    "ida": ("formulation=ida", "terms.shifting=", "terms.density_diffusion="),
}


def settings(n):
    spacing = LENGTH / n
    layers = 3 * spacing
    return (f"start.spacing={spacing}", f"start.lower=[0, {-layers}]", f"start.upper=[{20 * spacing}, {LENGTH + layers}]",
            f"domain.upper=[{20 * spacing}, {1.2 * LENGTH}]", f"start.region.1.upper=[{20 * spacing}, {LENGTH}]",
            f"time.dt={0.25e-3 * (20 / n)**2}", "output.snapshot_interval=0.0225")


def exact(y, t):
    k = (2 * np.arange(200) + 1) * np.pi / LENGTH
    return (FORCE / (2 * VISCOSITY) * y * (LENGTH - y) - 4 * FORCE / (VISCOSITY * LENGTH) *
            np.sum(np.sin(np.outer(y, k)) / k**3 * np.exp(-VISCOSITY * k**2 * t), axis=1))


def measure(run):
    snapshots = run.snapshots()
    errors = []
    for time in TIMES:
        s = min(snapshots, key=lambda s: abs(s.time - time))
        errors.append(np.abs(s.velocity[:, 0] - exact(s.position[:, 1], s.time)).max())
    u_max = FORCE * LENGTH**2 / (8 * VISCOSITY)
    return {"largest error / u_max": max(errors) / u_max, "at the end": errors[-1] / u_max}
