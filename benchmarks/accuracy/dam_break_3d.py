"""Dam break in 3D, periodic across: front against Martin & Moyce (1952), energy, and whether it runs to its end."""

import dam_break
from dam_break import ERROR, SCENE  # noqa: F401

SIZES = (10, 15, 20)  # particles across the column
LAYERS = 14  # of particles along the period

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "slip walls": ("group.wall.slip=true",),
    "ida": ("formulation=ida", "terms.density_diffusion="),
}


def settings(n):
    """A column 1 m wide and 2 m high."""
    layers, depth = 4 / n, LAYERS / n
    return (f"start.spacing={1 / n}", "dimension=3", "domain.lower=[-0.5, -0.5, 0]", f"domain.upper=[13, 8, {depth}]",
            "domain.periodic=[false, false, true]", "domain.gravity=[0, -9.81, 0]", "start.origin=[0, 0, 0]",
            f"start.lower=[{-layers}, {-layers}, 0]", f"start.upper=[{12 + layers}, 4, {depth}]",
            "start.region.1.lower=[0, 0, 0]", f"start.region.1.upper=[12, 4, {depth}]",
            "start.region.2.lower=[0, 0, 0]", f"start.region.2.upper=[1, 2, {depth}]", "start.surface_height=2",
            "time.until=1.5", "group.water.sound_speed=62.6", "output.snapshot_interval=0.05")


def measure(run):
    return dam_break.measure(run, LAYERS)
