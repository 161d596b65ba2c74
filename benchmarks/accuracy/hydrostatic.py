"""Hydrostatic tank: rms pressure error over rho g H and kinetic energy over M g H, to 100 sqrt(H/g)."""

import numpy as np

SCENE = "hydrostatic.toml"
SIZES = (25, 50)  # particles from floor to surface
ERROR = "largest rms pressure error / rho g H"

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no diffusion": ("terms.density_diffusion=0",),
    "from p = 0": ("start.pressure=zero",),
    "ida": ("formulation=ida", "terms.density_diffusion="),
}


def settings(n):
    wall = 4 / n
    return (f"start.spacing={1 / n}", f"start.lower={[-wall, -wall]}", f"start.upper={[1 + wall, 1 + wall]}",
            "start.region.2.upper=[1, 1.2]", "output.snapshot_interval=1.6")


def measure(run):
    errors, kinetic, mean = [], [], []
    for s in run.snapshots()[1:]:
        head = 9800 * (1 - s.position[:, 1])
        errors.append(np.sqrt(np.mean((s.pressure - head)**2)) / 9800)
        kinetic.append(s.kinetic / (s.mass.sum() * 9.8))
        mean.append(s.pressure.mean() / head.mean() - 1)
    return {"largest rms pressure error / rho g H": max(errors), "at the end": errors[-1],
            "mean pressure at the end": mean[-1], "largest kinetic energy / MgH": max(kinetic)}
