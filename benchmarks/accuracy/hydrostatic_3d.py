"""Hydrostatic tank in 3D, walls in x, periodic in z: rms pressure error over rho g H, to 30 sqrt(H/g)."""

import hydrostatic
from hydrostatic import ERROR, measure  # noqa: F401

SCENE = "hydrostatic.toml"
SIZES = (10, 15, 20)  # particles from floor to surface

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no diffusion": ("terms.density_diffusion=0",),
    "slip walls": ("group.wall.slip=true",),
    "ida": ("formulation=ida", "terms.density_diffusion="),
}


def settings(n):
    wall, depth = 4 / n, 14 / n
    return (f"start.spacing={1 / n}", "dimension=3", f"domain.lower=[{-1.5 * wall}, {-1.5 * wall}, 0]",
            f"domain.upper=[{1 + 1.5 * wall}, 1.6, {depth}]", "domain.periodic=[false, false, true]",
            "domain.gravity=[0, -9.8, 0]", "start.origin=[0, 0, 0]", f"start.lower=[{-wall}, {-wall}, 0]",
            f"start.upper=[{1 + wall}, {1 + wall}, {depth}]", "start.region.1.lower=[0, 0, 0]",
            f"start.region.1.upper=[1, 1, {depth}]", "start.region.2.lower=[0, 1, 0]",
            f"start.region.2.upper=[1, 1.6, {depth}]", "time.until=9.583", "output.snapshot_interval=0.8")
