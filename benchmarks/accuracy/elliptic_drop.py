"""Elliptic drop: half axis, central pressure and area to t = 7.6 ms against the exact ellipse (Monaghan 1994)."""

import numpy as np
from scipy.integrate import solve_ivp

import kernel

SCENE = "elliptic_drop.toml"
SIZES = (25, 50, 100)  # particles along a radius
ERROR = "half axis b at 7.6 ms"
A0, DENSITY, SOUND = 100, 1000, 1400

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no shifting": ("terms.shifting=false",),
    "no diffusion": ("terms.density_diffusion=0",),
    "seed's kernel": ("kernel.h_over_dx=0.8333333333333334",),
    "ida": ("formulation=ida", "terms.shifting=", "terms.density_diffusion="),
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def start(n):
    centres = (np.arange(-n, n) + 0.5) / n
    x = np.column_stack([a.ravel() for a in np.meshgrid(centres, centres)])
    x = x[np.sum(x**2, axis=1) < 1]
    pressure = 0.5 * DENSITY * A0**2 * (1 - np.sum(x**2, axis=1))
    return {"x": x, "v": A0 * x * [-1, 1], "rho": DENSITY + pressure / SOUND**2}


def exact(time):
    """Rate A and half axis b; a b = 1."""
    def rates(_, y):
        rate, b = y
        a = 1 / b
        return rate**2 * (a**2 - b**2) / (a**2 + b**2), rate * b

    return solve_ivp(rates, (0, time[-1]), (A0, 1), t_eval=time, rtol=1e-10).y


def measure(run):
    snapshots = run.snapshots()
    time = np.array([s.time for s in snapshots])
    rate, b = exact(time)
    a = 1 / b
    # p_c = rho A^2 a^2 b^2 / (a^2 + b^2) ... of the exact ellipse
    centre = DENSITY * rate**2 / (a**2 + b**2)
    # The second moment of the ellipse: mean y^2 = b^2 / 4. Edges of particles say less.
    ours_b = np.array([2 * np.sqrt(np.average(s.position[:, 1]**2, weights=s.mass)) for s in snapshots])
    ours_a = np.array([2 * np.sqrt(np.average(s.position[:, 0]**2, weights=s.mass)) for s in snapshots])
    ours_b /= ours_b[0]
    ours_a /= ours_a[0]
    h = 2 * np.sqrt(np.pi / len(snapshots[0].position))
    pressure = np.array([kernel.at(np.zeros((1, 2)), s.position, s.pressure, h)[0, 0] for s in snapshots])
    series = run.series()
    energy = sum(series[k] for k in series if k.startswith("energy"))
    late = time > 0.001
    return {"half axis b at 7.6 ms": abs(ours_b[-1] / b[-1] - 1), "area": abs(ours_a[-1] * ours_b[-1] - 1),
            "central pressure, rms after 1 ms": np.sqrt(np.mean((pressure / centre - 1)[late]**2)),
            "largest rise of energy": np.max(energy - np.minimum.accumulate(energy)) / energy[0],
            "energy / first": energy[-1] / energy[0]}
