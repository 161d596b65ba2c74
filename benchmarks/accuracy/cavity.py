"""Lid-driven cavity, Re 100: velocities on the centre lines against Ghia et al. (1982), tables I and II."""

import numpy as np

import kernel

SCENE = "cavity.toml"
SIZES = (25, 50, 100)
ERROR = "largest error / U"
REYNOLDS = 100

# Of u at (0.5, y) and of v at (x, 0.5).
Y = np.array([0.0547, 0.0625, 0.0703, 0.1016, 0.1719, 0.2813, 0.4531, 0.5, 0.6172, 0.7344, 0.8516, 0.9531, 0.9609,
              0.9688, 0.9766])
X = np.array([0.0625, 0.0703, 0.0781, 0.0938, 0.1563, 0.2266, 0.2344, 0.5, 0.8047, 0.8594, 0.9063, 0.9453, 0.9531,
              0.9609, 0.9688])
U = {100: [-0.03717, -0.04192, -0.04775, -0.06434, -0.10150, -0.15662, -0.21090, -0.20581, -0.13641, 0.00332, 0.23151,
           0.68717, 0.73722, 0.78871, 0.84123],
     1000: [-0.18109, -0.20196, -0.22220, -0.29730, -0.38289, -0.27805, -0.10648, -0.06080, 0.05702, 0.18719, 0.33304,
            0.46604, 0.51117, 0.57492, 0.65928]}
V = {100: [0.09233, 0.10091, 0.10890, 0.12317, 0.16077, 0.17507, 0.17527, 0.05454, -0.24533, -0.22445, -0.16914,
           -0.10313, -0.08864, -0.07391, -0.05906],
     1000: [0.27485, 0.29012, 0.30353, 0.32627, 0.37095, 0.33075, 0.32235, 0.02526, -0.31966, -0.42665, -0.51550,
            -0.39188, -0.33714, -0.27669, -0.21388]}

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no shifting": ("terms.shifting=false",),
    "ida": ("formulation=ida", "terms.shifting=", "terms.density_diffusion="),
}


def settings(n, layers=3):
    wall = layers / n
    return (f"start.spacing={1 / n}", f"start.lower={[-wall, -wall]}", f"start.upper={[1 + wall, 1 + wall]}")


def measure(run, reynolds=REYNOLDS):
    """Mean over the last eighth of the time."""
    snapshots = run.snapshots()
    late = [s for s in snapshots if s.time > 0.875 * snapshots[-1].time]
    h = 1 / np.sqrt(len(late[-1].position))
    u, v = 0, 0
    for s in late:
        u = u + kernel.at(np.column_stack((0.5 + 0 * Y, Y)), s.position, s.velocity[:, 0], h)[:, 0] / len(late)
        v = v + kernel.at(np.column_stack((X, 0.5 + 0 * X)), s.position, s.velocity[:, 1], h)[:, 0] / len(late)
    errors = np.concatenate((u - U[reynolds], v - V[reynolds]))
    pressure = [s.pressure.mean() for s in late]
    return {"largest error / U": np.abs(errors).max(), "rms error / U": np.sqrt(np.mean(errors**2)),
            "mean pressure / (rho U^2)": np.mean(pressure)}
