"""Layer under its own weight: stresses rho g y and nu / (1 - nu) of it, and rest."""

import numpy as np

SCENE = "gravity_patch.toml"
SIZES = (10, 20, 40)  # particles through the layer
ERROR = "vertical stress"
ACROSS = 16  # particles

FORMULATIONS = {"default": (), "mixed": ("precision=mixed",), "no hourglass control": ("terms.hourglass=0",)}


def settings(n):
    return f"start.spacing={1 / n}", f"domain.upper=[{ACROSS / n}, 1.5]"


def start(n):
    x, y = (a.ravel() for a in np.meshgrid((np.arange(ACROSS) + 0.5) / n, (np.arange(-5, n) + 0.5) / n, indexing="ij"))
    return {"x": np.column_stack((x, y)), "v": np.zeros((len(x), 2)), "rho": np.full(len(x), 2000.0),
            "group": (y < 0).astype(int)}


def measure(run):
    first, *_, middle, last = run.snapshots()
    stress = last.stress[:, :2] - last.pressure[:, None]
    weight = 2000 * 9.81
    exact = -weight * (1 - first.position[:, 1])
    inside = np.abs(first.position[:, 1] - 0.5) < 0.4
    return {"vertical stress": np.max(np.abs(stress[:, 1] - exact)[inside]) / weight,
            "horizontal stress": np.max(np.abs(stress[:, 0] - exact / 3)[inside]) / weight,
            "ratio of stresses": np.mean(stress[inside, 0]) / np.mean(stress[inside, 1]),
            "kinetic energy / (weight m)": last.kinetic / np.sum(last.mass * 9.81),
            "drift / sag": np.max(np.abs(last.position - middle.position)) / np.max(np.abs(last.position - first.position))}
