"""Sound wave: its speed in each equation of state, from a standing wave over three periods.

Each of the two kernel sums, of div v and of grad p, sees a wave through the kernel, and c falls by its transform,
1 - (k h)^2 / 4 of the quintic: 3.5 % at h = 1.2 dx and 20 dx a wave length, whatever the material. A step in time
gives (omega dt)^2 / 24 of it back.
"""

import tomllib

import numpy as np
from scipy.optimize import curve_fit

SCENE = "acoustic.toml"
SIZES = (10, 20, 40)  # particles a wave length
ERROR = "wave speed"
SPEED = 1e-4  # of the particles [m/s]: no more than 5e-6 of the sound

GAS = ("group.matter.eos=bubbly", "group.matter.gas_content=0.001", "group.matter.gas_rt=5e5",
       "group.matter.solubility_pressure=1e9")
SOLID = ("group.matter.kind=solid", "group.matter.poisson_ratio=0.25")
LIQUID, ELASTIC = 2828.427, 3794.733  # speeds of sound [m/s]
PERIODS = {"default": 1 / LIQUID, "bubbly, liquid, 2 MPa": 1 / LIQUID, "bubbly, foam, 0.3 MPa": 1 / 26.377,
           "bubbly, foam, 0.1 MPa": 1 / 23.691, "elastic": 1 / ELASTIC, "ida": 1 / LIQUID, "ida, elastic": 1 / ELASTIC}


def with_end(name, *settings):
    return (*settings, f"time.until={3 * PERIODS[name]}", f"output.series_interval={PERIODS[name] / 100}")


IDA = ("formulation=ida", "terms.density_diffusion=")
FORMULATIONS = {name: with_end(name, *settings) for name, settings in {
    "default": (),
    "bubbly, liquid, 2 MPa": (*GAS, "domain.surface_pressure=2e6"),
    "bubbly, foam, 0.3 MPa": (*GAS, "domain.surface_pressure=3e5"),
    "bubbly, foam, 0.1 MPa": (*GAS, "domain.surface_pressure=1e5"),
    "elastic": SOLID,
    "ida": IDA,
    "ida, elastic": (*IDA, *SOLID),
}.items()}


def rows(n):
    """Particles across the strip: a period is at least three cells long."""
    return max(14, n // 4)


def settings(n):
    return (f"start.spacing={1 / n}", f"domain.upper=[4, {rows(n) / n}]",
            f"monitor.antinode.nearest_to=[0.25, {7 / n}]")


def start(n):
    x = np.column_stack([a.ravel() for a in np.meshgrid((np.arange(4 * n) + 0.5) / n, (np.arange(rows(n)) + 0.5) / n)])
    return {"x": x, "v": np.column_stack((SPEED * np.sin(2 * np.pi * x[:, 0]), 0 * x[:, 0]))}


def density(pressure, g):
    """Ida eqs. (13)-(15) for gamma = 1."""
    liquid = g["density"] * (1 + pressure / g["bulk_modulus"])
    dissolved = pressure / g.get("solubility_pressure", 1)
    if g["eos"] == "linear" or g["gas_content"] <= dissolved:
        return liquid
    share = (g["gas_content"] - dissolved) / (1 + g["gas_content"])
    return liquid / (1 + share * (liquid * g["gas_rt"] / pressure - 1))


def sound_speed(scene):
    g, p = scene["group"][0], scene["domain"]["surface_pressure"]
    if g["kind"] == "solid":
        return np.sqrt((g["bulk_modulus"] + 4 / 3 * g["shear_modulus"]) / g["density"])
    d = 1e-4 * p + 1
    return np.sqrt(2 * d / (density(p + d, g) - density(p - d, g)))


def swing(t, size, decay, omega, phase):
    return size * np.exp(-decay * t) * np.cos(omega * t + phase)


def theory(scene, c, dt):
    """Speed over c of the wave on the lattice: 2 sin(omega dt / 2) = c dt S, S the kernel sum of the slope of sin k x
    where it is steepest."""
    h, dx, k = scene["kernel"]["smoothing_length"], scene["start"]["spacing"], 2 * np.pi
    x, y = np.meshgrid(*2 * [dx * np.arange(-5, 6)])
    q = np.hypot(x, y) / h
    slope = sum(weight * np.maximum(m - q, 0)**4 for m, weight in ((3, 1), (2, -6), (1, 15)))
    sum_of_slope = 5 * 7 / (478 * np.pi * h**3) * dx**2 * np.sum(slope * np.sin(k * x) * x / np.maximum(h * q, 1e-30))
    return 2 * np.arcsin(c * dt * sum_of_slope / 2) / (c * dt * k)


def measure(run):
    scene = tomllib.loads((run.folder / "scene.toml").read_text())
    c = sound_speed(scene)
    series, dt = run.series(), run.perf["end"]["time"] / run.perf["steps"]
    t, v = series["t"] * c, series["antinode_vx"] / SPEED
    fit, _ = curve_fit(swing, t, v, (1, 0.01, 2 * np.pi, 0))
    return {"wave speed": abs(fit[2] / (2 * np.pi) - 1), "c [m/s]": c, "measured / exact": fit[2] / (2 * np.pi),
            "measured / lattice theory": fit[2] / (2 * np.pi * theory(scene, c, dt)),
            "damping a period": 1 - np.exp(-fit[1]), "rms from the fit": np.std(v - swing(t, *fit))}
