"""Two still layers, densities 1:2: fastest particle over sqrt(g H), to 50 sqrt(H/g)."""

import numpy as np

SCENE = "two_layers.toml"
SIZES = (25, 50, 100)  # particles from floor to lid
ERROR = "largest speed / sqrt(gH)"

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "1:10": ("group.light.density=100",),
    "1:1000": ("group.light.density=1",),
    "pressures by volume": ("terms.pressure_weights=volume",),
    "by volume, 1:1000": ("terms.pressure_weights=volume", "group.light.density=1"),
}


def settings(n):
    wall = 4 / n
    return (f"start.spacing={1 / n}", f"start.lower={[-wall, -wall]}", f"start.upper={[1 + wall, 1 + wall]}")


def measure(run):
    speeds, crossed = [], []
    for s in run.snapshots()[1:]:
        speeds.append(np.linalg.norm(s.velocity, axis=1).max())
        heights = s.position[:, 1]
        crossed.append(heights[s.group == 0].max() - heights[s.group == 1].min())
    scale = np.sqrt(9.8)
    return {"largest speed / sqrt(gH)": max(speeds) / scale, "at the end": speeds[-1] / scale,
            "heavy above light [m]": max(crossed)}
